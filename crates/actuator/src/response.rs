//! The motion between limits, under a command that moves linearly: closed forms.
//!
//! With e the deviation from the steady answer to the ramp, p = p_steady(t) + e(t),
//! second order: e'' + 2 zeta omega e' + omega^2 e = 0; first order: e' + omega e = 0.

use crate::model::{Actuator, Order};
use libm::{atan2, atanh, cos, exp, expm1, sin};
use std::f64::consts::PI;

/// A command that moves linearly: its value at an instant and its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// Value.
    pub value: f64,
    /// Slope, 1/s.
    pub slope: f64,
}

impl Ramp {
    /// The same on the other side of zero, if the side is -1.
    pub(crate) fn mirrored(self, side: f64) -> Self {
        Self { value: side * self.value, slope: side * self.slope }
    }

    /// The same ramp, seen from a time (s) later.
    pub fn after(self, t: f64) -> Self {
        Self { value: self.value + self.slope * t, ..self }
    }
}

/// Position and rate of the actuator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Position.
    pub position: f64,
    /// Its rate, 1/s.
    pub rate: f64,
}

/// The two solutions of the homogeneous equation: those that start with value 1 and rate -sigma, and with value 0 and
/// rate 1.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Basis {
    /// exp(-sigma t) cos(omega_d t) and exp(-sigma t) sin(omega_d t) / omega_d.
    Underdamped { sigma: f64, omega_d: f64 },
    /// exp(-sigma t) cosh(kappa t) and exp(-sigma t) sinh(kappa t) / kappa, with the slower of the two decays. Critically
    /// damped if kappa is below rounding.
    Overdamped { slower: f64, kappa: f64 },
    /// exp(-omega t) alone.
    FirstOrder { omega: f64 },
}

/// After so many time constants nothing is left.
const DECAYED: f64 = 750.0;
/// Differences of this many roundings are none.
pub(crate) const ROUNDINGS: f64 = 8.0;
/// So much later there is no zero, for any step.
const NEVER: f64 = 1e30;

impl Basis {
    fn new(actuator: &Actuator) -> Self {
        let Actuator { bandwidth: omega, damping: zeta, .. } = *actuator;
        // Not 1 - zeta^2: no digits are lost near critical damping.
        let discriminant = (1.0 - zeta) * (1.0 + zeta);
        // Not zero, as it divides.
        let root = discriminant.abs().sqrt().max(1e-30);
        match actuator.kind {
            Order::First => Self::FirstOrder { omega },
            Order::Second if discriminant > 0.0 => {
                Self::Underdamped { sigma: zeta * omega, omega_d: omega * root }
            }
            Order::Second => {
                Self::Overdamped { slower: omega / (zeta + root), kappa: omega * root }
            }
        }
    }

    fn at(&self, t: f64) -> [f64; 2] {
        match *self {
            Self::Underdamped { sigma, .. } if sigma * t > DECAYED => [0.0; 2],
            Self::Underdamped { sigma, omega_d } => {
                let (decay, phase) = (exp(-sigma * t), omega_d * t);
                [decay * cos(phase), decay * sin(phase) / omega_d]
            }
            Self::Overdamped { slower, kappa } => {
                let (decay, x) = (exp(-slower * t), 2.0 * kappa * t);
                [decay * 0.5 * (1.0 + exp(-x)), decay * -expm1(-x) / (2.0 * kappa)]
            }
            Self::FirstOrder { omega } => [exp(-omega * t), 0.0],
        }
    }

    /// The first zero after the start of the combination with these coefficients, and the time from one to the next;
    /// infinite if there is none.
    fn zeros(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        match *self {
            Self::Underdamped { omega_d, .. } => {
                let angle = atan2(a * omega_d, -b);
                let first = if angle > 0.0 { angle } else { angle + PI };
                [first / omega_d, PI / omega_d]
            }
            Self::Overdamped { kappa, .. }
                if a * b < 0.0 && kappa * a.abs() < b.abs() && a.abs() < NEVER * b.abs() =>
            {
                [atanh(kappa * a.abs() / b.abs()) / kappa, f64::INFINITY]
            }
            _ => [f64::INFINITY; 2],
        }
    }

    /// After this time (s) the deviation is below rounding.
    fn settled(&self) -> f64 {
        let rate = match *self {
            Self::Underdamped { sigma, .. } => sigma,
            Self::Overdamped { slower, .. } => slower,
            Self::FirstOrder { omega } => omega,
        };
        40.0 / rate
    }
}

/// The motion without limits from a position and rate on.
#[derive(Debug, Clone, Copy)]
pub struct Response {
    basis: Basis,
    steady: Ramp,
    /// Coefficients of the deviation and of its first and second derivative.
    deviation: [[f64; 2]; 3],
    /// Sizes of the positions and rates that the response is a sum of.
    sizes: [f64; 2],
}

impl Response {
    /// The motion that starts like this. The rate of a first-order actuator follows from its command.
    pub fn new(actuator: &Actuator, start: Motion, command: Ramp) -> Self {
        let Actuator { bandwidth: omega, damping: zeta, .. } = *actuator;
        let basis = Basis::new(actuator);
        let lag = actuator.lag() * command.slope;
        let steady = Ramp { value: command.value - lag, ..command };
        let e = start.position - command.value + lag;
        let deviation = match actuator.kind {
            Order::First => [[e, 0.0], [-omega * e, 0.0], [omega * omega * e, 0.0]],
            Order::Second => {
                let sigma = zeta * omega;
                let rate = start.rate - command.slope;
                let acceleration = -omega * omega * e - 2.0 * sigma * rate;
                [
                    [e, rate + sigma * e],
                    [rate, acceleration + sigma * rate],
                    [acceleration, -omega * omega * rate - sigma * acceleration],
                ]
            }
        };
        let speed = command.slope.abs() + start.rate.abs();
        let size = start.position.abs() + command.value.abs() + actuator.lag() * speed;
        Self { basis, steady, deviation, sizes: [size, omega * size + speed] }
    }

    /// Position, rate and acceleration after a time, s.
    pub fn at(&self, t: f64) -> [f64; 3] {
        let [first, second] = self.basis.at(t);
        let [e, rate, acceleration] = self.deviation.map(|[a, b]| a * first + b * second);
        [self.steady.after(t).value + e, self.steady.slope + rate, acceleration]
    }

    /// How much of position and rate at a time (s) may be rounding.
    pub fn rounding(&self, t: f64) -> [f64; 2] {
        let [position, rate] = self.sizes;
        [position + self.steady.slope.abs() * t, rate].map(|size| ROUNDINGS * f64::EPSILON * size)
    }

    /// Ends of the intervals on which the rate is monotonic, up to `h` (s): the zeros of the acceleration.
    pub fn monotonic(&self, h: f64) -> impl Iterator<Item = f64> {
        let [_, _, acceleration] = self.deviation;
        let [first, interval] = self.basis.zeros(acceleration);
        let last = h.min(self.basis.settled());
        std::iter::successors(Some(first), move |t| Some(t + interval))
            .take_while(move |&t| t < last)
            .chain(std::iter::once(h))
    }
}
