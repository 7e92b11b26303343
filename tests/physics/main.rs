//! The physics, room by room as in `src`, against closed forms and independent references.

mod air;
mod data;
mod dynamics;
mod explicit;
mod flight;
mod hostile_data;
#[path = "../model/mod.rs"]
mod model;
mod solve;
mod structure;
mod variables;
mod vehicle;
