//! What the model has nothing for: structural parameters, discrete states, model partitions, arrays.

use super::entry::enter;
use crate::failure::Failure;
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::phase::Call;
use crate::v3::calls;
use crate::v3::sys::{Enumeration, Float64, Instance, Status, ValueReference};

/// Refuses a call whose capability the model description denies.
///
/// # Safety
/// `instance` is NULL or a live instance that no other thread is using.
unsafe fn absent<M: Model>(instance: Instance, call: &Call, capability: &'static str) -> Status {
    let body = |_: &mut Of<M>| Err(Failure::NotProvided { capability });
    // SAFETY: by this function's contract.
    unsafe { enter(instance, call, body) }
}

pub unsafe fn fmi3EnterConfigurationMode<M: Model>(instance: Instance) -> Status {
    // SAFETY: the master passes one of its instances; likewise below.
    unsafe { absent::<M>(instance, &calls::ENTER_CONFIGURATION_MODE, "structural parameters") }
}

pub unsafe fn fmi3ExitConfigurationMode<M: Model>(instance: Instance) -> Status {
    // SAFETY: see above.
    unsafe { absent::<M>(instance, &calls::EXIT_CONFIGURATION_MODE, "structural parameters") }
}

pub unsafe fn fmi3EvaluateDiscreteStates<M: Model>(instance: Instance) -> Status {
    // SAFETY: see above.
    unsafe { absent::<M>(instance, &calls::EVALUATE_DISCRETE_STATES, "discrete states") }
}

pub unsafe fn fmi3ActivateModelPartition<M: Model>(
    instance: Instance,
    _clockReference: ValueReference,
    _activationTime: Float64,
) -> Status {
    // SAFETY: see above.
    unsafe { absent::<M>(instance, &calls::ACTIVATE_MODEL_PARTITION, "model partitions") }
}

const PER_ELEMENT: &str = "dependencies of single elements: the variables are scalars";

pub unsafe fn fmi3GetNumberOfVariableDependencies<M: Model>(
    instance: Instance,
    _valueReference: ValueReference,
    _nDependencies: *mut usize,
) -> Status {
    let call = &calls::GET_NUMBER_OF_VARIABLE_DEPENDENCIES;
    // SAFETY: see above.
    unsafe { absent::<M>(instance, call, PER_ELEMENT) }
}

pub unsafe fn fmi3GetVariableDependencies<M: Model>(
    instance: Instance,
    _dependent: ValueReference,
    _elementIndicesOfDependent: *mut usize,
    _independents: *mut ValueReference,
    _elementIndicesOfIndependents: *mut usize,
    _dependencyKinds: *mut Enumeration,
    _nDependencies: usize,
) -> Status {
    // SAFETY: see above.
    unsafe { absent::<M>(instance, &calls::GET_VARIABLE_DEPENDENCIES, PER_ELEMENT) }
}
