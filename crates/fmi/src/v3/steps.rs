//! Steps of FMI 3.0: a step that the model ends is no failure, and one that it cannot do changes nothing.

use crate::failure::{Failure, Outcome};
use crate::instance::{Instance, LARGEST};
use crate::model::{Model, Remedy, Simulation};
use crate::phase::Phase;
use crate::status::Status;
use crate::steps::Reach;
use crate::table::{MOST_KNOWNS, inputs};

impl<M: Model> Instance<M> {
    /// `fmi3DoStep` for a master that is not called within a step; [`Instance::ended`] tells whether the
    /// simulation ends at the time reached.
    ///
    /// # Errors
    /// Those of [`Instance::do_step`]; after the status discard nothing has changed.
    pub fn whole_step(&mut self, point: f64, step: f64) -> Outcome {
        let end = self.end_of_step(point, step)?;
        self.remember(&mut [0.0; MOST_KNOWNS])?;
        self.leg(end, Reach::End)
    }

    /// Remembers where a step begins, and what the inputs are.
    ///
    /// # Errors
    /// Those of [`Model::start`].
    pub(crate) fn remember(&mut self, inputs: &mut [f64; MOST_KNOWNS]) -> Outcome {
        let mut numbers = std::mem::take(&mut self.start_of_step);
        let simulation = self.running()?;
        let present = simulation.inputs();
        inputs[..present.len()].copy_from_slice(present);
        if let Some(saving) = &M::Simulation::SAVING {
            numbers.clear();
            numbers.reserve(saving.count);
            (saving.save)(simulation, &mut numbers);
        }
        self.start_of_step = numbers;
        Ok(())
    }

    /// Lets the inputs move from their values at the start of the step to the present ones at its end, linearly.
    ///
    /// # Errors
    /// Those of [`Model::start`].
    pub(crate) fn interpolate(&mut self, start: &[f64; MOST_KNOWNS], end: f64) -> Outcome {
        let simulation = self.running()?;
        let length = end - simulation.time();
        for (number, &start) in start.iter().enumerate().take(inputs::<M>()) {
            let Some(moving) = &M::Simulation::INPUT_DERIVATIVES else { continue };
            let slope = (simulation.inputs()[number] - start) / length;
            // Zero too: a step that returned early may have left another slope. What is too steep is a jump.
            let slope = if slope.abs() <= LARGEST {
                simulation.set_input(number, start);
                slope
            } else {
                0.0
            };
            (moving.set)(simulation, number, 1, slope);
        }
        Ok(())
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
