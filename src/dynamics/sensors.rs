//! Sensors on the deformed body.
//!
//! Relative to the mean axes of eq. (3), a sensor at the distance xi ahead of the mass centre has the
//! deflection w and the slope sigma (nose-down positive) of the modes. In body axes, forward and up,
//!
//! ```text
//! velocity      (V cos alpha - q w,  -V sin alpha + q xi + w')
//! acceleration  a_cg + (-q^2 xi - q' w - 2 q w',  q' xi - q^2 w + w'')
//! ```
//!
//! (motion relative to rotating axes: Etkin, Dynamics of Atmospheric Flight, 1972, section 5.1); the
//! sensor's axes are rotated nose-down by sigma.

use super::loads::Airflow;
use crate::air::curve_fits::PerMode;
use crate::solve::{Over, Scalar};
use crate::structure::MODES;
use crate::vehicle::{ALPHA, Airframe, GAMMA, Q, State, V, eta, eta_dot};

/// Motion of a point of the body relative to the mean axes, up positive.
struct PointMotion<S> {
    /// Deflection, m, and its rates.
    w: S,
    w_dot: S,
    w_dot_dot: S,
    /// Slope, nose-down positive, rad, and its rate.
    slope: S,
    slope_dot: S,
}

/// Readings of an inertial measurement unit.
#[derive(Debug, Clone, Copy)]
pub struct Imu<S = f64> {
    /// Pitch attitude, rad.
    pub theta: S,
    /// Pitch rate, rad/s.
    pub q: S,
    /// Flight-path angle of its location, rad.
    pub gamma: S,
    /// Load factor normal to the deformed axis, up positive, g.
    pub n_z: S,
    /// Load factor along the deformed axis, forward positive, g.
    pub n_x: S,
}

fn motion<C: Copy, S: Scalar + Over<C>>(
    [deflection, slope]: &[PerMode<C>; 2],
    x: &State<S>,
    rates: &State<S>,
) -> PointMotion<S> {
    let sum = |shape: &PerMode<C>, of: &State<S>, component: fn(usize) -> usize| {
        let modes = 0..MODES;
        modes.fold(S::constant(0.0), |sum, i| sum + of[component(i)] * shape[i])
    };
    PointMotion {
        w: sum(deflection, x, eta),
        w_dot: sum(deflection, x, eta_dot),
        w_dot_dot: sum(deflection, rates, eta_dot),
        slope: sum(slope, x, eta),
        slope_dot: sum(slope, x, eta_dot),
    }
}

/// Readings of an IMU at `station`, m from the nose; one g is `standard`, m/s^2.
pub(super) fn imu<C: Scalar, S: Scalar + Over<C>>(
    airframe: &Airframe<C>,
    airflow: &Airflow<S>,
    x: &State<S>,
    rates: &State<S>,
    station: f64,
    standard: f64,
) -> Imu<S> {
    let point = motion(&airframe.imu, x, rates);
    let xi = S::of(airframe.mass_centre - station);
    let (q, theta) = (x[Q], x[GAMMA] + x[ALPHA]);
    let (sin_alpha, cos_alpha) = airflow.wind.alpha_sin_cos;
    let ahead = x[V] * cos_alpha - q * point.w;
    let up = q * xi + point.w_dot - x[V] * sin_alpha;

    let per_weight = C::constant(1.0) / (airframe.mass * standard);
    let (sin, cos) = airflow.wind.incidence_sin_cos;
    let axial = airflow.loads.drag * cos - airflow.loads.lift * sin;
    let along = (airflow.loads.thrust - axial) * per_weight;
    let across = airflow.loads.normal * per_weight;
    let in_g = 1.0 / standard;
    let q_dot = rates[Q];
    let along = along - (q * q * xi + q_dot * point.w + q * point.w_dot * 2.0) * in_g;
    let across = across + (q_dot * xi - q * q * point.w + point.w_dot_dot) * in_g;
    let (sin, cos) = point.slope.sin_cos();
    Imu {
        theta: theta - point.slope,
        q: q - point.slope_dot,
        gamma: theta + (up / ahead).atan(),
        n_z: across * cos + along * sin,
        n_x: along * cos - across * sin,
    }
}

/// Incidence indicated by a vane at `station`, m from the nose, rad.
pub(super) fn vane<C: Scalar, S: Scalar + Over<C>>(
    airframe: &Airframe<C>,
    airflow: &Airflow<S>,
    x: &State<S>,
    rates: &State<S>,
    station: f64,
) -> S {
    let point = motion(&airframe.probe, x, rates);
    let xi = S::of(airframe.mass_centre - station);
    let (sin, cos) = airflow.wind.incidence_sin_cos;
    let ahead = airflow.wind.speed * cos - x[Q] * point.w;
    let down = airflow.wind.speed * sin - x[Q] * xi - point.w_dot;
    (down / ahead).atan() - point.slope
}
