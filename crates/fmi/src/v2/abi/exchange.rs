//! Functions for model exchange only (section 3.2).

use super::entry::enter;
use crate::abi::{input, output, room, store};
use crate::failure::Outcome;
use crate::instance::Instance;
use crate::model::Model;
use crate::phase::Call;
use crate::v2::calls;
use crate::v2::sys::{self, Boolean, Component, EventInfo, Real, Status};
use core::mem::MaybeUninit;

pub unsafe fn fmi2EnterEventMode<M: Model>(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::ENTER_EVENT_MODE, Instance::<M>::enter_event_mode) }
}

pub unsafe fn fmi2NewDiscreteStates<M: Model>(
    c: Component,
    fmi2eventInfo: *mut EventInfo,
) -> Status {
    let body = |instance: &mut Instance<M>| {
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

pub unsafe fn fmi2EnterContinuousTimeMode<M: Model>(c: Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe {
        enter(c, &calls::ENTER_CONTINUOUS_TIME_MODE, Instance::<M>::enter_continuous_time_mode)
    }
}

pub unsafe fn fmi2CompletedIntegratorStep<M: Model>(
    c: Component,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
    enterEventMode: *mut Boolean,
    terminateSimulation: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
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

pub unsafe fn fmi2SetTime<M: Model>(c: Component, time: Real) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_TIME, |instance: &mut Instance<M>| instance.set_time(time)) }
}

pub unsafe fn fmi2SetContinuousStates<M: Model>(c: Component, x: *const Real, nx: usize) -> Status {
    // SAFETY: the master passes an array of nx elements.
    let body =
        |instance: &mut Instance<M>| instance.set_continuous_states(unsafe { input("x", x, nx) }?);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_CONTINUOUS_STATES, body) }
}

/// Hands out an array with an element per state.
///
/// # Safety
/// `c` is one of the master's instances, `values` leads to room for `length` elements.
unsafe fn per_state<M: Model>(
    c: Component,
    call: &Call,
    argument: &'static str,
    values: *mut Real,
    length: usize,
    get: impl FnOnce(&mut Instance<M>, &mut [MaybeUninit<Real>]) -> Outcome,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: by this function's contract.
        get(instance, unsafe { output(argument, values, length) }?)
    };
    // SAFETY: by this function's contract.
    unsafe { enter(c, call, body) }
}

fn fill(room: &mut [MaybeUninit<Real>], numbers: &[f64]) {
    for (place, &number) in room.iter_mut().zip(numbers) {
        place.write(number);
    }
}

pub unsafe fn fmi2GetDerivatives<M: Model>(
    c: Component,
    derivatives: *mut Real,
    nx: usize,
) -> Status {
    let get = |instance: &mut Instance<M>, room: &mut [_]| {
        instance.derivatives(nx, |numbers| fill(room, numbers))
    };
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, &calls::GET_DERIVATIVES, "derivatives", derivatives, nx, get) }
}

pub unsafe fn fmi2GetEventIndicators<M: Model>(
    c: Component,
    _eventIndicators: *mut Real,
    ni: usize,
) -> Status {
    let body = |instance: &mut Instance<M>| instance.event_indicators(ni);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_EVENT_INDICATORS, body) }
}

pub unsafe fn fmi2GetContinuousStates<M: Model>(c: Component, x: *mut Real, nx: usize) -> Status {
    let get = |instance: &mut Instance<M>, room: &mut [_]| {
        instance.continuous_states(nx, |numbers| fill(room, numbers))
    };
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, &calls::GET_CONTINUOUS_STATES, "x", x, nx, get) }
}

pub unsafe fn fmi2GetNominalsOfContinuousStates<M: Model>(
    c: Component,
    x_nominal: *mut Real,
    nx: usize,
) -> Status {
    let get = |instance: &mut Instance<M>, room: &mut [MaybeUninit<Real>]| {
        instance.nominals(nx, |i, nominal| {
            room[i].write(nominal);
        })
    };
    let call = &calls::GET_NOMINALS_OF_CONTINUOUS_STATES;
    // SAFETY: the master passes one of its instances and an array of nx elements.
    unsafe { per_state(c, call, "x_nominal", x_nominal, nx, get) }
}
