//! The shared library through its C functions, as a master calls them.

#![allow(unsafe_code)]

mod common;
mod derivatives;
mod exchange;
mod lifecycle;
mod logging;
#[path = "../../crates/fmi/tests/master/mod.rs"]
mod master;
mod own_vehicle;
mod random_calls;
mod refusals;
mod state;
mod steps;
mod symbols;
mod threads;
mod values;
