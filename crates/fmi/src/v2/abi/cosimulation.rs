//! Functions for co-simulation only (section 4.2).

use super::entry::enter;
use crate::abi::store;
use crate::instance::Instance;
use crate::model::Model;
use crate::v2::calls;
use crate::v2::status::no_status;
use crate::v2::sys::{self, Boolean, Component, FmiString, Integer, Real, Status, StatusKind};

/// Snapshots outlive any step, so `noSetFMUStatePriorToCurrentPoint` changes nothing.
pub unsafe fn fmi2DoStep<M: Model>(
    c: Component,
    currentCommunicationPoint: Real,
    communicationStepSize: Real,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        instance.do_step(currentCommunicationPoint, communicationStepSize)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::DO_STEP, body) }
}

pub unsafe fn fmi2CancelStep<M: Model>(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::CANCEL_STEP, Instance::<M>::cancel_step) }
}

pub unsafe fn fmi2GetStatus<M: Model>(c: Component, s: StatusKind, _value: *mut Status) -> Status {
    let body = |_: &mut Instance<M>| Err(no_status(s, "fmi2Status"));
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_STATUS, body) }
}

pub unsafe fn fmi2GetRealStatus<M: Model>(c: Component, s: StatusKind, value: *mut Real) -> Status {
    let body = |instance: &mut Instance<M>| {
        let real = instance.real_status(s)?;
        // SAFETY: the master passes room for the value.
        unsafe { store("value", value, real) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_REAL_STATUS, body) }
}

pub unsafe fn fmi2GetIntegerStatus<M: Model>(
    c: Component,
    s: StatusKind,
    _value: *mut Integer,
) -> Status {
    let body = |_: &mut Instance<M>| Err(no_status(s, "fmi2Integer"));
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_INTEGER_STATUS, body) }
}

pub unsafe fn fmi2GetBooleanStatus<M: Model>(
    c: Component,
    s: StatusKind,
    value: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        let truth = if instance.boolean_status(s)? { sys::TRUE } else { sys::FALSE };
        // SAFETY: the master passes room for the value.
        unsafe { store("value", value, truth) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_BOOLEAN_STATUS, body) }
}

pub unsafe fn fmi2GetStringStatus<M: Model>(
    c: Component,
    s: StatusKind,
    _value: *mut FmiString,
) -> Status {
    let body = |_: &mut Instance<M>| Err(no_status(s, "fmi2String"));
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_STRING_STATUS, body) }
}
