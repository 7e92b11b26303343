//! Reading and setting variables: a call with several references does all or nothing.

use crate::exchange::check_state;
use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::kinds::Kind;
use crate::model::{Model, Simulation};
use crate::table::MOST_KNOWNS;
use crate::variable::{Role, Variable};

/// The standard's names of the types of values.
pub(crate) const REAL: &str = "Real";
const INTEGER: &str = "Integer or Enumeration";
const BOOLEAN: &str = "Boolean";
const STRING: &str = "String";

fn type_of<M: Model>(variable: &Variable<M>) -> &'static str {
    match variable.kind {
        Kind::Real(_) => REAL,
        Kind::Enumeration(..) => INTEGER,
        Kind::Boolean => BOOLEAN,
    }
}

/// The variable behind a value reference, if it is of the type asked for.
pub(crate) fn variable<M: Model>(
    reference: u32,
    asked: &'static str,
) -> Result<&'static Variable<M>, Failure> {
    let Some(variable) = M::VARIABLES.get(reference as usize) else {
        return Err(Failure::UnknownReference { reference, count: M::VARIABLES.len() });
    };
    let has = type_of(variable);
    if has == asked {
        Ok(variable)
    } else {
        Err(Failure::WrongType { variable: variable.name, reference, asked, has })
    }
}

impl<M: Model> Instance<M> {
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
        references.iter().try_for_each(|&reference| variable::<M>(reference, STRING).map(drop))
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
        for &reference in references {
            variable::<M>(reference, asked)?;
        }
        for &reference in references {
            let variable = variable(reference, asked)?;
            let value = self.value(variable)?;
            if !value.is_finite() {
                return Err(Failure::NotFinite { variable: variable.name, value });
            }
        }
        for (i, &reference) in references.iter().enumerate() {
            write(i, self.value(variable(reference, asked)?)?);
        }
        Ok(())
    }

    /// Present value. What was set needs no simulation.
    fn value(&mut self, variable: &Variable<M>) -> Result<f64, Failure> {
        match (variable.role, &self.simulation) {
            (Role::Parameter { get, .. }, _) => Ok(get(&self.model)),
            (Role::Input(number), None) => Ok(self.pending.values[number]),
            _ => {
                let (model, simulation) = self.with_model()?;
                Ok(variable.value(model, simulation)?)
            }
        }
    }

    /// `fmi2SetReal`.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`], [`Failure::TooLate`],
    /// [`Failure::State`], [`Failure::Refused`]. No value is set then.
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
        let before = self.before_start();
        let exchange = Self::exchange().ok().filter(|_| self.exchanging());
        let mut moved = None;
        for (i, &reference) in references.iter().enumerate() {
            let variable = variable::<M>(reference, asked)?;
            match variable.role {
                Role::OutputState(number) | Role::LocalState(number) if exchange.is_some() => {
                    check_state(|| variable.name, value(i))?;
                    let (states, _) = moved.get_or_insert_with(|| self.present_states());
                    states[number] = value(i);
                }
                Role::Parameter { .. } if !before => {
                    return Err(Failure::TooLate { variable: variable.name, value: value(i) });
                }
                _ => variable.check(&self.model, value(i))?,
            }
        }
        for (i, &reference) in references.iter().enumerate() {
            let variable = variable::<M>(reference, asked)?;
            match variable.role {
                Role::Parameter { .. } => {
                    variable.set(&mut self.model, value(i))?;
                    self.simulation = None;
                }
                Role::Input(number) => self.set_input(number, value(i) + 0.0),
                _ => {}
            }
        }
        if let (Some((states, count)), Some(exchange)) = (moved, exchange) {
            (exchange.set_states)(self.running()?, &states[..count]);
        }
        self.advise("fmi2SetReal");
        Ok(())
    }

    fn set_input(&mut self, number: usize, value: f64) {
        self.pending.values[number] = value;
        if let Some(simulation) = &mut self.simulation {
            simulation.set_input(number, value);
        }
    }

    /// The present states, and how many they are.
    fn present_states(&self) -> ([f64; MOST_KNOWNS], usize) {
        let mut states = [0.0; MOST_KNOWNS];
        let present = self.simulation.as_ref().map_or(&[][..], |simulation| simulation.states());
        states[..present.len()].copy_from_slice(present);
        (states, present.len())
    }
}
