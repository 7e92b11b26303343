//! Velocity relative to the moving air.

use crate::solve::Scalar;
use crate::vehicle::{ALPHA, GAMMA, Gust, State, V};

/// Velocity of the vehicle relative to the air, and its direction.
pub struct RelativeWind<S> {
    /// Airspeed, m/s.
    pub speed: S,
    /// Incidence of the body to the relative wind, rad.
    pub incidence: S,
    /// Sine and cosine of the angle of attack alpha, against the flight path.
    pub alpha_sin_cos: (S, S),
    /// Sine and cosine of the incidence.
    pub incidence_sin_cos: (S, S),
    /// Sine and cosine of the angle from flight path to relative wind, positive from below: incidence -
    /// alpha.
    pub gust_angle_sin_cos: (S, S),
}

impl<S: Scalar> RelativeWind<S> {
    /// From state and gust.
    #[inline]
    pub fn new(x: &State<S>, gust: Gust<S>) -> Self {
        let (zero, one) = (S::constant(0.0), S::constant(1.0));
        let alpha_sin_cos = x[ALPHA].sin_cos();
        let [up, forward] = gust;
        if up.is_zero() && forward.is_zero() {
            return Self {
                speed: x[V],
                incidence: x[ALPHA],
                alpha_sin_cos,
                incidence_sin_cos: alpha_sin_cos,
                gust_angle_sin_cos: (zero, one),
            };
        }
        let (sin_gamma, cos_gamma) = x[GAMMA].sin_cos();
        let along = x[V] - up * sin_gamma - forward * cos_gamma;
        let across = up * cos_gamma - forward * sin_gamma;
        let speed = (along * along + across * across).sqrt();
        let incidence = x[ALPHA] + (across / along).atan();
        let (sin, cos) = (across / speed, along / speed);
        let (sin_alpha, cos_alpha) = alpha_sin_cos;
        let incidence_sin_cos =
            (sin_alpha * cos + cos_alpha * sin, cos_alpha * cos - sin_alpha * sin);
        Self { speed, incidence, alpha_sin_cos, incidence_sin_cos, gust_angle_sin_cos: (sin, cos) }
    }
}
