//! Air in vertical motion.

use super::{State, Vehicle};
use crate::scalar::Scalar;

/// The vehicle as air in vertical motion meets it.
pub struct Stream<S> {
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

impl<S: Scalar> Stream<S> {
    /// What air that rises at `gust` (m/s) makes of the state.
    #[inline]
    pub fn new(x: &State<S>, gust: S) -> Self {
        let (zero, one) = (S::constant(0.0), S::constant(1.0));
        let body = x[3].sin_cos();
        if gust.is_zero() {
            return Self { speed: x[0], incidence: x[3], body, axis: body, turn: (zero, one) };
        }
        let (sin_gamma, cos_gamma) = x[2].sin_cos();
        let (along, across) = (x[0] - gust * sin_gamma, gust * cos_gamma);
        let speed = (along * along + across * across).sqrt();
        let incidence = x[3] + (across / along).atan();
        let (sin, cos) = (across / speed, along / speed);
        let axis = (body.0 * cos + body.1 * sin, body.1 * cos - body.0 * sin);
        Self { speed, incidence, body, axis, turn: (sin, cos) }
    }
}

impl Vehicle {
    /// The state as air rising at `gust` (m/s) meets it: speed through the air for V, incidence to
    /// it for alpha. Still air leaves it bit for bit as it is.
    pub fn as_met(x: &State, gust: f64) -> State {
        let Stream { speed, incidence, .. } = Stream::new(x, gust);
        let mut met = *x;
        (met[0], met[3]) = (speed, incidence);
        met
    }

    /// Whether the curve fits hold at a state in air rising at `gust` (m/s), with fuel if it burns.
    pub fn holds(&self, x: &State, gust: f64) -> bool {
        let met = Self::as_met(x, gust);
        self.aero.envelope.holds(&self.atmosphere, &met) && !self.out_of_fuel(x)
    }
}
