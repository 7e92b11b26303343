//! The shared library through its C functions, as a master calls them.

#![allow(unsafe_code)]

mod common;
mod derivatives;
mod exchange;
mod fuzz;
mod lifecycle;
mod logging;
mod refusals;
mod state;
mod steps;
mod symbols;
mod threads;
mod values;
