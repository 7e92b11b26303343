//! The table of what a master sees: value reference = row.
//!
//! XML, getters, setters, documentation and dependencies are loops over its rows.

use crate::model::{Model, Simulation};
use crate::short::short;

/// Most states and inputs together: each has a bit in [`Dependencies`].
pub const MOST_KNOWNS: usize = 64;

/// A unit with the exponents of its base units and, where users think in another one, how to show
/// it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name, as in the XML.
    pub name: &'static str,
    /// Name of the quantity that it measures; also the name of its type in the XML.
    pub quantity: Option<&'static str>,
    /// Exponents of kg, m, s, rad.
    pub base: [i32; 4],
    /// Name of the display unit and its size in the unit's inverse: shown = value * factor.
    pub display: Option<(&'static str, f64)>,
}

impl Unit {
    /// The unit of pure numbers.
    pub const ONE: Self = Self { name: "1", quantity: None, base: [0; 4], display: None };
    /// Seconds.
    pub const SECOND: Self = Self::new("s", Some("Time"), [0, 0, 1, 0]);

    /// A unit that is shown as it is.
    pub const fn new(name: &'static str, quantity: Option<&'static str>, base: [i32; 4]) -> Self {
        Self { name, quantity, base, display: None }
    }

    /// The unit, shown in another one: shown = value * factor.
    pub const fn displayed_as(self, name: &'static str, factor: f64) -> Self {
        Self { display: Some((name, factor)), ..self }
    }
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

/// On which states and inputs a variable depends, and how. A bit for every state by number, then one
/// for every input; each in one mask only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dependencies {
    /// In any way.
    pub dependent: u64,
    /// Linearly, with a factor that is fixed after initialisation.
    pub fixed: u64,
    /// Linearly, with a factor that never changes.
    pub constant: u64,
}

impl Dependencies {
    /// On nothing.
    pub const NONE: Self = Self { dependent: 0, fixed: 0, constant: 0 };
    /// On every state and input, in any way.
    pub const ALL: Self = Self { dependent: u64::MAX, ..Self::NONE };

    /// On what has a bit in the mask, in any way.
    pub const fn dependent(mask: u64) -> Self {
        Self { dependent: mask, ..Self::NONE }
    }

    /// Linearly, with a factor that is fixed after initialisation.
    pub const fn fixed(mask: u64) -> Self {
        Self { fixed: mask, ..Self::NONE }
    }

