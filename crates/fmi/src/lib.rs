//! Turns a Rust model into FMUs: a library that any simulation master loads through FMI 2.0 or FMI 3.0, for
//! Co-Simulation and, if the model can be integrated from outside, for Model Exchange.
//!
//! A complete model, a first-order lag; in a `cdylib`, [`export!`] is all that follows:
//!
//! ```
//! use fmi_model::{About, Dependencies, Kind, Model, Simulation, Unit, Variable};
//! use std::convert::Infallible;
//!
//! #[derive(Debug, Clone, PartialEq)]
//! pub struct Lag {
//!     time_constant_s: f64,
//! }
//!
//! #[derive(Debug)]
//! pub struct Lagging {
//!     time_constant_s: f64,
//!     time_s: f64,
//!     input: [f64; 1],
//!     state: [f64; 1],
//!     error: f64,
//! }
//!
//! impl Model for Lag {
//!     type Simulation = Lagging;
//!     type Error = Infallible;
//!
//!     const ABOUT: About =
//!         About { description: "First-order lag", ..About::new("lag", env!("CARGO_PKG_VERSION")) };
//!     const VARIABLES: &'static [Variable<Self>] = &[
//!         Variable::input(0, "u", Unit::ONE, "Input"),
//!         Variable::output_state(0, "y", Unit::ONE, "Output, zero at the start"),
//!         Variable::output(
//!             "error",
//!             Unit::ONE,
//!             "Input less output",
//!             Dependencies::constant(0b11),
//!             |error: &f64| *error,
//!         ),
//!         Variable::parameter(
//!             "time_constant",
//!             Kind::Real(Unit::SECOND),
//!             "Time constant",
//!             |lag: &Self| lag.time_constant_s,
//!             |lag, value| lag.time_constant_s = value,
//!         )
//!         .within([1e-6, 1e6]),
//!     ];
//!
//!     fn new() -> Result<Self, Infallible> {
//!         Ok(Self { time_constant_s: 1.0 })
//!     }
//!
//!     fn start(&self, time_s: f64, _tolerance: f64) -> Result<Lagging, Infallible> {
//!         let time_constant_s = self.time_constant_s;
//!         Ok(Lagging { time_constant_s, time_s, input: [0.0], state: [0.0], error: 0.0 })
//!     }
//! }
//!
//! impl Simulation for Lagging {
//!     type Sample = f64;
//!     type Error = Infallible;
//!
//!     fn time(&self) -> f64 {
//!         self.time_s
//!     }
//!     fn inputs(&self) -> &[f64] {
//!         &self.input
//!     }
//!     fn set_input(&mut self, number: usize, value: f64) {
//!         self.input[number] = value;
//!     }
//!     fn states(&self) -> &[f64] {
//!         &self.state
//!     }
//!     fn evaluate(&mut self) -> Result<&f64, Infallible> {
//!         self.error = self.input[0] - self.state[0];
//!         Ok(&self.error)
//!     }
//!     fn advance(&mut self, end_s: f64) -> Result<(), Infallible> {
//!         // Exact for an input that is constant over the step.
//!         let left = (-(end_s - self.time_s) / self.time_constant_s).exp();
//!         self.state[0] = self.input[0] + (self.state[0] - self.input[0]) * left;
//!         self.time_s = end_s;
//!         Ok(())
//!     }
//! }
//!
//! fmi_model::export!(Lag);
//!
//! // What a master does, without the C interface between.
//! use fmi_model::instance::{Instance, Interface};
//! let mut lag = Instance::<Lag>::new(Interface::CoSimulation, false)?;
//! lag.set_real(&[3], &[0.5])?;
//! lag.setup_experiment(None, 0.0, None)?;
//! lag.enter_initialization_mode()?;
//! lag.exit_initialization_mode()?;
//! lag.set_real(&[0], &[1.0])?;
//! lag.do_step(0.0, 0.5)?;
//! lag.get_real(&[1], |_, y| assert!((y - (1.0 - (-1.0_f64).exp())).abs() < 1e-12))?;
//! # Ok::<(), fmi_model::failure::Failure>(())
//! ```
//!
//! | module | its job |
//! |---|---|
//! | [`model`] | the traits that a model implements |
//! | [`Variable`], [`table`] | one variable; the one table of them: value reference = row |
//! | [`identity`] | GUID and key of saved states |
//! | [`instantiate`], [`location`] | whether token, data and binary fit; the folder of a package's resources |
//! | [`instance`], `steps`, `clock` | one instance: set-up, steps, status; when two instants are the same |
//! | [`values`], [`derivatives`], [`exchange`] | reading and setting; directional, input and output derivatives; Model Exchange |
//! | [`state`] | the FMU state and its bytes |
//! | [`failure`], [`log`] | what a call is refused for; messages for the master's logger |
//! | [`phase`], [`status`], [`standard`] | states of an instance, calls and what they return, in both standards |
//! | [`guard`] | legal order, panics and failures become a status and a message |
//! | `abi` | C pointers, instances and messages, for either standard |
//! | [`v2`] | FMI 2.0.5: C types, legal order of calls as data, exported functions |
//! | [`v3`] | FMI 3.0.2: likewise |
//!
//! Steps are synchronous: `fmi2DoStep` never returns `fmi2Pending`, so there is nothing to cancel
//! and the callback `stepFinished`, which reports the end of a pending step, is not called.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

mod abi;
#[cfg(feature = "package")]
pub mod archive;
pub mod clock;
pub mod derivatives;
#[cfg(feature = "describe")]
pub mod describe;
pub mod exchange;
pub mod export;
pub mod failure;
pub mod guard;
pub mod identity;
pub mod instance;
pub mod instantiate;
mod kinds;
pub mod location;
pub mod log;
pub mod model;
#[cfg(feature = "package")]
pub mod package;
mod pending;
pub mod phase;
#[cfg(feature = "package")]
pub mod platform;
mod short;
pub mod standard;
pub mod state;
pub mod status;
mod steps;
pub mod table;
pub mod v2;
pub mod v3;
pub mod values;
mod variable;

pub use kinds::{Dependencies, Items, Kind, Unit};
pub use model::{
    About, Exchange, FromResources, InputDerivatives, InternalStep, Model, ModelError, Remedy,
    Resources, Saving, Simulation, Tangent,
};
pub use variable::{Refused, Role, Variable};
