//! Methods on problems with known answers.

mod exponential;
mod integrate;
