//! The functions of the standard, generic over the model. [`export!`](crate::export!) makes them the symbols of a
//! library.
//!
//! Each function turns C arguments into Rust ones and makes one call through the guard. What a
//! master has to grant is what the standard demands: an instance that was made here and not freed, used by
//! one thread at a time, and arrays of the length it states. NULL is refused, not trusted.

#![allow(unsafe_code)]
// Names and arguments are those of the standard.
#![allow(non_snake_case, missing_docs, clippy::missing_safety_doc, clippy::too_many_arguments)]

mod absent;
mod common;
mod cosimulation;
mod derivatives;
mod entry;
mod exchange;
mod instantiate;
mod state;
mod values;

pub use absent::*;
pub use common::*;
pub use cosimulation::*;
pub use derivatives::*;
pub use exchange::*;
pub use instantiate::*;
pub use state::*;
pub use values::*;
