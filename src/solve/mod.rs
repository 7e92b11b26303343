//! Numbers that carry derivatives, and integration of x' = f(t, x). Knows no aircraft.
//!
//! | file | what it holds |
//! |---|---|
//! | `scalar` | numbers, plain and dual |
//! | `integrate`, `dop853` | one interval, landing exactly on its end |
//! | `exponential`, `decoupling`, `blocks` | the oscillators exactly, the rest as a polynomial |

mod blocks;
mod decoupling;
mod dop853;
mod exponential;
mod integrate;
mod scalar;

pub use blocks::{Blocks, MatrixFunction, PHIS, phis};
pub use decoupling::Decoupling;
pub use dop853::DOP853;
pub use exponential::Exponential;
pub use integrate::{Attempt, Integrator, MAX_TRIALS, Method, Outcome, System, Tableau, Trial};
pub use scalar::{Dual, Over, Scalar};
