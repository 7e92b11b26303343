//! Functions for co-simulation only (section 4.2).

use super::entry::{Environment, enter, look};
use crate::abi::room;
use crate::failure::{Failure, Outcome};
use crate::instance::Instance as Of;
use crate::model::{Model, Simulation};
use crate::steps::Reach;
use crate::table::MOST_KNOWNS;
use crate::v3::calls;
use crate::v3::sys::{Boolean, Float64, Instance, Status};
use core::mem::MaybeUninit;

/// Never legal, as there is no event mode in co-simulation.
pub unsafe fn fmi3EnterStepMode<M: Model>(instance: Instance) -> Status {
    let body = |_: &mut Of<M>| Err(Failure::NotProvided { capability: "an event mode" });
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::ENTER_STEP_MODE, body) }
}

/// Where `fmi3DoStep` puts its answers.
struct Answers<'a> {
    event_handling_needed: &'a mut MaybeUninit<Boolean>,
    terminate_simulation: &'a mut MaybeUninit<Boolean>,
    early_return: &'a mut MaybeUninit<Boolean>,
    last_successful_time: &'a mut MaybeUninit<Float64>,
}

impl Answers<'_> {
    fn write<M: Model>(self, instance: &Of<M>, end: f64, early_return_allowed: bool) {
        let time = instance.time();
        self.event_handling_needed.write(Boolean::FALSE);
        self.terminate_simulation.write(instance.ended().into());
        self.early_return.write((early_return_allowed && time < end).into());
        self.last_successful_time.write(time);
    }
}

/// States outlive any step, so `noSetFMUStatePriorToCurrentPoint` changes nothing.
pub unsafe fn fmi3DoStep<M: Model>(
    instance: Instance,
    currentCommunicationPoint: Float64,
    communicationStepSize: Float64,
    _noSetFMUStatePriorToCurrentPoint: Boolean,
    eventHandlingNeeded: *mut Boolean,
    terminateSimulation: *mut Boolean,
    earlyReturn: *mut Boolean,
    lastSuccessfulTime: *mut Float64,
) -> Status {
    if instance.is_null() {
        return Status::Error;
    }
    // SAFETY: not NULL, hence one of the master's instances.
    let environment = unsafe { look::<M>(instance).1 };
    let answers = || -> Result<Answers, Failure> {
        // SAFETY: the master passes room for the answers.
        unsafe {
            Ok(Answers {
                event_handling_needed: room("eventHandlingNeeded", eventHandlingNeeded)?,
                terminate_simulation: room("terminateSimulation", terminateSimulation)?,
                early_return: room("earlyReturn", earlyReturn)?,
                last_successful_time: room("lastSuccessfulTime", lastSuccessfulTime)?,
            })
        }
    };
    let [mut end, mut target] = [0.0; 2];
    // A model that cannot pause within a step has not promised to.
    let looks = environment.update.is_some() && M::Simulation::INTERNAL_STEP.is_some();
    let reach = if looks { Reach::Once } else { Reach::End };
    // Where the inputs are when the step ends is asked before it begins.
    let mut asks = looks && environment.moves_inputs;
    let mut inputs = [0.0; MOST_KNOWNS];
    let first = |instance: &mut Of<M>| {
        answers()?;
        end = instance.end_of_step(currentCommunicationPoint, communicationStepSize)?;
        target = end;
        instance.remember(&mut inputs)?;
        if asks {
            instance.pause();
            return Ok(());
        }
        leg(instance, answers, end, target, reach, &environment)
    };
    // SAFETY: one of the master's instances.
    let mut status = unsafe { enter(instance, &calls::DO_STEP, first) };
    let Some(update) = environment.update else { return status };
    loop {
        // SAFETY: one of the master's instances, with which no call is busy.
        let now = match unsafe { look::<M>(instance) } {
            (of, _) if status == Status::Ok && of.paused() => of.time(),
            _ => return status,
        };
        let time = if asks { end } else { now };
        let may_return = !asks && environment.early_return_allowed && time < end;
        let (mut requested, mut wanted) = (Boolean::FALSE, time);
        let [known, may_return_early] = [!asks, may_return].map(Boolean::from);
        let (set, answers_to) = (Boolean::TRUE, (&raw mut requested, &raw mut wanted));
        // SAFETY: the master's callback and its pointer; it may call the instance, to which there is no
        // reference here.
        unsafe {
            update(
                environment.pointer,
                time,
                set,
                known,
                known,
                may_return_early,
                answers_to.0,
                answers_to.1,
            );
        }
        if may_return && requested.is_true() {
            // A time in the past, or none at all, is now.
            target = wanted.max(time).min(target);
        }
        let interpolate = std::mem::take(&mut asks);
        let next = |instance: &mut Of<M>| {
            instance.resume();
            if interpolate {
                instance.interpolate(&inputs, end)?;
            }
            leg(instance, answers, end, target, reach, &environment)
        };
        // SAFETY: one of the master's instances.
        status = unsafe { enter(instance, &calls::RESUME_STEP, next) };
    }
}

/// Goes on towards `target`; the last leg writes the answers.
fn leg<'a, M: Model>(
    instance: &mut Of<M>,
    answers: impl FnOnce() -> Result<Answers<'a>, Failure>,
    end: f64,
    target: f64,
    reach: Reach,
    environment: &Environment,
) -> Outcome {
    let arrived = |instance: &Of<M>| instance.ended() || instance.time() >= target;
    if !arrived(instance) {
        instance.leg(target, reach)?;
        if reach == Reach::Once && !instance.ended() {
            instance.pause();
            return Ok(());
        }
    }
    answers()?.write(instance, end, environment.early_return_allowed);
    Ok(())
}
