//! One variable: what it is to a master, and where its value is.

use crate::kinds::{Dependencies, Items, Kind, Unit};
use crate::model::{Model, Simulation};
use crate::short::short;

/// What a variable is to a master and where its value is; only legal pairs of causality and
/// variability can be said.
#[derive(Debug)]
pub enum Role<M: Model> {
    /// Continuous input, by number.
    Input(usize),
    /// Continuous output that is no state.
    Output(fn(&SampleOf<M>) -> f64),
    /// Output that is also the state of this number.
    OutputState(usize),
    /// Local state of this number.
    LocalState(usize),
    /// Local time derivative of the state of this number.
    Derivative(usize),
    /// Fixed parameter: set before the simulation starts.
    Parameter {
        /// Reads it.
        get: fn(&M) -> f64,
        /// Sets it.
        set: fn(&mut M, f64),
    },
    /// Parameter computed when the simulation starts.
    Calculated(fn(&M::Simulation) -> f64),
}

impl<M: Model> Clone for Role<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M: Model> Copy for Role<M> {}

/// What a model's outputs are read from.
pub type SampleOf<M> = <<M as Model>::Simulation as Simulation>::Sample;

/// One variable.
#[derive(Debug)]
pub struct Variable<M: Model> {
    /// Name, flat.
    pub name: &'static str,
    /// Description for users.
    pub description: &'static str,
    /// Values.
    pub kind: Kind,
    /// Causality and variability.
    pub role: Role<M>,
    /// Smallest and largest value.
    pub range: Option<[f64; 2]>,
    /// Typical size, for states.
    pub nominal: Option<f64>,
    /// Dependencies of outputs and derivatives.
    pub dependencies: Dependencies,
    /// Whether it takes and shows NaN and infinities: a measurement that failed is one.
    pub accepts_non_finite: bool,
    /// The items of an enumeration that a model has, if its data leave some out.
    pub items: Option<fn(&M) -> Items>,
}

impl<M: Model> Clone for Variable<M> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<M: Model> Copy for Variable<M> {}

impl<M: Model> Variable<M> {
    const fn real(
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
        role: Role<M>,
        dependencies: Dependencies,
    ) -> Self {
        let kind = Kind::Real(unit);
        let (range, nominal, items, accepts_non_finite) = (None, None, None, false);
        Self {
            name,
            description,
            kind,
            role,
            range,
            nominal,
            dependencies,
            accepts_non_finite,
            items,
        }
    }

    /// The input of this number; it starts at zero.
    pub const fn input(
        number: usize,
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
    ) -> Self {
        Self::real(name, unit, description, Role::Input(number), Dependencies::NONE)
    }

    /// An output.
    pub const fn output(
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
        dependencies: Dependencies,
        get: fn(&SampleOf<M>) -> f64,
    ) -> Self {
        Self::real(name, unit, description, Role::Output(get), dependencies)
    }

    /// The state of this number as an output.
    pub const fn output_state(
        number: usize,
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
    ) -> Self {
        let itself = Dependencies::constant(1 << number);
        Self::real(name, unit, description, Role::OutputState(number), itself)
    }

    /// The state of this number.
    pub const fn local_state(
        number: usize,
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
    ) -> Self {
        Self::real(name, unit, description, Role::LocalState(number), Dependencies::NONE)
    }

    /// The time derivative of the state of this number.
    pub const fn derivative(
        number: usize,
        name: &'static str,
        unit: &'static Unit,
        dependencies: Dependencies,
    ) -> Self {
        let description = "Time derivative of the state";
        Self::real(name, unit, description, Role::Derivative(number), dependencies)
    }

    /// A parameter.
    pub const fn parameter(
        name: &'static str,
        kind: Kind,
        description: &'static str,
        get: fn(&M) -> f64,
        set: fn(&mut M, f64),
    ) -> Self {
        Self {
            kind,
            ..Self::real(
                name,
                Unit::ONE,
                description,
                Role::Parameter { get, set },
                Dependencies::NONE,
            )
        }
    }

    /// A parameter that is computed when the simulation starts.
    pub const fn calculated(
        name: &'static str,
        unit: &'static Unit,
        description: &'static str,
        get: fn(&M::Simulation) -> f64,
    ) -> Self {
        Self::real(name, unit, description, Role::Calculated(get), Dependencies::NONE)
    }

