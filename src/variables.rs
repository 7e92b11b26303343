//! The one table of what a simulation master sees: value reference = row, append only.
//!
//! XML, getters, setters, documentation and dependency information are loops over its rows.

mod hash;
mod table;
mod words;

pub use hash::{MODEL_HASH, guid};
pub use table::TABLE;

use crate::error::Error;
use crate::flight::{Flight, INPUTS};
use crate::short::short;
use crate::vehicle::{NOMINAL, STATES};

/// A unit with the exponents of its base units and, where users think in another one, how to show
/// it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name, as in the XML.
    pub name: &'static str,
    /// Exponents of kg, m, s, rad.
    pub base: [i32; 4],
    /// Name of the display unit and its size in the unit's inverse: shown = value * factor.
    pub display: Option<(&'static str, f64)>,
}

/// What values a variable takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A real number in a unit.
    Real(Unit),
    /// True or false.
    Boolean,
    /// One of a list of named numbers: name of the type, then (name, number, description).
    Enumeration(&'static str, &'static [(&'static str, i32, &'static str)]),
}

/// What a variable is to a master; only legal pairs of causality and variability can be said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Role {
    /// Continuous input, by number.
    Input(usize),
    /// Continuous output that is no state.
    Output,
    /// Output that is also the state of this number.
    OutputState(usize),
    /// Local state of this number.
    LocalState(usize),
    /// Local time derivative of the state of this number.
    Derivative(usize),
    /// Fixed parameter: set before the flight.
    Parameter,
    /// Parameter computed at initialisation.
    Calculated,
}

/// On which states (bits 0 to 15) and inputs (bits 16 to 19) a variable depends, and how: each bit
/// in one mask only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dependencies {
    /// In any way.
    pub dependent: u32,
    /// Linearly, with a factor that is fixed after initialisation.
    pub fixed: u32,
    /// Linearly, with a factor that never changes.
    pub constant: u32,
}

/// One variable.
#[derive(Debug)]
pub struct Variable {
    /// Name, flat.
    pub name: &'static str,
    /// Description for users.
    pub description: &'static str,
    /// Values.
    pub kind: Kind,
    /// Causality and variability.
    pub role: Role,
    /// Smallest and largest value.
    pub range: Option<[f64; 2]>,
    /// Dependencies of outputs and derivatives.
    pub dependencies: Dependencies,
    get: fn(&Flight) -> f64,
    set: Option<fn(&mut Flight, f64)>,
}

impl Variable {
    /// Current value; Booleans as 0 and 1, enumerations as their number. Outputs and derivatives
    /// are those of the last [`Flight::evaluate`].
    pub fn get(&self, flight: &Flight) -> f64 {
        (self.get)(flight)
    }

    /// Whether a master can set it at all.
    pub fn settable(&self) -> bool {
        self.set.is_some()
    }

    /// Whether a value would be taken.
    ///
    /// # Errors
    /// [`Error::Value`] if the variable is no input or parameter, or if the value is not finite,
    /// out of range, or names no item.
    pub fn check(&self, value: f64) -> Result<(), Error> {
        let refuse =
            |expected: String| Error::Value { variable: self.name.to_string(), value, expected };
        if !self.settable() {
            return Err(refuse(
                "only inputs and parameters can be set, and states while the master integrates"
                    .into(),
            ));
        }
        if !value.is_finite() {
            return Err(refuse("a finite number is needed".into()));
        }
        if let Some([min, max]) = self.range
            && !(min..=max).contains(&value)
        {
            return Err(refuse(format!("the range is [{}, {}]", short(min), short(max))));
        }
        match self.kind {
            Kind::Enumeration(_, items)
                if !items.iter().any(|&(_, number, _)| f64::from(number) == value) =>
            {
                let names: Vec<_> =
                    items.iter().map(|(name, n, _)| format!("{n} {name}")).collect();
                Err(refuse(format!("choose one of {}", names.join(", "))))
            }
            Kind::Boolean if value != 0.0 && value != 1.0 => {
                Err(refuse("choose 0 (false) or 1 (true)".into()))
            }
            _ => Ok(()),
        }
    }

    /// Sets a parameter or an input; minus zero becomes zero, so that equal flights have equal bits.
    ///
    /// # Errors
    /// Those of [`Variable::check`]; the flight is then as it was.
    pub fn set(&self, flight: &mut Flight, value: f64) -> Result<(), Error> {
        self.check(value)?;
        if let Some(set) = self.set {
            set(flight, value + 0.0);
        }
        Ok(())
    }

    /// Typical size, for states.
    pub fn nominal(&self) -> Option<f64> {
        match self.role {
            Role::OutputState(i) | Role::LocalState(i) => Some(NOMINAL[i]),
            _ => None,
        }
    }
}

/// The variable with this name.
pub fn find(name: &str) -> Option<&'static Variable> {
    TABLE.iter().find(|variable| variable.name == name)
}

/// Rows of the variables that [`Dependencies`] number: the states, then the inputs.
pub fn known_rows() -> [usize; STATES + INPUTS] {
    let mut rows = [0; STATES + INPUTS];
    for (row, variable) in TABLE.iter().enumerate() {
        match variable.role {
            Role::OutputState(i) | Role::LocalState(i) => rows[i] = row,
            Role::Input(i) => rows[STATES + i] = row,
            _ => {}
        }
    }
    rows
}
