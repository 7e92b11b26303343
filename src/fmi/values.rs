//! Reading and setting variables: a call with several references does all or nothing.

use crate::fmi::exchange::check_state;
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle::Phase;
use crate::variables::{Kind, Role, TABLE, Variable};

/// The standard's names of the types of values.
pub(super) const REAL: &str = "Real";
const INTEGER: &str = "Integer or Enumeration";
const BOOLEAN: &str = "Boolean";
const STRING: &str = "String";

fn type_of(variable: &Variable) -> &'static str {
    match variable.kind {
        Kind::Real(_) => REAL,
        Kind::Enumeration(..) => INTEGER,
        Kind::Boolean => BOOLEAN,
    }
}

/// The variable behind a value reference, if it is of the type asked for.
pub(super) fn variable(reference: u32, asked: &'static str) -> Result<&'static Variable, Failure> {
    let Some(variable) = TABLE.get(reference as usize) else {
        return Err(Failure::UnknownReference { reference, last: TABLE.len() - 1 });
    };
    let has = type_of(variable);
    if has == asked {
        Ok(variable)
    } else {
        Err(Failure::WrongType { variable: variable.name, reference, asked, has })
    }
}

impl Instance {
    /// `fmi2GetReal`; `write` gets the position in the array and the value.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`]; [`Failure::Model`] if the model
    /// cannot be evaluated, [`Failure::NotFinite`]. No value is written then.
    pub fn get_real(&mut self, references: &[u32], write: impl FnMut(usize, f64)) -> Outcome {
        self.read(references, REAL, write)
    }

    /// `fmi2GetInteger`, also for enumerations.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn get_integer(
        &mut self,
        references: &[u32],
        mut write: impl FnMut(usize, i32),
    ) -> Outcome {
        self.read(references, INTEGER, |i, value| write(i, value as i32))
    }

    /// `fmi2GetBoolean`.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn get_boolean(
        &mut self,
        references: &[u32],
        mut write: impl FnMut(usize, bool),
    ) -> Outcome {
        self.read(references, BOOLEAN, |i, value| write(i, value != 0.0))
    }

    /// `fmi2GetString` and `fmi2SetString`: there are no such variables.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn strings(&self, references: &[u32]) -> Outcome {
        references.iter().try_for_each(|&reference| variable(reference, STRING).map(drop))
    }

    /// Outputs are computed when read, so they fit inputs set since the last step. The standard
    /// forbids masters to ask for that in co-simulation; some do, and consistent values harm nobody.
    /// States are there, also a trial state for which no outputs can be computed.
    fn read(
        &mut self,
        references: &[u32],
        asked: &'static str,
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        let (mut initialised, mut computed) = (false, false);
        for &reference in references {
            match variable(reference, asked)?.role {
                Role::Input(_) | Role::Parameter => {}
                Role::OutputState(_) | Role::LocalState(_) | Role::Calculated => initialised = true,
                Role::Output | Role::Derivative(_) => computed = true,
            }
        }
        if computed {
            self.flight.evaluate()?;
        } else if initialised {
            self.flight.initialise()?;
        }
        for &reference in references {
            let variable = variable(reference, asked)?;
            let value = variable.get(&self.flight);
            if !value.is_finite() {
                return Err(Failure::NotFinite { variable: variable.name, value });
            }
        }
        for (i, &reference) in references.iter().enumerate() {
            write(i, variable(reference, asked)?.get(&self.flight));
        }
        Ok(())
    }

    /// `fmi2SetReal`.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::TooLate`],
    /// [`Failure::State`]; [`Failure::Model`] if a value is refused. No value is set then.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Outcome {
        self.write(references, REAL, |i| values[i])
    }

    /// `fmi2SetInteger`, also for enumerations.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.write(references, INTEGER, |i| values[i].into())
    }

    /// `fmi2SetBoolean`.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.write(references, BOOLEAN, |i| values[i].into())
    }

    /// Inputs are accepted before initialisation too: the standard says no, but several masters set
    /// all start values there. So are states while the master integrates, which several of them do
    /// in place of `fmi2SetContinuousStates`: the standard's text allows what its table forbids.
    fn write(
        &mut self,
        references: &[u32],
        asked: &'static str,
        value: impl Fn(usize) -> f64,
    ) -> Outcome {
        let before = matches!(self.phase(), Phase::Instantiated | Phase::InitializationMode);
        let exchanging = self.exchanging();
        let mut state = *self.flight.state();
        let mut moved = false;
        for (i, &reference) in references.iter().enumerate() {
            let variable = variable(reference, asked)?;
            match variable.role {
                Role::OutputState(number) | Role::LocalState(number) if exchanging => {
                    check_state(variable.name, value(i))?;
                    state[number] = value(i);
                    moved = true;
                }
                Role::Parameter if !before => {
                    return Err(Failure::TooLate { variable: variable.name, value: value(i) });
                }
                _ => variable.check(value(i))?,
            }
        }
        for (i, &reference) in references.iter().enumerate() {
            let variable = variable(reference, asked)?;
            if variable.settable() {
                variable.set(&mut self.flight, value(i))?;
            }
        }
        if moved {
            self.flight.set_state(&state);
        }
        self.say_limits("fmi2SetReal");
        Ok(())
    }
}