    /// Linearly, with a factor that never changes.
    pub const fn constant(mask: u64) -> Self {
        Self { constant: mask, ..Self::NONE }
    }
}

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
        unit: Unit,
        description: &'static str,
        role: Role<M>,
        dependencies: Dependencies,
    ) -> Self {
        let kind = Kind::Real(unit);
        Self { name, description, kind, role, range: None, nominal: None, dependencies }
    }

    /// The input of this number; it starts at zero.
    pub const fn input(
        number: usize,
        name: &'static str,
        unit: Unit,
        description: &'static str,
    ) -> Self {
        Self::real(name, unit, description, Role::Input(number), Dependencies::NONE)
    }

    /// An output.
    pub const fn output(
        name: &'static str,
        unit: Unit,
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
        unit: Unit,
        description: &'static str,
    ) -> Self {
        let itself = Dependencies::constant(1 << number);
        Self::real(name, unit, description, Role::OutputState(number), itself)
    }

    /// The state of this number.
    pub const fn local_state(
        number: usize,
        name: &'static str,
        unit: Unit,
        description: &'static str,
    ) -> Self {
        Self::real(name, unit, description, Role::LocalState(number), Dependencies::NONE)
    }

    /// The time derivative of the state of this number.
    pub const fn derivative(
        number: usize,
        name: &'static str,
        unit: Unit,
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
        unit: Unit,
        description: &'static str,
        get: fn(&M::Simulation) -> f64,
    ) -> Self {
        Self::real(name, unit, description, Role::Calculated(get), Dependencies::NONE)
    }

    /// The variable with a smallest and a largest value.
    pub const fn within(self, range: [f64; 2]) -> Self {
        Self { range: Some(range), ..self }
    }

    /// The state with a typical size.
    pub const fn with_nominal(self, nominal: f64) -> Self {
        Self { nominal: Some(nominal), ..self }
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

    /// Whether a value would be taken.
    ///
    /// # Errors
    /// [`Refused`] if the variable is no input or parameter, or if the value is not finite, out of
    /// range, or names no item.
    pub fn check(&self, value: f64) -> Result<(), Refused> {
        let refuse = |expected: String| Err(Refused { variable: self.name, value, expected });
        if !self.settable() {
            return refuse(
                "only inputs and parameters can be set, and states while the master integrates"
                    .into(),
            );
        }
        if !value.is_finite() {
            return refuse("a finite number is needed".into());
        }
        if let Some([min, max]) = self.range
            && !(min..=max).contains(&value)
        {
            return refuse(format!("the range is [{}, {}]", short(min), short(max)));
        }
        match self.kind {
            Kind::Enumeration(_, items)
                if !items.iter().any(|&(_, number, _)| f64::from(number) == value) =>
            {
                let names: Vec<_> =
                    items.iter().map(|(name, n, _)| format!("{n} {name}")).collect();
                refuse(format!("choose one of {}", names.join(", ")))
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
        self.check(value)?;
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

/// The variable with this name.
pub fn find<M: Model>(name: &str) -> Option<&'static Variable<M>> {
    M::VARIABLES.iter().find(|variable| variable.name == name)
}

/// Number of states.
pub const fn states<M: Model>() -> usize {
    let (mut row, mut count) = (0, 0);
    while row < M::VARIABLES.len() {
        if matches!(M::VARIABLES[row].role, Role::OutputState(_) | Role::LocalState(_)) {
            count += 1;
        }
        row += 1;
    }
    count
}

/// Number of inputs.
pub const fn inputs<M: Model>() -> usize {
    let (mut row, mut count) = (0, 0);
    while row < M::VARIABLES.len() {
        if matches!(M::VARIABLES[row].role, Role::Input(_)) {
            count += 1;
        }
        row += 1;
    }
    count
}

/// The row of a state.
///
/// # Panics
/// There is no such state: [`check`] refuses tables with gaps.
pub fn state<M: Model>(number: usize) -> &'static Variable<M> {
    let is =
        |role: &Role<M>| matches!(*role, Role::OutputState(i) | Role::LocalState(i) if i == number);
    M::VARIABLES.iter().find(|variable| is(&variable.role)).expect("the table has all states")
}

/// Rows of the variables that [`Dependencies`] number: the states, then the inputs.
pub fn known_rows<M: Model>() -> Vec<usize> {
    let mut rows = vec![0; states::<M>() + inputs::<M>()];
    for (row, variable) in M::VARIABLES.iter().enumerate() {
        match variable.role {
            Role::OutputState(i) | Role::LocalState(i) => rows[i] = row,
            Role::Input(i) => rows[states::<M>() + i] = row,
            _ => {}
        }
    }
    rows
}

/// Stops the compiler at a table that no master could use: a name twice, states or inputs that are not
/// numbered from zero on, a derivative without its state, more than [`MOST_KNOWNS`].
pub const fn check<M: Model>() {
    let table = M::VARIABLES;
    let (states, inputs) = (states::<M>(), inputs::<M>());
    assert!(states + inputs <= MOST_KNOWNS, "too many states and inputs");
    let (mut seen_states, mut seen_inputs, mut row) = (0_u64, 0_u64, 0);
    while row < table.len() {
        let mut other = row + 1;
        while other < table.len() {
            assert!(!same(table[row].name, table[other].name), "two variables have the same name");
            other += 1;
        }
        match table[row].role {
            Role::OutputState(i) | Role::LocalState(i) => {
                assert!(i < states && seen_states & 1 << i == 0, "states are numbered from 0 on");
                seen_states |= 1 << i;
            }
            Role::Input(i) => {
                assert!(i < inputs && seen_inputs & 1 << i == 0, "inputs are numbered from 0 on");
                seen_inputs |= 1 << i;
            }
            Role::Derivative(i) => assert!(i < states, "a derivative belongs to a state"),
            _ => {}
        }
        row += 1;
    }
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}
