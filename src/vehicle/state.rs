//! States, controls and gusts of the equations of motion, and the indices of their components.

use crate::structure::MODES;

/// Index of the speed V in a [`State`], m/s.
pub const V: usize = 0;
/// Index of the altitude h, m.
pub const H: usize = 1;
/// Index of the flight-path angle gamma, rad.
pub const GAMMA: usize = 2;
/// Index of the angle of attack alpha, rad.
pub const ALPHA: usize = 3;
/// Index of the pitch rate q, rad/s.
pub const Q: usize = 4;
/// Number of rigid-body states: V, h, gamma, alpha, q.
pub const RIGID_STATES: usize = Q + 1;
/// Index of the modal coordinate of a mode, m: flexible modes first, then slosh modes.
pub const fn eta(mode: usize) -> usize {
    RIGID_STATES + 2 * mode
}
/// Index of the rate of a modal coordinate, m/s.
pub const fn eta_dot(mode: usize) -> usize {
    eta(mode) + 1
}
/// Index of the fuel mass, kg/m.
pub const FUEL: usize = eta(MODES);
/// Number of states.
pub const STATES: usize = FUEL + 1;

/// Index of the effective elevator deflection in a [`Control`], rad.
pub const DELTA_E: usize = 0;
/// Index of the fuel equivalence ratio in a [`Control`].
pub const PHI: usize = 1;
/// Number of controls.
pub const CONTROLS: usize = 2;

/// Index of the vertical air velocity in a [`Gust`], m/s, up positive.
pub const W_GUST: usize = 0;
/// Index of the horizontal air velocity in a [`Gust`], m/s, positive along the flight direction.
pub const U_GUST: usize = 1;
/// Number of gust components.
pub const GUSTS: usize = 2;

/// Nominal values of the states (m/s, m, rad, rad, rad/s, then m and m/s, kg/m), for tolerances.
pub const NOMINAL: [f64; STATES] =
    [1e3, 1e4, 0.01, 0.01, 0.01, 1e-3, 0.01, 1e-3, 0.01, 1e-4, 0.005, 0.01, 0.05, 0.01, 0.05, 1e3];

/// All states; those of modes that a configuration lacks remain zero.
pub type State<S = f64> = [S; STATES];
/// Effective elevator deflection (rad) and fuel equivalence ratio.
pub type Control<S = f64> = [S; CONTROLS];
/// Velocity of the air, m/s: vertical, up positive, and horizontal, along the flight direction.
pub type Gust<S = f64> = [S; GUSTS];
/// Gust components are limited to this magnitude, m/s.
pub const MAX_GUST_M_PER_S: f64 = 200.0;

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
