//! Functions that co-simulation and model exchange have in common (section 2.3).

use super::entry::enter;
use crate::abi::{input, room, string};
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::v3::calls;
use crate::v3::sys::{Boolean, Float64, FmiString, Instance, Status};
use core::ffi::c_char;

pub unsafe fn fmi3GetVersion<M: Model>() -> *const c_char {
    c"3.0".as_ptr()
}

pub unsafe fn fmi3SetDebugLogging<M: Model>(
    instance: Instance,
    loggingOn: Boolean,
    nCategories: usize,
    categories: *const FmiString,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: the master passes nCategories C strings.
        let names: Result<Vec<_>, _> = unsafe { input("categories", categories, nCategories) }?
            .iter()
            .map(|&name| unsafe { string("categories", name) })
            .collect();
        instance.set_debug_logging(loggingOn.is_true(), &names?)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::SET_DEBUG_LOGGING, body) }
}

pub unsafe fn fmi3EnterInitializationMode<M: Model>(
    instance: Instance,
    toleranceDefined: Boolean,
    tolerance: Float64,
    startTime: Float64,
    stopTimeDefined: Boolean,
    stopTime: Float64,
) -> Status {
    let body = |instance: &mut Of<M>| {
        let tolerance = toleranceDefined.is_true().then_some(tolerance);
        let stop = stopTimeDefined.is_true().then_some(stopTime);
        instance.setup_experiment(tolerance, startTime, stop)?;
        instance.enter_initialization_mode()
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::ENTER_INITIALIZATION_MODE, body) }
}

pub unsafe fn fmi3ExitInitializationMode<M: Model>(instance: Instance) -> Status {
    let call = &calls::EXIT_INITIALIZATION_MODE;
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, call, Of::<M>::exit_initialization_mode) }
}

pub unsafe fn fmi3Terminate<M: Model>(instance: Instance) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::TERMINATE, Of::<M>::terminate) }
}

pub unsafe fn fmi3Reset<M: Model>(instance: Instance) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::RESET, Of::<M>::reset) }
}

pub unsafe fn fmi3UpdateDiscreteStates<M: Model>(
    instance: Instance,
    discreteStatesNeedUpdate: *mut Boolean,
    terminateSimulation: *mut Boolean,
    nominalsOfContinuousStatesChanged: *mut Boolean,
    valuesOfContinuousStatesChanged: *mut Boolean,
    nextEventTimeDefined: *mut Boolean,
    nextEventTime: *mut Float64,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: the master passes room for the answers.
        unsafe {
            let answers = [
                room("discreteStatesNeedUpdate", discreteStatesNeedUpdate)?,
                room("terminateSimulation", terminateSimulation)?,
                room("nominalsOfContinuousStatesChanged", nominalsOfContinuousStatesChanged)?,
                room("valuesOfContinuousStatesChanged", valuesOfContinuousStatesChanged)?,
                room("nextEventTimeDefined", nextEventTimeDefined)?,
            ];
            room("nextEventTime", nextEventTime)?.write(0.0);
            for (answer, value) in
                answers.into_iter().zip([false, instance.ended(), false, false, false])
            {
                answer.write(value.into());
            }
        }
        Ok(())
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::UPDATE_DISCRETE_STATES, body) }
}
