//! Whole flights.

mod burning;
mod method;
mod offsets;
mod steps;
