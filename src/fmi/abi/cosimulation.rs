//! Functions for co-simulation only (section 4.2).

use super::entry::{enter, store};
use crate::fmi::failure::Failure;
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle as calls;
use crate::fmi::sys::{self, Boolean, Component, FmiString, Integer, Real, Status, StatusKind};

/// Snapshots outlive any step, so `noSetFMUStatePriorToCurrentPoint` changes nothing.
#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2DoStep(
    c: Component,
    currentCommunicationPoint: Real,
    communicationStepSize: Real,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
) -> Status {
    let body = |instance: &mut Instance| {
        instance.do_step(currentCommunicationPoint, communicationStepSize)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::DO_STEP, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2CancelStep(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::CANCEL_STEP, Instance::cancel_step) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetStatus(
    c: Component,
    s: StatusKind,
    _value: *mut Status,
) -> Status {
    let body = |_: &mut Instance| Err(Failure::NoStatus { kind: s, asked: "fmi2Status" });
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_STATUS, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetRealStatus(
    c: Component,
    s: StatusKind,
    value: *mut Real,
) -> Status {
    let body = |instance: &mut Instance| {
        let real = instance.real_status(s)?;
        // SAFETY: the master passes room for the value.
        unsafe { store("value", value, real) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_REAL_STATUS, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetIntegerStatus(
    c: Component,
    s: StatusKind,
    _value: *mut Integer,
) -> Status {
    let body = |_: &mut Instance| Err(Failure::NoStatus { kind: s, asked: "fmi2Integer" });
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_INTEGER_STATUS, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetBooleanStatus(
    c: Component,
    s: StatusKind,
    value: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance| {
        let truth = if instance.boolean_status(s)? { sys::TRUE } else { sys::FALSE };
        // SAFETY: the master passes room for the value.
        unsafe { store("value", value, truth) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_BOOLEAN_STATUS, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetStringStatus(
    c: Component,
    s: StatusKind,
    _value: *mut FmiString,
) -> Status {
    let body = |_: &mut Instance| Err(Failure::NoStatus { kind: s, asked: "fmi2String" });
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_STRING_STATUS, body) }
}
