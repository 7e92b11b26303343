//! An actuator as an FMU: dynamics of second or first order with rate limit, position stops and delay. A step is exact, so
//! the result does not depend on its length.
//!
//! Order of reading: [`model`] (parameters, table), `simulation` (steps, saved states), `command` (delay), `motion`
//! (pieces of motion), [`response`] (closed forms), `passage` and `root` (where a limit is reached).

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

mod command;
pub mod model;
mod motion;
mod passage;
pub mod response;
mod root;
mod simulation;

pub use model::{Actuator, Error, Order};
pub use simulation::Running;

fmi_model::export!(Actuator);
