//! Methods on problems with known answers.

mod chebyshev;
mod exponential;
mod integrate;
