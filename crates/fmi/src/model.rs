//! What a model has to offer.
//!
//! A [`Model`] is what a master sets up: the parameters. Starting it gives a [`Simulation`], which has
//! states, inputs and outputs. So no output exists before there is a value for it, and a parameter
//! that changes during initialisation starts the simulation anew.

use crate::identity::hash_of_table;
use crate::variable::Variable;
use std::convert::Infallible;
use std::fmt::{Debug, Display};
use std::path::Path;

/// What a master can do about an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remedy {
    /// Reset the instance, or restore a saved state: error.
    Reset,
    /// Try a shorter step: discard.
    ShorterStep,
    /// End the simulation at the last valid instant: in FMI 2.0 discard, and `fmi2Terminated` is true; in FMI
    /// 3.0 the step succeeds, and `terminateSimulation` is true.
    End,
}

/// An error of a model. Its text is what a user reads in the master's log: it names the variable, the
/// value, the limit and what to do.
pub trait ModelError: Display {
    /// What the master can do.
    fn remedy(&self) -> Remedy {
        Remedy::Reset
    }
}

impl ModelError for Infallible {}

/// What the model description says about a model besides its variables.
#[derive(Debug, Clone, Copy)]
pub struct About {
    /// `modelIdentifier`: the name of the library, a C name.
    pub identifier: &'static str,
    /// `description`.
    pub description: &'static str,
    /// `author`.
    pub author: &'static str,
    /// `version` of the model.
    pub version: &'static str,
    /// `license`.
    pub license: &'static str,
    /// `generationTool`.
    pub tool: &'static str,
    /// What the model reports in the log category `logEvents`.
    pub events: &'static str,
    /// `stopTime` of the default experiment, s.
    pub stop_s: f64,
    /// `stepSize` of the default experiment, s.
    pub step_s: f64,
}

impl About {
    /// A model with this identifier and version, without other texts; its experiment lasts a second.
    pub const fn new(identifier: &'static str, version: &'static str) -> Self {
        Self {
            identifier,
            description: "",
            author: "",
            version,
            license: "",
            tool: concat!("fmi-model ", env!("CARGO_PKG_VERSION")),
            events: "What the model reports",
            stop_s: 1.0,
            step_s: 0.01,
        }
    }
}

/// The parameters of a simulation, and how it starts.
pub trait Model: Clone + Debug + PartialEq + 'static {
    /// What runs with these parameters.
    type Simulation: Simulation<Error = Self::Error>;
    /// Why a model cannot be set up, started or advanced.
    type Error: ModelError;

    /// Texts and default experiment of the model description.
    const ABOUT: About;
    /// All variables: the row is the value reference. Rows are only ever appended.
    const VARIABLES: &'static [Variable<Self>];
    /// The same for the same model only: GUID of the FMU and key of saved states. A model with data
    /// continues this hash with the built-in ones, see [`crate::identity::fnv`].
    const IDENTITY: u128 = hash_of_table(&Self::ABOUT, Self::VARIABLES);
    /// Where the model's data are.
    const RESOURCES: Resources<Self> = Resources::None;
    /// Relative tolerance of a master that asks for none.
    const DEFAULT_TOLERANCE: f64 = 1e-6;
    /// Tolerances that the simulation works with. A master's wish is moved into this range: a setup
    /// that works must not warn.
    const TOLERANCES: [f64; 2] = [1e-12, 1e-2];

    /// The model with its default parameters.
    ///
    /// # Errors
    /// Data that belong to the model do not fit it.
    fn new() -> Result<Self, Self::Error>;

    /// The same for a model with the same data only: [`Model::IDENTITY`] of the built-in ones.
    fn identity(&self) -> u128 {
        Self::IDENTITY
    }

    /// `description`: that of [`Model::ABOUT`], unless the data say more.
    fn description(&self) -> String {
        Self::ABOUT.description.to_string()
    }

    /// Starts a simulation at a time (s), with all inputs zero.
    ///
    /// # Errors
    /// There is no initial state for these parameters.
    fn start(&self, time_s: f64, tolerance: f64) -> Result<Self::Simulation, Self::Error>;

    /// Says what a user may want to know when the initialisation ends; `default` has the parameters
    /// that no one changed.
    fn started(
        &self,
        _default: &Self,
        _simulation: &Self::Simulation,
        _say: &mut dyn FnMut(String),
    ) {
    }
}

/// Data in the resources of a package.
#[derive(Debug)]
pub enum Resources<M: Model> {
    /// There are none: all is built in.
    None,
    /// Read if the token is not that of the built-in data; it must then be that of the data in the folder. For
    /// data that the model description depends on.
    Identified(FromResources<M>),
    /// Read whenever the master says where the resources are: whoever has a package can put other data into
    /// it. For data that the model description does not depend on.
    Replaceable(FromResources<M>),
}

