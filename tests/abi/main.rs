//! The shared library through its C functions, as a master calls them.

#![allow(unsafe_code)]
#![expect(clippy::duplicate_mod, reason = "a test of both versions is compiled for either")]

mod common;
#[path = "../../crates/fmi/tests/master/mod.rs"]
mod master;
mod random_calls;
mod symbols;
mod v2;
mod v3;

/// Tests of what both versions of the standard have, for FMI 2.0.
#[path = "both"]
mod fmi2 {
    pub use crate::common::fmi2::{Api, Slave};

    /// How its messages begin, and those of setting a real variable.
    pub const PREFIX: &str = "fmi2";
    pub const SETTER: &str = "fmi2SetReal";
    /// The instance's name as the logger gets it, and a percent sign.
    pub const NAME: &str = "one";
    pub const PERCENT: &str = "%%";

    mod exchange;
    mod lifecycle;
    mod logging;
    mod own_vehicle;
    mod refusals;
    mod state;
    mod steps;
    mod threads;
    mod values;
}

/// The same tests for FMI 3.0.
#[path = "both"]
mod fmi3 {
    pub use crate::common::fmi3::{Api, Slave};

    pub const PREFIX: &str = "fmi3";
    pub const SETTER: &str = "fmi3SetFloat64";
    pub const NAME: &str = "";
    pub const PERCENT: &str = "%";

    mod exchange;
    mod lifecycle;
    mod logging;
    mod own_vehicle;
    mod refusals;
    mod state;
    mod steps;
    mod threads;
    mod values;
}
