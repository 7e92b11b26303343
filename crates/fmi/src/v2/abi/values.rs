//! Values of variables and their derivatives (sections 2.1.7 and 2.1.9).

use super::entry::enter;
use crate::abi::{input, output};
use crate::instance::Instance;
use crate::model::Model;
use crate::v2::calls;
use crate::v2::sys::{self, Boolean, Component, FmiString, Integer, Real, Status, ValueReference};

pub unsafe fn fmi2GetReal<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, output("value", value, nvr)?) };
        instance.get_real(vr, |i, real| {
            value[i].write(real);
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_REAL, body) }
}

pub unsafe fn fmi2GetInteger<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut Integer,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, output("value", value, nvr)?) };
        instance.get_integer(vr, |i, integer| {
            value[i].write(integer);
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_INTEGER, body) }
}

pub unsafe fn fmi2GetBoolean<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, output("value", value, nvr)?) };
        instance.get_boolean(vr, |i, truth| {
            value[i].write(if truth { sys::TRUE } else { sys::FALSE });
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_BOOLEAN, body) }
}

pub unsafe fn fmi2GetString<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *mut FmiString,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, _) = unsafe { (input("vr", vr, nvr)?, output("value", value, nvr)?) };
        instance.strings(vr)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_STRING, body) }
}

pub unsafe fn fmi2SetReal<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, input("value", value, nvr)?) };
        instance.set_real(vr, value)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_REAL, body) }
}

pub unsafe fn fmi2SetInteger<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const Integer,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, input("value", value, nvr)?) };
        instance.set_integer(vr, value)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_INTEGER, body) }
}

pub unsafe fn fmi2SetBoolean<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, value) = unsafe { (input("vr", vr, nvr)?, input("value", value, nvr)?) };
        instance.set_boolean(vr, value)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_BOOLEAN, body) }
}

pub unsafe fn fmi2SetString<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    value: *const FmiString,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, _) = unsafe { (input("vr", vr, nvr)?, input("value", value, nvr)?) };
        instance.strings(vr)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_STRING, body) }
}

pub unsafe fn fmi2GetDirectionalDerivative<M: Model>(
    c: Component,
    vUnknown_ref: *const ValueReference,
    nUnknown: usize,
    vKnown_ref: *const ValueReference,
    nKnown: usize,
    dvKnown: *const Real,
    dvUnknown: *mut Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nKnown and nUnknown elements.
        let (unknowns, knowns, seed, change) = unsafe {
            (
                input("vUnknown_ref", vUnknown_ref, nUnknown)?,
                input("vKnown_ref", vKnown_ref, nKnown)?,
                input("dvKnown", dvKnown, nKnown)?,
                output("dvUnknown", dvUnknown, nUnknown)?,
            )
        };
        instance.directional_derivative(unknowns, knowns, seed, |i, real| {
            change[i].write(real);
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_DIRECTIONAL_DERIVATIVE, body) }
}

pub unsafe fn fmi2SetRealInputDerivatives<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    order: *const Integer,
    value: *const Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, order, value) = unsafe {
            (input("vr", vr, nvr)?, input("order", order, nvr)?, input("value", value, nvr)?)
        };
        instance.set_input_derivatives(vr, order, value)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_REAL_INPUT_DERIVATIVES, body) }
}

pub unsafe fn fmi2GetRealOutputDerivatives<M: Model>(
    c: Component,
    vr: *const ValueReference,
    nvr: usize,
    order: *const Integer,
    value: *mut Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes arrays of nvr elements.
        let (vr, order, value) = unsafe {
            (input("vr", vr, nvr)?, input("order", order, nvr)?, output("value", value, nvr)?)
        };
        instance.output_derivatives(vr, order, |i, real| {
            value[i].write(real);
        })
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_REAL_OUTPUT_DERIVATIVES, body) }
}
