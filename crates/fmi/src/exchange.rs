//! Model exchange: the master integrates.
//!
//! There are no events and no event indicators.

use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::{Exchange, Model, ModelError, Remedy, Simulation};
use crate::phase::Phase;
use crate::status::Status;
use crate::table;

/// Number of event indicators.
pub const EVENT_INDICATORS: usize = 0;

impl<M: Model> Instance<M> {
    /// What Model Exchange needs.
    pub(crate) fn exchange() -> Result<&'static Exchange<M::Simulation>, Failure> {
        let exchange: &Option<_> = &M::Simulation::EXCHANGE;
        let missing = Failure::NotProvided { capability: "Model Exchange" };
        exchange.as_ref().ok_or(missing)
    }

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

    /// `fmi2CompletedIntegratorStep`: whether the simulation should end here.
    ///
    /// # Errors
    /// [`Failure::Model`] if the model cannot be evaluated.
    pub fn completed_integrator_step(&mut self) -> Result<bool, Failure> {
        let Err(error) = (Self::exchange()?.completed_step)(self.running()?) else {
            return Ok(false);
        };
        if error.remedy() == Remedy::Reset {
            return Err(error.into());
        }
        self.life.ended = true;
        self.log.push(Status::Discard, || error.to_string());
        Ok(true)
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
        (Self::exchange()?.set_time)(self.running()?, time);
        Ok(())
    }

    /// `fmi2SetContinuousStates`.
    ///
    /// # Errors
    /// [`Failure::Argument`], [`Failure::State`]; the state is then as it was.
    pub fn set_continuous_states(&mut self, states: &[f64]) -> Outcome {
        expect("number of states", states.len(), table::states::<M>())?;
        for (number, &value) in states.iter().enumerate() {
            check_state(|| table::state::<M>(number).name, value)?;
        }
        (Self::exchange()?.set_states)(self.running()?, states);
        Ok(())
    }

    /// `fmi2GetDerivatives`; `write` gets the derivatives.
    ///
    /// # Errors
    /// [`Failure::Argument`]; [`Failure::Model`] if the model cannot be evaluated, as at a trial state
    /// without numbers; [`Failure::NotFinite`]. No value is written then.
    pub fn derivatives(&mut self, length: usize, write: impl FnOnce(&[f64])) -> Outcome {
        expect("number of states", length, table::states::<M>())?;
        let derivatives = M::Simulation::derivatives(self.running()?.evaluate()?);
        if let Some(number) = derivatives.iter().position(|value| !value.is_finite()) {
            let (variable, value) = (table::state::<M>(number).name, derivatives[number]);
            return Err(Failure::NotFinite { variable, value });
        }
        write(derivatives);
        Ok(())
    }

    /// `fmi2GetContinuousStates`; `write` gets the states.
    ///
    /// # Errors
    /// [`Failure::Argument`]; [`Failure::Model`] if there is no initial state.
    pub fn continuous_states(&mut self, length: usize, write: impl FnOnce(&[f64])) -> Outcome {
        expect("number of states", length, table::states::<M>())?;
        write(self.running()?.states());
        Ok(())
    }

    /// `fmi2GetNominalsOfContinuousStates`; `write` gets position and value.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn nominals(&self, length: usize, mut write: impl FnMut(usize, f64)) -> Outcome {
        expect("number of states", length, table::states::<M>())?;
        for number in 0..length {
            write(number, table::state::<M>(number).nominal.unwrap_or(1.0));
        }
        Ok(())
    }

    /// `fmi2GetEventIndicators`: there are none to get.
    ///
    /// # Errors
    /// [`Failure::Argument`].
    pub fn event_indicators(&self, length: usize) -> Outcome {
        expect("number of event indicators", length, EVENT_INDICATORS)
    }

    /// Whether the simulation should end.
    pub fn ended(&self) -> bool {
        self.life.ended
    }
}

/// Whether a master's integrator can try a state.
pub(crate) fn check_state(variable: impl FnOnce() -> &'static str, value: f64) -> Outcome {
    if value.is_finite() { Ok(()) } else { Err(Failure::State { variable: variable(), value }) }
}

fn expect(argument: &'static str, given: usize, needed: usize) -> Outcome {
    if given == needed {
        return Ok(());
    }
    let expected = format!("the model description says {needed}");
    Err(Failure::Argument { argument, value: given as f64, expected })
}
