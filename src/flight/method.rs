//! The integrator of a flight.

use crate::dynamics::linear::LinearModel;
use crate::dynamics::trim::Trim;
use crate::solve::{Decoupling, Exponential};
use crate::vehicle::{ALPHA, FUEL, NOMINAL, STATES, Vehicle};

/// Tolerances that the integrator works with: below the first, rounding errors of double precision
/// decide, above the second the error estimate means nothing.
pub const TOLERANCES: [f64; 2] = [1e-12, 1e-2];
/// Tolerance of a master that asks for none.
pub const DEFAULT_TOLERANCE: f64 = 1e-8;
/// First guess of the integrator's step, s: a tenth of a radian of the fastest mode.
pub(super) const FIRST_STEP: f64 = 1e-3;

/// Incidence, pitch rate and modes: the states that move fast.
const FAST: usize = FUEL - ALPHA;
/// V, h and gamma.
const SLOW: usize = ALPHA;

/// What integrates a flight.
pub type Method = Exponential<STATES, SLOW, FAST>;

/// The method for a vehicle, its fast motion decoupled about steady flight.
pub fn method(vehicle: &Vehicle, steady: &Trim) -> Method {
    let jacobian = LinearModel::new(vehicle, &steady.state, &steady.control).a;
    Exponential::new(Decoupling::new(&jacobian, &NOMINAL))
}
