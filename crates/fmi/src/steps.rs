//! Co-Simulation: steps.

use crate::clock::same_instant;
use crate::failure::{Failure, Outcome};
use crate::instance::{Experiment, Instance, LARGEST};
use crate::model::{Model, ModelError, Remedy, Simulation};
use crate::phase::Phase;

/// How far a step goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// To its end.
    End,
    /// One step of the model's own integrator, if it has any: [`Simulation::INTERNAL_STEP`].
    Once,
}

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
        let end = self.end_of_step(point, step)?;
        self.advance(end, Reach::End)
    }

    /// Where a step ends (s), if it can be taken.
    ///
    /// # Errors
    /// [`Failure::Argument`], [`Failure::CommunicationPoint`] and [`Failure::PastStop`].
    pub(crate) fn end_of_step(&self, point: f64, step: f64) -> Result<f64, Failure> {
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
        Ok(end)
    }

    /// Moves on towards `end`, s.
    ///
    /// # Errors
    /// [`Failure::Model`]; with the status discard time and state are those of the last valid instant.
    pub(crate) fn advance(&mut self, end: f64, reach: Reach) -> Outcome {
        // A step below the resolution of time ends where it starts.
        if end == self.time() {
            return Ok(());
        }
        let move_on = match (reach, M::Simulation::INTERNAL_STEP) {
            (Reach::Once, Some(once)) => once,
            _ => M::Simulation::advance,
        };
        let Err(error) = move_on(self.running()?, end) else {
            self.advise();
            return Ok(());
        };
        (self.life.phase, self.life.ended) = match error.remedy() {
            Remedy::End => (Phase::StepFailed, true),
            Remedy::ShorterStep => (Phase::StepFailed, false),
            Remedy::Reset => (Phase::Error, self.life.ended),
        };
        Err(error.into())
    }
}
