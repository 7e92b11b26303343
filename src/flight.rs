//! A flight: parameters and inputs in, states and outputs out, step by step. Knows no FMI.

mod inputs;
mod left;
mod ready;
mod snapshot;
mod steered;
mod tangent;

pub use inputs::{INPUT_ORDER, INPUTS, Inputs};
pub use ready::method;
pub use snapshot::Snapshot;

use crate::air::Limited;
use crate::data::Data;
use crate::dynamics::trim::Trim;
use crate::dynamics::{Outputs, numberless};
use crate::error::Error;
use crate::parameters::Parameters;
use crate::solve::{Arrival, DOP853, Integrator, MOST_TRIALS, System};
use crate::vehicle::{Control, Gust, STATES, State, Vehicle};
use left::left;
use ready::Ready;
use std::sync::Arc;
use steered::{Steered, in_effect};

/// Tolerance of a master that asks for none.
pub const DEFAULT_TOLERANCE: f64 = 1e-8;
/// First guess of the integrator's step, s: a tenth of a radian of the fastest mode.
const FIRST_STEP: f64 = 1e-3;

/// What a flight shows at an instant.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Outputs.
    pub outputs: Outputs,
    /// Time derivatives of the states.
    pub derivatives: State,
    /// Controls in effect.
    pub control: Control,
}

/// A flight. A failed call leaves it as it was, but for [`Flight::advance`], which stops at the
/// last valid instant.
#[derive(Debug, Clone)]
pub struct Flight {
    data: Arc<Data>,
    parameters: Parameters,
    inputs: Inputs,
    time: f64,
    integrator: Integrator,
    state: State,
    /// Vehicle and trim, once initialised.
    ready: Option<Box<Ready>>,
    /// Derivatives at the current state and controls, if known.
    slope: Option<State>,
    /// What is shown, if known.
    sample: Option<Sample>,
}

impl Flight {
    /// A flight on the ground: default parameters, zero inputs.
    ///
    /// # Errors
    /// [`Error::Data`] if the data are not those of a vehicle.
    pub fn new() -> Result<Self, Error> {
        let data = Arc::new(Data::embedded()?);
        Ok(Self {
            parameters: Parameters::new(&data),
            data,
            inputs: Inputs::ZERO,
            time: 0.0,
            integrator: Integrator::new(DEFAULT_TOLERANCE, FIRST_STEP),
            state: [0.0; STATES],
            ready: None,
            slope: None,
            sample: None,
        })
    }

    /// Parameters.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Changes parameters; the flight has to be initialised again.
    pub fn change(&mut self, edit: impl FnOnce(&mut Parameters)) {
        edit(&mut self.parameters);
        self.ready = None;
        self.slope = None;
        self.sample = None;
    }

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

    /// Sets a derivative of one input for the next step; orders from 1 to [`INPUT_ORDER`].
    pub fn set_input_derivative(&mut self, index: usize, order: usize, value: f64) {
        self.inputs.set_derivative(index, order, value);
    }

    /// Start time (s) and relative tolerance of the integration.
    pub fn set_experiment(&mut self, start: f64, tolerance: f64) {
        self.time = start;
        self.integrator = Integrator::new(tolerance, FIRST_STEP);
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// State; zeros before initialisation.
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
    pub fn check(&mut self) -> Result<(), Error> {
        self.initialise()?;
        self.check_numbers()?;
        let Some(ready) = &self.ready else { return Ok(()) };
        let (control, gust) = self.control(ready);
        if ready.vehicle.holds(&self.state, &control, gust) {
            return Ok(());
        }
        Err(left(ready, &self.state, &self.inputs, self.time))
    }

    /// Whether the equations have numbers here.
    fn check_numbers(&self) -> Result<(), Error> {
        numberless(&self.state).map_or(Ok(()), |Limited { variable, value, limits: [min, max] }| {
            Err(Error::Numberless { variable, value, min, max })
        })
    }

    /// Vehicle, once initialised.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        self.ready.as_ref().map(|ready| &*ready.vehicle)
    }

    /// Trim, once initialised; without trim, the start values with zero controls.
    pub fn trim(&self) -> Option<&Trim> {
        self.ready.as_ref().map(|ready| &ready.trim)
    }

