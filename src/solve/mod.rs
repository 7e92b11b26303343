//! Dual numbers, integration of x' = f(t, x), and interpolation. Independent of the vehicle.
//!
//! | file | what it holds |
//! |---|---|
//! | `scalar` | real and dual numbers |
//! | `integrate` | step-size control over one interval |
//! | `dop853` | explicit Runge-Kutta method of order 8, to compare with |
//! | `exponential` | exponential Runge-Kutta method with a frozen linear part |
//! | `decoupling`, `blocks` | its block diagonalisation and phi functions |
//! | `chebyshev` | polynomial interpolation |

mod blocks;
mod chebyshev;
mod decoupling;
mod dop853;
mod exponential;
mod integrate;
mod scalar;

pub use blocks::{Blocks, MatrixFunction, phis};
pub use chebyshev::Chebyshev;
pub use decoupling::Decoupling;
pub use dop853::DOP853;
pub use exponential::Exponential;
pub use integrate::{
    Attempt, Integrator, MAX_TRIALS, Method, Outcome, System, Tableau, Trial, step_factor,
};
pub use scalar::{Dual, Over, Scalar};
