//! States, controls and gusts of the equations of flight.

use crate::structure::MODES;

/// V, h, gamma, alpha, q.
pub const RIGID: usize = 5;
/// Number of the fuel among the states; before it, behind the rigid states, (eta, eta-dot) of the
/// flexible modes, then of the slosh modes.
pub const FUEL: usize = RIGID + 2 * MODES;
/// All states.
pub const STATES: usize = FUEL + 1;
/// delta_e, phi.
pub const CONTROLS: usize = 2;
/// Typical size of each state (m/s, m, rad, rad, rad/s, then m and m/s, kg/m): scales the tolerance.
pub const NOMINAL: [f64; STATES] =
    [1e3, 1e4, 0.01, 0.01, 0.01, 1e-3, 0.01, 1e-3, 0.01, 1e-4, 0.005, 0.01, 0.05, 0.01, 0.05, 1e3];

/// All states; those of modes that a configuration does not have stay zero.
pub type State<S = f64> = [S; STATES];
/// Effective elevator deflection (rad) and fuel equivalence ratio.
pub type Control<S = f64> = [S; CONTROLS];
/// Velocity of the air, m/s: vertical, up positive, and horizontal, along the flight direction.
pub type Gust<S = f64> = [S; GUSTS];
/// Components of a gust.
pub const GUSTS: usize = 2;
/// Fastest gust, m/s: a faster one has no effect beyond this.
pub const FASTEST_GUST: f64 = 200.0;

/// Names of the states in the variable table.
pub const STATE_NAMES: [&str; STATES] = [
    "V",
    "h",
    "gamma",
    "alpha",
    "q",
    "eta1",
    "eta1_dot",
    "eta2",
    "eta2_dot",
    "eta3",
    "eta3_dot",
    "eta_slosh1",
    "eta_slosh1_dot",
    "eta_slosh2",
    "eta_slosh2_dot",
    "fuel_mass",
];
