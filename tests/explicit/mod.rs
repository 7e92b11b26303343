//! A second model, of its own equations, from the data files: a rigid body and two sloshing masses.
#![allow(dead_code, missing_docs)]

pub mod air;
pub mod beam;
pub mod books;
pub mod elastic;
pub mod flight;
