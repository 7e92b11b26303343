//! Functions for model exchange only (section 3.2).

use super::entry::enter;
use crate::abi::{input, output, room, store};
use crate::exchange::EVENT_INDICATORS;
use crate::failure::Outcome;
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::phase::Call;
use crate::table;
use crate::v3::calls;
use crate::v3::sys::{Boolean, Float64, Instance, Status};
use core::mem::MaybeUninit;

pub unsafe fn fmi3EnterEventMode<M: Model>(instance: Instance) -> Status {
    // SAFETY: the master passes one of its instances; likewise below.
    unsafe { enter(instance, &calls::ENTER_EVENT_MODE, Of::<M>::enter_event_mode) }
}

pub unsafe fn fmi3EnterContinuousTimeMode<M: Model>(instance: Instance) -> Status {
    let call = &calls::ENTER_CONTINUOUS_TIME_MODE;
    // SAFETY: see above.
    unsafe { enter(instance, call, Of::<M>::enter_continuous_time_mode) }
}

/// States outlive any step, so `noSetFMUStatePriorToCurrentPoint` changes nothing.
pub unsafe fn fmi3CompletedIntegratorStep<M: Model>(
    instance: Instance,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
    enterEventMode: *mut Boolean,
    terminateSimulation: *mut Boolean,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: the master passes room for the answers.
        let (event, end) = unsafe {
            (
                room("enterEventMode", enterEventMode)?,
                room("terminateSimulation", terminateSimulation)?,
            )
        };
        end.write(instance.completed_integrator_step()?.into());
        event.write(Boolean::FALSE);
        Ok(())
    };
    // SAFETY: see above.
    unsafe { enter(instance, &calls::COMPLETED_INTEGRATOR_STEP, body) }
}

pub unsafe fn fmi3SetTime<M: Model>(instance: Instance, time: Float64) -> Status {
    // SAFETY: see above.
    unsafe { enter(instance, &calls::SET_TIME, |instance: &mut Of<M>| instance.set_time(time)) }
}

pub unsafe fn fmi3SetContinuousStates<M: Model>(
    instance: Instance,
    continuousStates: *const Float64,
    nContinuousStates: usize,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: the master passes an array of the length it states.
        let states = unsafe { input("continuousStates", continuousStates, nContinuousStates) }?;
        instance.set_continuous_states(states)
    };
    // SAFETY: see above.
    unsafe { enter(instance, &calls::SET_CONTINUOUS_STATES, body) }
}

/// Reads a value for each state.
///
/// # Safety
/// `instance` is NULL or a live instance that no other thread is using, `values` leads to room for `length`
/// elements.
unsafe fn per_state<M: Model>(
    instance: Instance,
    call: &Call,
    argument: &'static str,
    values: *mut Float64,
    length: usize,
    get: impl FnOnce(&mut Of<M>, &mut [MaybeUninit<Float64>]) -> Outcome,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: by this function's contract.
        get(instance, unsafe { output(argument, values, length) }?)
    };
    // SAFETY: by this function's contract.
    unsafe { enter(instance, call, body) }
}

fn fill(room: &mut [MaybeUninit<Float64>], numbers: &[f64]) {
    for (place, &number) in room.iter_mut().zip(numbers) {
        place.write(number);
    }
}

pub unsafe fn fmi3GetContinuousStateDerivatives<M: Model>(
    instance: Instance,
    derivatives: *mut Float64,
    nContinuousStates: usize,
) -> Status {
    let get = |instance: &mut Of<M>, room: &mut [_]| {
        instance.derivatives(nContinuousStates, |numbers| fill(room, numbers))
    };
    let call = &calls::GET_CONTINUOUS_STATE_DERIVATIVES;
    // SAFETY: the master passes an array of the length it states; likewise below.
    unsafe { per_state(instance, call, "derivatives", derivatives, nContinuousStates, get) }
}

pub unsafe fn fmi3GetContinuousStates<M: Model>(
    instance: Instance,
    continuousStates: *mut Float64,
    nContinuousStates: usize,
) -> Status {
    let get = |instance: &mut Of<M>, room: &mut [_]| {
        instance.continuous_states(nContinuousStates, |numbers| fill(room, numbers))
    };
    let call = &calls::GET_CONTINUOUS_STATES;
    // SAFETY: see above.
    unsafe {
        per_state(instance, call, "continuousStates", continuousStates, nContinuousStates, get)
    }
}

pub unsafe fn fmi3GetNominalsOfContinuousStates<M: Model>(
    instance: Instance,
    nominals: *mut Float64,
    nContinuousStates: usize,
) -> Status {
    let get = |instance: &mut Of<M>, room: &mut [MaybeUninit<Float64>]| {
        instance.nominals(nContinuousStates, |i, nominal| {
            room[i].write(nominal);
        })
    };
    let call = &calls::GET_NOMINALS_OF_CONTINUOUS_STATES;
    // SAFETY: see above.
    unsafe { per_state(instance, call, "nominals", nominals, nContinuousStates, get) }
}

pub unsafe fn fmi3GetEventIndicators<M: Model>(
    instance: Instance,
    _eventIndicators: *mut Float64,
    nEventIndicators: usize,
) -> Status {
    let body = |instance: &mut Of<M>| instance.event_indicators(nEventIndicators);
    // SAFETY: the master passes one of its instances; likewise below.
    unsafe { enter(instance, &calls::GET_EVENT_INDICATORS, body) }
}

pub unsafe fn fmi3GetNumberOfEventIndicators<M: Model>(
    instance: Instance,
    nEventIndicators: *mut usize,
) -> Status {
    let body = |_: &mut Of<M>| {
        // SAFETY: the master passes room for the number.
        unsafe { store("nEventIndicators", nEventIndicators, EVENT_INDICATORS) }
    };
    // SAFETY: see above.
    unsafe { enter(instance, &calls::GET_NUMBER_OF_EVENT_INDICATORS, body) }
}

pub unsafe fn fmi3GetNumberOfContinuousStates<M: Model>(
    instance: Instance,
    nContinuousStates: *mut usize,
) -> Status {
    let body = |_: &mut Of<M>| {
        // SAFETY: the master passes room for the number.
        unsafe { store("nContinuousStates", nContinuousStates, table::states::<M>()) }
    };
    // SAFETY: see above.
    unsafe { enter(instance, &calls::GET_NUMBER_OF_CONTINUOUS_STATES, body) }
}