/// Reads a model from a folder.
#[expect(type_alias_bounds, reason = "says what M is")]
pub type FromResources<M: Model> = fn(&Path) -> Result<M, M::Error>;

/// A running simulation. Optional capabilities are constants: without one the model description does
/// not promise it, and the functions of the standard that need it refuse.
pub trait Simulation: Sized + Debug + 'static {
    /// What outputs and derivatives are read from.
    type Sample;
    /// Why a simulation cannot go on.
    type Error: ModelError;

    /// Model Exchange.
    const EXCHANGE: Option<Exchange<Self>> = None;
    /// Inputs that move within a step: `canInterpolateInputs`.
    const INPUT_DERIVATIVES: Option<InputDerivatives<Self>> = None;
    /// Directional derivatives: `providesDirectionalDerivative`, and `maxOutputDerivativeOrder` is 1.
    const TANGENT: Option<Tangent<Self>> = None;
    /// Moves on towards an instant (s) by one step of the model's own integrator: the master may then look in
    /// between its communication points, `providesIntermediateUpdate`. Derivatives of inputs for the way there
    /// hold until it is reached.
    const INTERNAL_STEP: Option<InternalStep<Self>> = None;
    /// State of the FMU: `canGetAndSetFMUstate` and `canSerializeFMUstate`.
    const SAVING: Option<Saving<Self>> = None;

    /// Present time, s.
    fn time(&self) -> f64;

    /// Present inputs, by their number in the table.
    fn inputs(&self) -> &[f64] {
        &[]
    }

    /// Sets an input.
    fn set_input(&mut self, _number: usize, _value: f64) {}

    /// Continuous states, by their number in the table.
    fn states(&self) -> &[f64] {
        &[]
    }

    /// Outputs and derivatives at the present time, states and inputs. Called for every value that is
    /// read: what is expensive is computed once and kept.
    ///
    /// # Errors
    /// The model has no value here.
    fn evaluate(&mut self) -> Result<&Self::Sample, Self::Error>;

    /// Time derivatives of the states, by the states' numbers.
    fn derivatives(_sample: &Self::Sample) -> &[f64] {
        &[]
    }

    /// Moves on to `end_s`, exactly.
    ///
    /// # Errors
    /// With [`Remedy::End`] and [`Remedy::ShorterStep`] time and states are those of the last valid
    /// instant.
    fn advance(&mut self, end_s: f64) -> Result<(), Self::Error>;

    /// Says what works but is probably not meant, once each: called after inputs were set and after
    /// steps, if the master logs events.
    fn advise(&mut self, _say: &mut dyn FnMut(String)) {}
}

/// What Model Exchange needs.
#[derive(Debug)]
pub struct Exchange<S: Simulation> {
    /// Moves to an instant, s.
    pub set_time: fn(&mut S, f64),
    /// Puts the simulation into another state.
    pub set_states: fn(&mut S, &[f64]),
    /// Fails if the simulation should not go on from the state of a completed step.
    pub completed_step: fn(&mut S) -> Result<(), S::Error>,
}

/// What inputs that move within a step need.
#[derive(Debug)]
pub struct InputDerivatives<S: Simulation> {
    /// Highest order of a derivative.
    pub highest: usize,
    /// Sets the derivative of an input: number of the input, order from 1 on, value.
    pub set: fn(&mut S, usize, usize, f64),
    /// Present first derivatives, by the inputs' numbers.
    pub first: fn(&S) -> &[f64],
}

/// Moves on towards an instant, s.
#[expect(type_alias_bounds, reason = "says what S is")]
pub type InternalStep<S: Simulation> = fn(&mut S, f64) -> Result<(), S::Error>;

/// The change of a sample for a change of states and of inputs: outputs and derivatives read from it are
/// directional derivatives.
#[expect(type_alias_bounds, reason = "says what S is")]
pub type Tangent<S: Simulation> =
    fn(&mut S, states: &[f64], inputs: &[f64]) -> Result<S::Sample, S::Error>;

/// A simulation as plain numbers, enough to continue it elsewhere bit for bit.
#[derive(Debug)]
pub struct Saving<S: Simulation> {
    /// How many numbers.
    pub count: usize,
    /// Writes the numbers.
    pub save: fn(&S, &mut Vec<f64>),
    /// Whether a simulation can have these numbers; refuses what was made up.
    pub check: fn(&[f64]) -> bool,
    /// Continues from checked numbers, in a simulation with the same parameters.
    pub load: fn(&mut S, &[f64]),
}
