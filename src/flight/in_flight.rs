//! In flight: inputs, states and outputs, step by step.

use super::controlled_vehicle::{ControlledVehicle, in_effect};
use super::envelope_error::envelope_error;
use super::inputs::Inputs;
use super::limits;
use super::method::Method;
use crate::dynamics::trim::Trim;
use crate::dynamics::{Outputs, out_of_domain};
use crate::error::Error;
use crate::solve::{Integrator, MAX_TRIALS, Outcome};
use crate::vehicle::{CONTROLS, Control, Gust, State, Vehicle};

/// Outputs, derivatives and controls at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Outputs.
    pub outputs: Outputs,
    /// Time derivatives of the states.
    pub derivatives: State,
    /// Controls in effect.
    pub control: Control,
}

/// A flight, from [`Setup::start`](super::Setup::start). A failed call leaves it as it was, but for [`Flight::advance`], which
/// stops at the last valid instant.
#[derive(Debug, Clone)]
pub struct Flight {
    pub(super) vehicle: Box<Vehicle>,
    pub(super) trim: Trim,
    /// What the inputs are added to: the trim where they are deviations.
    pub(super) base: Control,
    /// Integrates between the master's instants.
    pub(super) method: Box<Method>,
    pub(super) inputs: Inputs,
    pub(super) time: f64,
    /// Of an interval that is flown step by step: its start and how far it was flown, s.
    pub(super) legs: Option<[f64; 2]>,
    pub(super) integrator: Integrator,
    pub(super) state: State,
    /// Derivatives at the current state and controls, if known.
    pub(super) slope: Option<State>,
    /// What was last evaluated, if it still holds.
    pub(super) sample: Option<Sample>,
    /// Whether it was said that a control is beyond its limit.
    pub(super) limit_said: [bool; CONTROLS],
}

impl Flight {
    /// Inputs as they were set.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Sets one input: 0 elevator (rad), 1 fuel ratio, 2 vertical and 3 horizontal gust (m/s).
    pub fn set_input(&mut self, index: usize, value: f64) {
        if self.inputs.values[index] != value {
            self.slope = None;
            self.sample = None;
        }
        self.inputs.set(index, value);
    }