    /// Builds the vehicle and finds the initial state. Does nothing if that is done already.
    ///
    /// # Errors
    /// [`Error::Trim`] if there is no trim, [`Error::Value`] if the start values lie outside the
    /// region where the curve fits hold.
    pub fn initialise(&mut self) -> Result<(), Error> {
        let Self { ready, state, data, parameters, .. } = self;
        Ready::of(ready, state, data, parameters).map(|_| ())
    }

    /// Controls in effect, cut to the actuators' limits, and gust.
    fn control(&self, ready: &Ready) -> (Control, Gust) {
        in_effect(&ready.vehicle, &ready.base, &self.inputs.values)
    }

    /// What a control asks for, and its limits, if its actuator cannot do it.
    pub fn beyond_limits(&self, control: usize) -> Option<(f64, [f64; 2])> {
        let ready = self.ready.as_ref()?;
        let range @ [min, max] = ready.vehicle.ranges()[control];
        let asked = ready.base[control] + self.inputs.values[control];
        // A master that aims at the limit itself may miss it by rounding.
        let slack = 1e-9 * (max - min);
        (asked < min - slack || asked > max + slack).then_some((asked, range))
    }

    /// Outputs and derivatives at the current instant, computed once per state and input.
    ///
    /// # Errors
    /// [`Error::Numberless`] if an integrator from outside went too far; those of
    /// [`Flight::initialise`], if the flight is not initialised yet.
    pub fn evaluate(&mut self) -> Result<(), Error> {
        self.initialise()?;
        if let (None, Some(ready)) = (&self.sample, &self.ready) {
            self.check_numbers()?;
            let (control, gust) = self.control(ready);
            let (derivatives, outputs) = match self.slope {
                Some(slope) => (slope, ready.vehicle.outputs(&self.state, &control, gust, &slope)),
                None => ready.vehicle.both(&self.state, &control, gust),
            };
            self.slope = Some(derivatives);
            self.sample = Some(Sample { outputs, derivatives, control });
        }
        Ok(())
    }

    /// What was last evaluated, if it still holds.
    pub fn sample(&self) -> Option<&Sample> {
        self.sample.as_ref()
    }

    /// Flies until `end` (s), exactly. Inputs are constant, or follow the derivatives that were given
    /// for this step.
    ///
    /// # Errors
    /// [`Error::Envelope`] on leaving the region where the curve fits hold, [`Error::Fuel`] when the
    /// tanks run empty: time and state are then those of the last valid instant. [`Error::StepSize`] if
    /// the tolerance cannot be held, [`Error::TooLong`] if the interval takes too many steps.
    pub fn advance(&mut self, end: f64) -> Result<(), Error> {
        let Self { ready, state, data, parameters, inputs, .. } = self;
        let ready = Ready::of(ready, state, data, parameters)?;
        let steered = Steered {
            vehicle: &ready.vehicle,
            base: ready.base,
            inputs,
            held: (!inputs.moving())
                .then(|| in_effect(&ready.vehicle, &ready.base, &inputs.values)),
        };
        let length = end - self.time;
        // Counted from here, so that a late start costs no digits.
        let interval = [0.0, length];
        // Inputs that move may meet a limit within the step: a method of few stages overlooks that.
        let (integrator, slope) = (&mut self.integrator, &mut self.slope);
        let arrival = if steered.steady() {
            integrator.advance(&mut *ready.method, &steered, state, interval, slope)
        } else {
            integrator.advance(&mut &DOP853, &steered, state, interval, slope)
        };
        let flown = match arrival {
            Arrival::Complete => length,
            Arrival::Left(flown) | Arrival::Stuck(flown) | Arrival::Long(flown) => flown,
        };
        *inputs = inputs.after(flown);
        self.sample = None;
        match arrival {
            Arrival::Complete => {
                self.time = end;
                Ok(())
            }
            Arrival::Left(flown) => {
                self.time += flown;
                Err(left(ready, state, inputs, self.time))
            }
            Arrival::Stuck(flown) => {
                self.time += flown;
                Err(Error::StepSize { tolerance: self.integrator.tolerance, time_s: self.time })
            }
            Arrival::Long(flown) => {
                self.time += flown;
                Err(Error::TooLong { asked_s: length, trials: MOST_TRIALS, time_s: self.time })
            }
        }
    }
}
