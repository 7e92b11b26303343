//! Model exchange: the master integrates.
//!
//! There are no events: saturation depends on inputs alone and leaves the rates continuous, so no
//! indicator could tell an integrator anything about its states.

use crate::error::Error;
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle::Phase;
use crate::fmi::sys::Status;
use crate::vehicle::{NOMINAL, STATE_NAMES, STATES, State};

/// Number of event indicators.
pub const EVENT_INDICATORS: usize = 0;

impl Instance {
    /// `fmi2EnterEventMode`.
    ///
    /// # Errors
    /// None.
    pub fn enter_event_mode(&mut self) -> Outcome {
        self.life.phase = Phase::EventMode;
        Ok(())
    }

    /// `fmi2EnterContinuousTimeMode`.
    ///
    /// # Errors
    /// None.
    pub fn enter_continuous_time_mode(&mut self) -> Outcome {
        self.life.phase = Phase::ContinuousTimeMode;
        Ok(())
    }

    /// `fmi2CompletedIntegratorStep`: whether the simulation should end, as the curve fits do not
    /// hold here.
    ///
    /// # Errors
    /// [`Failure::Model`] if the model cannot be evaluated.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Failure> {
        match self.flight.check() {
            Ok(()) => Ok(false),
            Err(
                error @ (Error::Envelope { .. } | Error::Fuel { .. } | Error::Numberless { .. }),
            ) => {
                self.life.ended = true;
                self.log.push(Status::Discard, || format!("fmi2CompletedIntegratorStep: {error}"));
                Ok(true)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// `fmi2SetTime`.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn set_time(&mut self, time: f64) -> Outcome {
        if !time.is_finite() {
            return Err(Failure::Argument {
                argument: "time",
                value: time,
                expected: "a finite number is needed".to_string(),
            });
        }
        self.flight.set_time(time);
        Ok(())
    }

    /// `fmi2SetContinuousStates`.
    ///
    /// # Errors
    /// [`Failure::Argument`], [`Failure::State`]; the state is then as it was.
    pub fn set_continuous_states(&mut self, states: &[f64]) -> Outcome {
        let state: &State = states.try_into().map_err(|_| count("nx", states.len(), STATES))?;
        for (variable, &value) in STATE_NAMES.into_iter().zip(state) {
            check_state(variable, value)?;
        }
        self.flight.set_state(state);
        Ok(())
    }

    /// `fmi2GetDerivatives`.
    ///
    /// # Errors
    /// [`Failure::Argument`]; [`Failure::Model`] if the model cannot be evaluated, as at a trial state
    /// without numbers; [`Failure::NotFinite`]. No value is written then.
    pub fn derivatives(&mut self, length: usize) -> Result<State, Failure> {
        expect("nx", length, STATES)?;
        self.flight.evaluate()?;
        let rates = self.flight.sample().map_or([0.0; STATES], |sample| sample.derivatives);
        match rates.iter().position(|value| !value.is_finite()) {
            Some(i) => Err(Failure::NotFinite { variable: STATE_NAMES[i], value: rates[i] }),
            None => Ok(rates),
        }
    }

    /// `fmi2GetContinuousStates`.
    ///
    /// # Errors
    /// [`Failure::Argument`]; [`Failure::Model`] if there is no initial state.
    pub fn continuous_states(&mut self, length: usize) -> Result<State, Failure> {
        expect("nx", length, STATES)?;
        self.flight.initialise()?;
        Ok(*self.flight.state())
    }

    /// `fmi2GetNominalsOfContinuousStates`.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn nominals(&self, length: usize) -> Result<State, Failure> {
        expect("nx", length, STATES)?;
        Ok(NOMINAL)
    }

    /// `fmi2GetEventIndicators`: there are none to get.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn event_indicators(&self, length: usize) -> Outcome {
        expect("ni", length, EVENT_INDICATORS)
    }

    /// Whether the simulation should end.
    pub fn ended(&self) -> bool {
        self.life.ended
    }
}

/// Whether a master's integrator can try a state.
pub(super) fn check_state(variable: &'static str, value: f64) -> Outcome {
    if value.is_finite() { Ok(()) } else { Err(Failure::State { variable, value }) }
}

fn count(argument: &'static str, given: usize, needed: usize) -> Failure {
    let expected = format!("the model description says {needed}");
    Failure::Argument { argument, value: given as f64, expected }
}

fn expect(argument: &'static str, given: usize, needed: usize) -> Outcome {
    if given == needed { Ok(()) } else { Err(count(argument, given, needed)) }
}
