//! Reading and setting variables: a call with several references does all or nothing.

use crate::exchange::check_state;
use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::kinds::{Kind, Unit};
use crate::model::{Model, Simulation};
use crate::phase::Phase;
use crate::standard::Standard;
use crate::table::MOST_KNOWNS;
use crate::variable::{Role, Variable};

/// Value reference of the independent variable in FMI 3.0: it belongs to every model, and rows are appended to
/// the table.
pub const TIME: u32 = i32::MAX as u32;
const TIME_KIND: Kind = Kind::Real(Unit::SECOND);

/// The type of values that a function works on.
#[derive(Debug, Clone, Copy)]
pub struct Type {
    /// Its name in the standard.
    pub name: &'static str,
    /// Its standard.
    pub standard: Standard,
    /// Whether variables of this kind have it.
    pub fits: fn(&Kind) -> bool,
}

impl Type {
    const fn fmi2(name: &'static str, fits: fn(&Kind) -> bool) -> Self {
        Self { name, standard: Standard::Fmi2, fits }
    }
}

pub(crate) const REAL: Type = Type::fmi2("Real", |kind| matches!(kind, Kind::Real(_)));
const INTEGER: Type = Type::fmi2("Integer or Enumeration", |kind| {
    matches!(kind, Kind::Integer | Kind::Enumeration(..))
});
const BOOLEAN: Type = Type::fmi2("Boolean", |kind| matches!(kind, Kind::Boolean));
const STRING: Type = Type::fmi2("String", |_| false);

/// The type of a variable in the words of a standard.
fn name_of(kind: &Kind, standard: Standard) -> &'static str {
    match (standard, kind) {
        (Standard::Fmi2, Kind::Real(_)) => "Real",
        (Standard::Fmi2, Kind::Integer | Kind::Enumeration(..)) => "Integer or Enumeration",
        (Standard::Fmi3, Kind::Real(_)) => "Float64",
        (Standard::Fmi3, Kind::Integer) => "Int32",
        (Standard::Fmi3, Kind::Enumeration(..)) => "Enumeration (Int64)",
        (_, Kind::Boolean) => "Boolean",
    }
}

/// The variable behind a value reference, if it is of the type asked for.
pub(crate) fn variable<M: Model>(
    reference: u32,
    asked: &Type,
) -> Result<&'static Variable<M>, Failure> {
    if reference == TIME && asked.standard == Standard::Fmi3 {
        let (variable, has) = ("time", name_of(&TIME_KIND, asked.standard));
        return Err(match (asked.fits)(&TIME_KIND) {
            true => Failure::NoDerivative { variable, served: "can only be read" },
            false => Failure::WrongType { variable, reference, asked: asked.name, has },
        });
    }
    let Some(variable) = M::VARIABLES.get(reference as usize) else {
        return Err(Failure::UnknownReference { reference, count: M::VARIABLES.len() });
    };
    if (asked.fits)(&variable.kind) {
        return Ok(variable);
    }
    let has = name_of(&variable.kind, asked.standard);
    Err(Failure::WrongType { variable: variable.name, reference, asked: asked.name, has })
}

impl<M: Model> Instance<M> {
    /// `fmi2GetReal`; `write` gets the position in the array and the value.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`]; [`Failure::Model`] if the model
    /// cannot be evaluated, [`Failure::NotFinite`]. No value is written then.
    pub fn get_real(&mut self, references: &[u32], write: impl FnMut(usize, f64)) -> Outcome {
        self.get(&REAL, references, write)
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
        self.get(&INTEGER, references, |i, value| write(i, value as i32))
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
        self.get(&BOOLEAN, references, |i, value| write(i, value != 0.0))
    }

    /// `fmi2GetString` and `fmi2SetString`: there are no such variables.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`].
    pub fn strings(&self, references: &[u32]) -> Outcome {
        Self::check_type(&STRING, references)
    }

    /// Whether all variables are of a type.
    ///
    /// # Errors
    /// [`Failure::UnknownReference`], [`Failure::WrongType`].
    pub fn check_type(asked: &Type, references: &[u32]) -> Outcome {
        references.iter().try_for_each(|&reference| variable::<M>(reference, asked).map(drop))
    }

    /// Reads variables of a type; `write` gets the position in the array and the value.
    ///
    /// Outputs are computed when read, so they fit inputs set since the last step. The standards
    /// forbid masters to ask for that in co-simulation; some do, and consistent values harm nobody.
    /// States are there, also a trial state for which no outputs can be computed.
    ///
    /// # Errors
    /// Those of [`Instance::get_real`], and [`Failure::NoValueYet`].
    pub fn get(
        &mut self,
        asked: &Type,
        references: &[u32],
        mut write: impl FnMut(usize, f64),
    ) -> Outcome {
        for &reference in references {
            if !self.is_time(reference, asked) {
                variable::<M>(reference, asked)?;
            }
        }
        for &reference in references {
            self.value_of(reference, asked)?;
        }
        for (i, &reference) in references.iter().enumerate() {
            write(i, self.value_of(reference, asked)?);
        }
        Ok(())
    }

    /// Whether a reference is that of the independent variable.
    fn is_time(&self, reference: u32, asked: &Type) -> bool {
        reference == TIME && asked.standard == Standard::Fmi3 && (asked.fits)(&TIME_KIND)
    }

    /// Present value, if it is finite.
    fn value_of(&mut self, reference: u32, asked: &Type) -> Result<f64, Failure> {
        if self.is_time(reference, asked) {
            return Ok(self.time());
        }
        let variable = variable::<M>(reference, asked)?;
        if self.life.phase == Phase::Instantiated && !variable.settable() {
            return Err(Failure::NoValueYet { variable: variable.name });
        }
        let value = self.value(variable)?;
        let refused = Failure::NotFinite { variable: variable.name, value };
        let shown = value.is_finite() || variable.accepts_non_finite;
        shown.then_some(value).ok_or(refused)
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
    /// [`Failure::State`], [`Failure::NotSettable`], [`Failure::Refused`]. No value is set then.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Outcome {
        self.set(&REAL, references, &|i| values[i])
    }

    /// `fmi2SetInteger`, also for enumerations.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.set(&INTEGER, references, &|i| values[i].into())
    }

    /// `fmi2SetBoolean`.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Outcome {
        self.set(&BOOLEAN, references, &|i| values[i].into())
    }

    /// Sets variables of a type.
    ///
    /// Inputs are accepted before initialisation too: FMI 2.0 says no, but several masters set
    /// all start values there. So are states while the master integrates, which several of them do
    /// in place of `fmi2SetContinuousStates`: its text allows what its table forbids.
    ///
    /// # Errors
    /// Those of [`Instance::set_real`].
    pub fn set(
        &mut self,
        asked: &Type,
        references: &[u32],
        value: &dyn Fn(usize) -> f64,
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
                _ if !variable.settable() => {
                    return Err(Failure::NotSettable { variable: variable.name, value: value(i) });
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
        self.advise();
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
