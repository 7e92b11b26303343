//! Co-Simulation: steps, and their status.

use crate::clock::same_instant;
use crate::failure::{Failure, Outcome};
use crate::instance::{Experiment, Instance, LARGEST};
use crate::model::{Model, ModelError, Remedy, Simulation};
use crate::v2::calls::Phase;
use crate::v2::sys::StatusKind;

impl<M: Model> Instance<M> {
    /// `fmi2DoStep`. Rounding in `point` is accepted; the step then starts at the instance's own
    /// time, and ends exactly at `point + step`: the clock follows the master's, and what one point was
    /// rounded by is not in the next.
    ///
    /// # Errors
    /// [`Failure::Argument`], [`Failure::CommunicationPoint`] and [`Failure::PastStop`] change
    /// nothing. After [`Failure::Model`] with the status discard, time and state are those of the last
    /// valid instant.
    pub fn do_step(&mut self, point: f64, step: f64) -> Outcome {
        let time = self.time();
        if !(step > 0.0 && step <= LARGEST) {
            return Err(Failure::Argument {
                argument: "communicationStepSize",
                value: step,
                expected: format!("a positive number up to {LARGEST:e} is needed"),
            });
        }
        let end = point + step;
        if !(point.is_finite() && same_instant(point, time, step)) || end < time {
            return Err(Failure::CommunicationPoint { asked: point, step, time });
        }
        if let Some(Experiment { stop, .. }) = self.life.experiment
            && end > stop
            && !same_instant(end, stop, step)
        {
            return Err(Failure::PastStop { end, stop });
        }
        // A step below the resolution of time ends where it starts.
        if end == time {
            return Ok(());
        }
        let Err(error) = self.running()?.advance(end) else {
            self.advise("fmi2DoStep");
            return Ok(());
        };
        (self.life.phase, self.life.ended) = match error.remedy() {
            Remedy::End => (Phase::StepFailed, true),
            Remedy::ShorterStep => (Phase::StepFailed, false),
            Remedy::Reset => (Phase::Error, self.life.ended),
        };
        Err(error.into())
    }

    /// `fmi2CancelStep`: never legal, as no step is ever pending.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn cancel_step(&mut self) -> Outcome {
        Err(Failure::NotProvided { capability: "canRunAsynchronuously = false" })
    }

    /// `fmi2GetRealStatus`: the end of the last step, or the instant at which it ended early.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn real_status(&self, kind: StatusKind) -> Result<f64, Failure> {
        if kind == StatusKind::LAST_SUCCESSFUL_TIME {
            return Ok(self.time());
        }
        Err(Failure::NoStatus { kind, asked: "fmi2Real" })
    }

    /// `fmi2GetBooleanStatus`: whether the simulation should end.
    ///
    /// # Errors
    /// [`Failure::NoStatus`].
    pub fn boolean_status(&self, kind: StatusKind) -> Result<bool, Failure> {
        if kind == StatusKind::TERMINATED {
            return Ok(self.life.ended);
        }
        Err(Failure::NoStatus { kind, asked: "fmi2Boolean" })
    }
}
