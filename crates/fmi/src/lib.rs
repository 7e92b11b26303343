//! Turns a Rust model into an FMU: a library that any simulation master loads through FMI 2.0, for
//! Co-Simulation and, if the model can be integrated from outside, for Model Exchange.
//!
//! | module | its job |
//! |---|---|
//! | [`model`] | the traits that a model implements |
//! | [`Variable`], [`table`] | one variable; the one table of them: value reference = row |
//! | [`identity`] | GUID and key of saved states |
//! | [`instance`], `steps`, `clock` | one instance: set-up, steps, status; when two instants are the same |
//! | [`values`], [`derivatives`], [`exchange`] | reading and setting; directional, input and output derivatives; Model Exchange |
//! | [`state`] | the FMU state and its bytes |
//! | [`failure`], [`log`] | what a call is refused for; messages for the master's logger |
//! | [`guard`] | legal order, panics and failures become a status and a message |
//! | [`v2`] | FMI 2.0.5: C types, legal order of calls as data, exported functions |
//!
//! Steps are synchronous: `fmi2DoStep` never returns `fmi2Pending`, so there is nothing to cancel
//! and the callback `stepFinished`, which reports the end of a pending step, is not called.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

#[cfg(feature = "package")]
pub mod archive;
mod clock;
pub mod derivatives;
#[cfg(feature = "describe")]
pub mod describe;
pub mod exchange;
pub mod failure;
pub mod guard;
pub mod identity;
pub mod instance;
mod kinds;
pub mod log;
pub mod model;
#[cfg(feature = "package")]
pub mod package;
mod pending;
mod short;
pub mod state;
mod steps;
pub mod table;
pub mod v2;
pub mod values;
mod variable;

pub use kinds::{Dependencies, Kind, Unit};
pub use model::{
    About, Exchange, InputDerivatives, Model, ModelError, Remedy, Saving, Simulation, Tangent,
};
pub use variable::{Refused, Role, Variable};
