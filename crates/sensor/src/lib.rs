//! A sensor as an FMU: lag, scale factor, bias, noise, sampling, quantisation and failures. Lag and sampling instants are exact,
//! so the result does not depend on the step.
//!
//! Order of reading: [`model`] (parameters, table), `simulation` (steps, samples, failures, saved states), [`noise`].

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

pub mod model;
pub mod noise;
mod simulation;

pub use model::{Error, Failure, Sensor};
pub use simulation::Running;

fmi_model::export!(Sensor);
