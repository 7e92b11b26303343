//! Against what the paper prints.

#[path = "../model/mod.rs"]
mod model;
mod origin;
mod printed;
mod tables;
