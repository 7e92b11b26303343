//! Steps of FMI 3.0: a step that the model ends is no failure, and one that it cannot do changes nothing.

use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::{Model, Remedy, Simulation};
use crate::phase::Phase;
use crate::status::Status;
use crate::steps::Reach;

impl<M: Model> Instance<M> {
    /// Remembers where a step begins.
    pub(crate) fn remember(&mut self) {
        if let (Some(saving), Some(simulation)) = (&M::Simulation::SAVING, &self.simulation) {
            self.start_of_step.clear();
            self.start_of_step.reserve(saving.count);
            (saving.save)(simulation, &mut self.start_of_step);
        }
    }

    /// Moves on towards `target`, s.
    ///
    /// # Errors
    /// [`Failure::Model`]: with the status discard the step has not begun, and may be shorter.
    pub(crate) fn leg(&mut self, target: f64, reach: Reach) -> Outcome {
        match self.advance(target, reach) {
            Err(Failure::Model { text, remedy: Remedy::End }) => {
                // The call succeeds; the user learns why the simulation ends.
                self.log.push(Status::Discard, || text);
                Ok(())
            }
            Err(Failure::Model { text, remedy: Remedy::ShorterStep }) => {
                let (Some(saving), Some(simulation)) =
                    (&M::Simulation::SAVING, &mut self.simulation)
                else {
                    return Err(Failure::Model { text, remedy: Remedy::Reset });
                };
                (saving.load)(simulation, &self.start_of_step);
                self.life.phase = Phase::StepComplete;
                Err(Failure::Model { text, remedy: Remedy::ShorterStep })
            }
            other => other,
        }
    }

    /// Leaves the instance to the master's callback.
    pub(crate) fn pause(&mut self) {
        self.life.phase = Phase::IntermediateUpdateMode;
    }

    /// Whether the instance waits for the master's callback.
    pub(crate) fn paused(&self) -> bool {
        self.life.phase == Phase::IntermediateUpdateMode
    }

    /// Goes on after the master's callback.
    pub(crate) fn resume(&mut self) {
        self.life.phase = Phase::StepComplete;
    }
}
