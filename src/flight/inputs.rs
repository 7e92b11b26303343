//! Inputs between communication points: polynomials in time.

use crate::vehicle::{CONTROLS, Control, GUSTS, Gust};

/// Controls, then the gust.
pub const INPUTS: usize = CONTROLS + GUSTS;

/// Highest derivative of an input that a master can give.
pub const INPUT_ORDER: usize = 3;

/// Inputs at the present instant and how they go on within the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inputs {
    /// Present values: elevator (rad), fuel ratio, vertical and horizontal gust (m/s).
    pub values: [f64; INPUTS],
    /// Their first, second and third derivative, 1/s, 1/s^2, 1/s^3.
    pub derivatives: [[f64; INPUTS]; INPUT_ORDER],
    /// Whether the derivatives are for the next step. After it they only tell how the inputs moved
    /// until now.
    pub ahead: bool,
}

impl Inputs {
    /// Zero, and not moving.
    pub const ZERO: Self =
        Self { values: [0.0; INPUTS], derivatives: [[0.0; INPUTS]; INPUT_ORDER], ahead: false };

    /// Sets a value. Derivatives that were given for the next step stay, others end here.
    pub fn set(&mut self, index: usize, value: f64) {
        self.values[index] = value;
        if !self.ahead {
            self.derivatives.iter_mut().for_each(|derivative| derivative[index] = 0.0);
        }
    }

    /// Sets the derivative of an order from 1 on, for the next step.
    pub fn set_derivative(&mut self, index: usize, order: usize, value: f64) {
        if !self.ahead {
            self.derivatives = Self::ZERO.derivatives;
            self.ahead = true;
        }
        self.derivatives[order - 1][index] = value;
    }

    /// The controls and the gust among the inputs.
    pub fn split(inputs: &[f64; INPUTS]) -> (Control, Gust) {
        let [delta_e, phi, up, forward] = *inputs;
        ([delta_e, phi], [up, forward])
    }

    /// Whether they change within the next step.
    pub fn moving(&self) -> bool {
        self.ahead && self.derivatives != Self::ZERO.derivatives
    }

    /// Values after a time (s) of the next step.
    #[inline]
    pub fn at(&self, t: f64) -> [f64; INPUTS] {
        let [first, second, third] = &self.derivatives;
        std::array::from_fn(|i| {
            self.values[i] + t * (first[i] + t / 2.0 * (second[i] + t / 3.0 * third[i]))
        })
    }

    /// As they are after a step of this length (s).
    pub fn after(&self, t: f64) -> Self {
        if !self.moving() {
            return Self { derivatives: Self::ZERO.derivatives, ahead: false, ..*self };
        }
        let [first, second, third] = &self.derivatives;
        let shift = |f: fn(f64, f64, f64, f64) -> f64| {
            std::array::from_fn(|i| f(t, first[i], second[i], third[i]))
        };
        Self {
            values: self.at(t),
            derivatives: [
                shift(|t, a, b, c| a + t * (b + t / 2.0 * c)),
                shift(|t, _, b, c| b + t * c),
                *third,
            ],
            ahead: false,
        }
    }
}
