//! The functions of the standard, generic over the model: the only unsafe code.
//! [`export!`](crate::export!) makes them the symbols of a library.
//!
//! Each function turns C arguments into Rust ones and makes one call through the guard. What a
//! master has to grant is what the standard demands: an instance that `fmi2Instantiate` returned
//! and `fmi2FreeInstance` has not freed, used by one thread at a time, and arrays of the length it
//! states. NULL is refused, not trusted.

#![allow(unsafe_code)]
// The names are those of the standard.
#![allow(non_snake_case, missing_docs, clippy::missing_safety_doc)]

mod common;
mod cosimulation;
mod entry;
mod exchange;
mod state;
mod values;

pub use common::*;
pub use cosimulation::*;
pub use exchange::*;
pub use state::*;
pub use values::*;
