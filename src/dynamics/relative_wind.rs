//! Air in motion.

use crate::solve::Scalar;
use crate::vehicle::{ALPHA, GAMMA, Gust, State, V};

/// The vehicle as moving air meets it.
pub struct RelativeWind<S> {
    /// Speed through the air, m/s.
    pub speed: S,
    /// Incidence to it, rad.
    pub incidence: S,
    /// Sine and cosine of the angle of attack, of the body against the flight path.
    pub body: (S, S),
    /// Sine and cosine of the incidence, of the body against the stream.
    pub axis: (S, S),
    /// Sine and cosine of the angle by which the stream comes from below the flight path.
    pub turn: (S, S),
}

impl<S: Scalar> RelativeWind<S> {
    /// What moving air makes of the state.
    #[inline]
    pub fn new(x: &State<S>, gust: Gust<S>) -> Self {
        let (zero, one) = (S::constant(0.0), S::constant(1.0));
        let body = x[ALPHA].sin_cos();
        let [up, forward] = gust;
        if up.is_zero() && forward.is_zero() {
            return Self { speed: x[V], incidence: x[ALPHA], body, axis: body, turn: (zero, one) };
        }
        let (sin_gamma, cos_gamma) = x[GAMMA].sin_cos();
        let along = x[V] - up * sin_gamma - forward * cos_gamma;
        let across = up * cos_gamma - forward * sin_gamma;
        let speed = (along * along + across * across).sqrt();
        let incidence = x[ALPHA] + (across / along).atan();
        let (sin, cos) = (across / speed, along / speed);
        let axis = (body.0 * cos + body.1 * sin, body.1 * cos - body.0 * sin);
        Self { speed, incidence, body, axis, turn: (sin, cos) }
    }
}
