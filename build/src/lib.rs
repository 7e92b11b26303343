//! The `cargo ahv` tool: describes, packages, flies and tests the FMU. crates/research uses it as a library.

#![allow(missing_docs)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods)]

#[macro_use]
pub mod console;

pub mod abi_stress;
pub mod cli;
pub mod curve;
pub mod describe;
pub mod documentation;
pub mod emulation;
pub mod figure;
mod flight_page;
pub mod fly;
pub mod fmu;
pub mod input_warnings;
pub mod licenses;
pub mod manoeuvre;
pub mod master;
mod masters;
pub mod model_description;
pub mod models;
pub mod modes;
mod node;
pub mod own_vehicle;
pub mod package;
pub mod panels;
pub mod plot;
pub mod poles;
pub mod python;
pub mod raster;
pub mod record;
pub mod research;
pub mod settings;
pub mod simulation;
pub mod site;
pub mod table;
pub mod test;
pub mod trim;
pub mod wheel;
pub mod workspace;