    /// Sets a derivative of one input for the next step; orders from 1 to [`INPUT_ORDER`](super::INPUT_ORDER).
    pub fn set_input_derivative(&mut self, index: usize, order: usize, value: f64) {
        self.inputs.set_derivative(index, order, value);
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// State.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Moves to another instant, as an integrator from outside does.
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// Puts the flight into another state, as an integrator from outside does.
    pub fn set_state(&mut self, state: &State) {
        self.state = *state;
        self.slope = None;
        self.sample = None;
    }

    /// Whether the curve fits hold here, with fuel if it burns.
    ///
    /// # Errors
    /// [`Error::Envelope`] or [`Error::Fuel`] if they do not; those of [`Flight::evaluate`].
    pub fn check(&self) -> Result<(), Error> {
        self.check_numbers()?;
        let (control, gust) = self.control();
        if self.vehicle.holds(&self.state, &control, gust) {
            return Ok(());
        }
        let Self { vehicle, base, state, inputs, .. } = self;
        Err(envelope_error(vehicle, base, state, inputs, self.time))
    }

    /// Whether the equations have numbers here.
    pub(super) fn check_numbers(&self) -> Result<(), Error> {
        out_of_domain(&self.state).map_or(Ok(()), |limited| Err(Error::Numberless { limited }))
    }

    /// Vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Trim; without trim, the start values with zero controls.
    pub fn trim(&self) -> &Trim {
        &self.trim
    }

    /// Controls in effect, cut to the actuators' limits, and gust.
    pub(super) fn control(&self) -> (Control, Gust) {
        in_effect(&self.vehicle, &self.base, &self.inputs.values)
    }

    /// Outputs and derivatives at the current instant, computed once per state and input.
    ///
    /// # Errors
    /// [`Error::Numberless`] if an integrator from outside went too far.
    pub fn evaluate(&mut self) -> Result<&Sample, Error> {
        if self.sample.is_none() {
            self.check_numbers()?;
        }
        let Self { vehicle, base, inputs, state, slope, sample, .. } = self;
        Ok(sample.get_or_insert_with(|| {
            let (control, gust) = in_effect(vehicle, base, &inputs.values);
            let (derivatives, outputs) = match *slope {
                Some(slope) => (slope, vehicle.outputs(state, &control, gust, &slope)),
                None => vehicle.derivatives_and_outputs(state, &control, gust),
            };
            *slope = Some(derivatives);
            Sample { outputs, derivatives, control }
        }))
    }

    /// Flies until `end` (s), exactly. Inputs are constant, or follow the derivatives that were given
    /// for this step.
    ///
    /// # Errors
    /// [`Error::Envelope`] on leaving the region where the curve fits hold, [`Error::Fuel`] when the
    /// tanks run empty: time and state are then those of the last valid instant. [`Error::StepSize`] if
    /// the tolerance cannot be held, [`Error::TooLong`] if the interval takes too many steps.
    pub fn advance(&mut self, end: f64) -> Result<(), Error> {
        self.run(end, false)
    }

    /// Flies towards `end` (s) by one step of the integrator, which may be all of it. Derivatives of inputs that
    /// were given for the way to `end` go on if it is not.
    ///
    /// # Errors
    /// Those of [`Flight::advance`].
    pub fn advance_once(&mut self, end: f64) -> Result<(), Error> {
        self.run(end, true)
    }

    fn run(&mut self, end: f64, once: bool) -> Result<(), Error> {
        let [start, before] = match self.legs.take() {
            Some([start, flown]) if once && start + flown == self.time => [start, flown],
            _ => [self.time, 0.0],
        };
        let Self { vehicle, base, method, state, inputs, .. } = self;
        let moving = inputs.moving();
        let controlled = ControlledVehicle {
            vehicle,
            base: *base,
            inputs,
            held: (!moving).then(|| in_effect(vehicle, base, &inputs.values)),
        };
        let length = end - start;
        // Counted from the start, so that a late one costs no digits, and legs take the steps of the whole.
        let mut from = before;
        let outcome = loop {
            // No method expects the kink of an input that meets a limit.
            let to = if moving {
                inputs.next_limit(&limits::ranges(vehicle, base), from, length)
            } else {
                length
            };
            let (integrator, slope) = (&mut self.integrator, &mut self.slope);
            let outcome =
                integrator.run(&mut **method, &controlled, state, [from, to], slope, once);
            if moving {
                // It is of an instant that may be rounded otherwise than that of the inputs.
                *slope = None;
            }
            match outcome {
                Outcome::Complete if to < length && once => break Outcome::Paused(to),
                Outcome::Complete if to < length => from = to,
                outcome => break outcome,
            }
        };
        let flown = match outcome {
            Outcome::Complete => length,
            Outcome::Invalid(flown)
            | Outcome::StepTooSmall(flown)
            | Outcome::TooManySteps(flown)
            | Outcome::Paused(flown) => flown,
        };
        let paused = matches!(outcome, Outcome::Paused(_));
        *inputs = Inputs { ahead: moving && paused, ..inputs.after(flown - before) };
        // Inputs that move are counted from the present instant.
        self.legs = (paused && !moving).then_some([start, flown]);
        self.sample = None;
        match outcome {
            Outcome::Complete => {
                self.time = end;
                Ok(())
            }
            Outcome::Paused(flown) => {
                self.time = start + flown;
                Ok(())
            }
            Outcome::Invalid(flown) => {
                self.time = start + flown;
                Err(envelope_error(vehicle, base, state, inputs, self.time))
            }
            Outcome::StepTooSmall(flown) => {
                self.time = start + flown;
                Err(Error::StepSize { tolerance: self.integrator.tolerance, time_s: self.time })
            }
            Outcome::TooManySteps(flown) => {
                self.time = start + flown;
                Err(Error::TooLong { asked_s: length, trials: MAX_TRIALS, time_s: self.time })
            }
        }
    }
}
