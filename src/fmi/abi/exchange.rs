//! Functions for model exchange only (section 3.2).

use super::entry::{enter, input, output, room, store};
use crate::fmi::failure::Failure;
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle::{self as calls, Call};
use crate::fmi::sys::{self, Boolean, Component, EventInfo, Real, Status};
use crate::vehicle::State;

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2EnterEventMode(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::ENTER_EVENT_MODE, Instance::enter_event_mode) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2NewDiscreteStates(
    c: Component,
    fmi2eventInfo: *mut EventInfo,
) -> Status {
    let body = |instance: &mut Instance| {
        let info = EventInfo {
            terminate_simulation: if instance.ended() { sys::TRUE } else { sys::FALSE },
            ..EventInfo::default()
        };
        // SAFETY: the master passes room for the information.
        unsafe { store("fmi2eventInfo", fmi2eventInfo, info) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::NEW_DISCRETE_STATES, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::ENTER_CONTINUOUS_TIME_MODE, Instance::enter_continuous_time_mode) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: Component,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
    enterEventMode: *mut Boolean,
    terminateSimulation: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: the master passes room for the answers.
        let (event, end) = unsafe {
            (
                room("enterEventMode", enterEventMode)?,
                room("terminateSimulation", terminateSimulation)?,
            )
        };
        let ends = instance.completed_integrator_step()?;
        event.write(sys::FALSE);
        end.write(if ends { sys::TRUE } else { sys::FALSE });
        Ok(())
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::COMPLETED_INTEGRATOR_STEP, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetTime(c: Component, time: Real) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_TIME, |instance: &mut Instance| instance.set_time(time)) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetContinuousStates(
    c: Component,
    x: *const Real,
    nx: usize,
) -> Status {
    // SAFETY: the master passes an array of nx elements.
    let body =
        |instance: &mut Instance| instance.set_continuous_states(unsafe { input("x", x, nx) }?);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_CONTINUOUS_STATES, body) }
}

/// Hands out an array with an element per state.
///
/// # Safety
/// `c` is one of the master's instances, `values` leads to room for `length` elements.
unsafe fn per_state(
    c: Component,
    call: &Call,
    argument: &'static str,
    values: *mut Real,
    length: usize,
    get: impl FnOnce(&mut Instance) -> Result<State, Failure>,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: by this function's contract.
        let room = unsafe { output(argument, values, length) }?;
        let numbers = get(instance)?;
        room.iter_mut().zip(numbers).for_each(|(place, number)| {
            place.write(number);
        });
        Ok(())
    };
    // SAFETY: by this function's contract.
    unsafe { enter(c, call, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetDerivatives(
    c: Component,
    derivatives: *mut Real,
    nx: usize,
) -> Status {
    let get = |instance: &mut Instance| instance.derivatives(nx);
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, &calls::GET_DERIVATIVES, "derivatives", derivatives, nx, get) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetEventIndicators(
    c: Component,
    _eventIndicators: *mut Real,
    ni: usize,
) -> Status {
    let body = |instance: &mut Instance| instance.event_indicators(ni);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_EVENT_INDICATORS, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetContinuousStates(
    c: Component,
    x: *mut Real,
    nx: usize,
) -> Status {
    let get = |instance: &mut Instance| instance.continuous_states(nx);
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, &calls::GET_CONTINUOUS_STATES, "x", x, nx, get) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: Component,
    x_nominal: *mut Real,
    nx: usize,
) -> Status {
    let get = |instance: &mut Instance| instance.nominals(nx);
    let call = &calls::GET_NOMINALS_OF_CONTINUOUS_STATES;
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, call, "x_nominal", x_nominal, nx, get) }
}
