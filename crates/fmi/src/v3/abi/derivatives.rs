//! Partial derivatives (section 2.2.11) and derivatives of outputs (section 4.2.1).

use super::entry::{as_many, enter};
use crate::abi::{input, output};
use crate::failure::Outcome;
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::phase::Call;
use crate::v3::calls;
use crate::v3::sys::{Float64, Instance, Int32, Status, ValueReference};

/// Arrays of references and numbers, as the two partial derivatives pass them.
struct Arrays {
    unknowns: (*const ValueReference, usize),
    knowns: (*const ValueReference, usize),
    seed: (*const Float64, usize),
    sensitivity: (*mut Float64, usize),
}

/// A sum over the rows or the columns of the Jacobian.
///
/// # Safety
/// `instance` is NULL or a live instance that no other thread is using; the arrays have the lengths stated.
unsafe fn partial<M: Model>(
    instance: Instance,
    call: &Call,
    arrays: &Arrays,
    [seeds, sensitivities]: [usize; 2],
    compute: impl FnOnce(
        &mut Of<M>,
        &[ValueReference],
        &[ValueReference],
        &[f64],
        &mut dyn FnMut(usize, f64),
    ) -> Outcome,
) -> Status {
    let body = |instance: &mut Of<M>| {
        as_many("nSeed", arrays.seed.1, seeds)?;
        as_many("nSensitivity", arrays.sensitivity.1, sensitivities)?;
        // SAFETY: by this function's contract.
        let (unknowns, knowns, seed, sensitivity) = unsafe {
            (
                input("unknowns", arrays.unknowns.0, arrays.unknowns.1)?,
                input("knowns", arrays.knowns.0, arrays.knowns.1)?,
                input("seed", arrays.seed.0, seeds)?,
                output("sensitivity", arrays.sensitivity.0, sensitivities)?,
            )
        };
        compute(instance, unknowns, knowns, seed, &mut |i, value| {
            sensitivity[i].write(value);
        })
    };
    // SAFETY: by this function's contract.
    unsafe { enter(instance, call, body) }
}

pub unsafe fn fmi3GetDirectionalDerivative<M: Model>(
    instance: Instance,
    unknowns: *const ValueReference,
    nUnknowns: usize,
    knowns: *const ValueReference,
    nKnowns: usize,
    seed: *const Float64,
    nSeed: usize,
    sensitivity: *mut Float64,
    nSensitivity: usize,
) -> Status {
    let arrays = Arrays {
        unknowns: (unknowns, nUnknowns),
        knowns: (knowns, nKnowns),
        seed: (seed, nSeed),
        sensitivity: (sensitivity, nSensitivity),
    };
    let call = &calls::GET_DIRECTIONAL_DERIVATIVE;
    // SAFETY: the master passes one of its instances and arrays of the lengths it states.
    unsafe {
        partial::<M>(instance, call, &arrays, [nKnowns, nUnknowns], |of, y, x, seed, write| {
            of.directional_derivative(y, x, seed, write)
        })
    }
}

pub unsafe fn fmi3GetAdjointDerivative<M: Model>(
    instance: Instance,
    unknowns: *const ValueReference,
    nUnknowns: usize,
    knowns: *const ValueReference,
    nKnowns: usize,
    seed: *const Float64,
    nSeed: usize,
    sensitivity: *mut Float64,
    nSensitivity: usize,
) -> Status {
    let arrays = Arrays {
        unknowns: (unknowns, nUnknowns),
        knowns: (knowns, nKnowns),
        seed: (seed, nSeed),
        sensitivity: (sensitivity, nSensitivity),
    };
    let call = &calls::GET_ADJOINT_DERIVATIVE;
    // SAFETY: the master passes one of its instances and arrays of the lengths it states.
    unsafe {
        partial::<M>(instance, call, &arrays, [nUnknowns, nKnowns], |of, y, x, seed, write| {
            of.adjoint_derivative(y, x, seed, write)
        })
    }
}

pub unsafe fn fmi3GetOutputDerivatives<M: Model>(
    instance: Instance,
    valueReferences: *const ValueReference,
    nValueReferences: usize,
    orders: *const Int32,
    values: *mut Float64,
    nValues: usize,
) -> Status {
    let body = |instance: &mut Of<M>| {
        as_many("nValues", nValues, nValueReferences)?;
        // SAFETY: the master passes arrays of the lengths it states.
        let (references, orders, values) = unsafe {
            (
                input("valueReferences", valueReferences, nValueReferences)?,
                input("orders", orders, nValueReferences)?,
                output("values", values, nValues)?,
            )
        };
        instance.output_derivatives(references, orders, |i, value| {
            values[i].write(value);
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::GET_OUTPUT_DERIVATIVES, body) }
}