    /// The variable with a smallest and a largest value.
    pub const fn within(self, range: [f64; 2]) -> Self {
        Self { range: Some(range), ..self }
    }

    /// The input or output, also if it is NaN or infinite: the model knows what to do then.
    pub const fn accepting_non_finite(self) -> Self {
        Self { accepts_non_finite: true, ..self }
    }

    /// The state with a typical size.
    pub const fn with_nominal(self, nominal: f64) -> Self {
        Self { nominal: Some(nominal), ..self }
    }

    /// The enumeration with the items that the data of a model leave it.
    pub const fn with_items(self, items: fn(&M) -> Items) -> Self {
        Self { items: Some(items), ..self }
    }

    /// The values that it takes in a model.
    pub fn kind_in(&self, model: &M) -> Kind {
        match (self.kind, self.items) {
            (Kind::Enumeration(name, _), Some(items)) => Kind::Enumeration(name, items(model)),
            (kind, _) => kind,
        }
    }

    /// Whether a master can set it at all.
    pub const fn settable(&self) -> bool {
        matches!(self.role, Role::Input(_) | Role::Parameter { .. })
    }

    /// Value to start from, of what can be set.
    pub fn start(&self, model: &M) -> Option<f64> {
        match self.role {
            Role::Input(_) => Some(0.0),
            Role::Parameter { get, .. } => Some(get(model)),
            _ => None,
        }
    }

    /// Present value; Booleans as 0 and 1, enumerations as their number.
    ///
    /// # Errors
    /// Those of [`Simulation::evaluate`], of outputs and derivatives.
    pub fn value(&self, model: &M, simulation: &mut M::Simulation) -> Result<f64, M::Error> {
        Ok(match self.role {
            Role::Input(number) => simulation.inputs()[number],
            Role::Output(get) => get(simulation.evaluate()?),
            Role::OutputState(number) | Role::LocalState(number) => simulation.states()[number],
            Role::Derivative(number) => {
                <M::Simulation as Simulation>::derivatives(simulation.evaluate()?)[number]
            }
            Role::Parameter { get, .. } => get(model),
            Role::Calculated(get) => get(simulation),
        })
    }

    /// Whether a model would take a value.
    ///
    /// # Errors
    /// [`Refused`] if the variable is no input or parameter, or if the value is not finite, out of
    /// range, or names no item.
    pub fn check(&self, model: &M, value: f64) -> Result<(), Refused> {
        let refuse = |expected: String| Err(Refused { variable: self.name, value, expected });
        if !self.settable() {
            return refuse(
                "only inputs and parameters can be set, and states while the master integrates"
                    .into(),
            );
        }
        if !(value.is_finite() || self.accepts_non_finite) {
            return refuse("a finite number is needed".into());
        }
        if let Some([min, max]) = self.range
            && !(min..=max).contains(&value)
        {
            return refuse(format!("the range is [{}, {}]", short(min), short(max)));
        }
        match self.kind_in(model) {
            Kind::Enumeration(_, items)
                if !items.iter().any(|&(_, number, _)| f64::from(number) == value) =>
            {
                let names: Vec<_> =
                    items.iter().map(|(name, n, _)| format!("{n} {name}")).collect();
                refuse(format!("choose one of {}", names.join(", ")))
            }
            Kind::Integer if value != f64::from(value as i32) => {
                refuse("a whole number of 32 bits is needed".into())
            }
            Kind::Boolean if value != 0.0 && value != 1.0 => {
                refuse("choose 0 (false) or 1 (true)".into())
            }
            _ => Ok(()),
        }
    }

    /// Sets a parameter; minus zero becomes zero, so that equal models have equal bits.
    ///
    /// # Errors
    /// Those of [`Variable::check`], and [`Refused`] of an input, which belongs to the simulation; the
    /// model is then as it was.
    pub fn set(&self, model: &mut M, value: f64) -> Result<(), Refused> {
        self.check(model, value)?;
        let Role::Parameter { set, .. } = self.role else {
            let expected = "it is no parameter".into();
            return Err(Refused { variable: self.name, value, expected });
        };
        set(model, value + 0.0);
        Ok(())
    }
}

/// A value that a variable cannot take.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{variable} = {} is refused: {expected}", short(*value))]
pub struct Refused {
    /// Name of the variable.
    pub variable: &'static str,
    /// The refused value.
    pub value: f64,
    /// What would be accepted.
    pub expected: String,
}
