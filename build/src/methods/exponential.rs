//! A method that lost: the linear part of the motion exactly, the rest as a polynomial.
//!
//! From x0 the vehicle moves by f(x0) and by L (x - x0), which functions of L answer exactly, and by
//! D = f(x) - f(x0) - L (x - x0):
//!
//! x(h) = x0 + h phi_1(h L) f(x0) + integral over s from 0 to h of exp((h - s) L) D(s)
//!
//! The course of D is a cubic through zero and its values at the Lobatto points, each from stages
//! before (Hochbruck, Ostermann, Exponential integrators, Acta Numerica 19, 2010, section 2.3), with
//! L the Jacobian at trim: five right-hand sides, sixth order wherever the vehicle is.
//!
//! Near trim it needs a quarter of DOP853's right-hand sides at 1e-8. It lost because it is not the
//! better one everywhere: far from trim D is no longer small and at 1e-12 it needs almost twice as
//! many, and where an input bends inside a step its few stages may not meet the bend (errors of
//! 10^4 tolerances were seen). Beside them a step costs products with functions of L: with L taken
//! apart into 2 x 2 blocks as much again as half of its right-hand sides.

use ahv::dynamics::{STATES, State, Vehicle};
use ahv::integrate::{Method, System, Trial};
use ahv::linear::Linear;
use ahv::trim::Trim;
use nalgebra::{SMatrix, SVector};
use std::cell::RefCell;

type Matrix = SMatrix<f64, STATES, STATES>;
type Vector = SVector<f64, STATES>;

/// Stages after the first.
const STAGES: usize = 4;
/// Inner Lobatto points, (1 -+ 1/sqrt 5)/2.
const LOBATTO: [f64; 2] = [0.276_393_202_250_021, 0.723_606_797_749_979];
/// Times of the stages over the step. A straight line through zero and two thirds of the way meets the
/// integral of a parabola, so the second stage gains an order.
const NODES: [f64; STAGES] = [2.0 / 3.0 * LOBATTO[0], LOBATTO[0], LOBATTO[1], 1.0];
/// For each stage, and for the step itself, the stages whose D it is made of.
const SOURCES: [&[usize]; STAGES + 1] = [&[], &[0], &[0, 1], &[1, 2], &[1, 2, 3]];
/// Integral of the cubic through the last three values of D less that of the parabola through the
/// last two, and less that of the line through the last: the estimates, without the functions of L.
const ESTIMATES: [[f64; STAGES]; 2] = [
    [0.0, 5.0 / 12.0, -5.0 / 12.0, 1.0 / 12.0 - (1.0 / 3.0 - LOBATTO[1] / 2.0) / LOBATTO[0]],
    [0.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0 - 1.0 / 2.0],
];
/// Largest size of L times a step for which the series of phi holds its digits.
const REACH: f64 = 4.0;
/// Terms of that series: 4^40 / 40! is below the rounding.
const TERMS: i32 = 40;

/// What a step of one length takes: on f(x0), then on D of each source.
type Weights = Vec<(Matrix, Vec<Matrix>)>;

/// The method with the linear part of one vehicle.
pub struct Exponential {
    jacobian: Matrix,
    /// Longest step, s.
    longest: f64,
    /// Of the last step, with its length: steps of equal length share them.
    weights: RefCell<(f64, Weights)>,
}

impl Exponential {
    pub fn new(vehicle: &Vehicle, trim: &Trim) -> Self {
        let linear = Linear::new(vehicle, &trim.state, &trim.control);
        let fastest = linear.poles().last().map_or(0.0, |pole| pole.norm());
        // States that are not in use do not move.
        let entry = |row, column| linear.a.get((row, column)).map_or(0.0, |entry: &f64| *entry);
        Self {
            jacobian: Matrix::from_fn(entry),
            longest: REACH / fastest,
            weights: RefCell::new((0.0, Vec::new())),
        }
    }

    fn weights(&self, h: f64) -> Weights {
        let stage = |(stage, sources): (usize, &&[usize])| {
            let end = NODES.get(stage).unwrap_or(&1.0);
            let moments = moments(&self.jacobian, h, *end);
            let of = |&source: &usize| {
                let powers = course(sources, source);
                powers.iter().zip(&moments[1..]).map(|(factor, moment)| *factor * moment).sum()
            };
            (moments[0], sources.iter().map(of).collect())
        };
        SOURCES.iter().enumerate().map(stage).collect()
    }
}

/// What a push that grows as (s/h)^k, k = 0 to 3, leaves at `time` h:
/// h time^(k+1) k! phi_(k+1)(time h L), where phi_k(z) = sum_n z^n / (n + k)!.
fn moments(jacobian: &Matrix, h: f64, time: f64) -> [Matrix; 4] {
    let z = *jacobian * (time * h);
    let one = Matrix::identity();
    // phi_4 by Horner's rule, over 1/4!; the others by z phi_(k+1) = phi_k - 1/k!.
    let mut phi = one;
    for n in (1..TERMS).rev() {
        phi = z * phi / f64::from(n + 4) + one;
    }
    phi /= 24.0;
    let third = z * phi + one / 6.0;
    let second = z * third + one / 2.0;
    let first = z * second + one;
    let [a, b, c, d] = [1, 2, 3, 4].map(|power| h * time.powi(power));
    [a * first, b * second, 2.0 * c * third, 6.0 * d * phi]
}

/// Coefficients of s, s^2 and s^3 of the polynomial that is one at the node of `own`, zero at those
/// of the other sources and at 0.
fn course(sources: &[usize], own: usize) -> [f64; 3] {
    let mut coefficients = [1.0 / NODES[own], 0.0, 0.0];
    for &other in sources.iter().filter(|&&other| other != own) {
        let per = 1.0 / (NODES[own] - NODES[other]);
        let [a, b, _] = coefficients;
        coefficients = [-NODES[other] * per * a, per * (a - NODES[other] * b), per * b];
    }
    coefficients
}

impl Method<STATES> for Exponential {
    fn error_order(&self) -> i32 {
        6
    }

    fn trial(
        &self,
        system: &impl System<STATES>,
        x: &State,
        [t, h]: [f64; 2],
        slope: &State,
    ) -> Trial<STATES> {
        if h > self.longest {
            // No right-hand side is spent on it.
            return Trial { next: *x, high: [f64::NAN; STATES], low: [0.0; STATES] };
        }
        let mut kept = self.weights.borrow_mut();
        if kept.0 != h {
            *kept = (h, self.weights(h));
        }
        let start = Vector::from(*slope);
        // D of the stages.
        let mut rest: Vec<Vector> = Vec::new();
        let mut next = *x;
        for (stage, (on_slope, on_rest)) in kept.1.iter().enumerate() {
            let sources = SOURCES[stage].iter().zip(on_rest);
            let moved = on_slope * start + sources.map(|(&i, w)| w * rest[i]).sum::<Vector>();
            next = (Vector::from(*x) + moved).into();
            if let Some(node) = NODES.get(stage) {
                let rates = Vector::from(system.derivatives(t + node * h, &next));
                rest.push(rates - start - self.jacobian * moved);
            }
        }
        let [high, low] = ESTIMATES
            .map(|weights| rest.iter().zip(weights).map(|(d, w)| w * d).sum::<Vector>().into());
        Trial { next, high, low }
    }
}
