//! An exponential method: the oscillators' own motion exactly, the rest as a polynomial in time.
//!
//! From x0 the system moves by f(x0) and by L (x - x0), which functions of L answer exactly, and by
//! what is left, D = f(x) - f(x0) - L (x - x0):
//!
//! x(h) = x0 + h phi_1(h L) f(x0) + integral over s from 0 to h of exp((h - s) L) D(s)
//!
//! The course of D is a polynomial through zero and its values at stages before (Hochbruck,
//! Ostermann, Exponential integrators, Acta Numerica 19, 2010, section 2.3), in the end the cubic
//! through those at the Lobatto points. L is the Jacobian in steady flight, as the fast states move
//! the vehicle: near it D is what is not linear, far from it also how the Jacobian has changed.
//!
//! The second stage is a step by itself: the straight line through D at two thirds of the way has the
//! integral of a parabola. Where D at the end is near enough to that line the step ends there, for two
//! right-hand sides in place of five, of which nothing is lost where it does not.
//!
//! Two things can be wrong. D at a stage, because the stage is: that shows in D at the step's end, once
//! the end is known, which costs no right-hand side where another step follows. And the cubic,
//! because D is none: that shows in its difference to the parabola through fewer points.

mod scheme;
mod step;

use super::blocks::{Blocks, MatrixFunction, PHIS, phis};
use super::decoupling::Decoupling;
use super::integrate::{Attempt, Method, System, Trial};
use multiversion::multiversion;
use scheme::{ROWS, SOURCES, STAGES, course, node};
use step::Step;

/// Longest step, rad of the fastest oscillator: the cubic is to follow D at its frequency.
const LONGEST: f64 = 2.0;

/// The method with the oscillators of one system.
#[derive(Debug, Clone)]
pub struct Exponential<const N: usize, const SLOW: usize, const FAST: usize> {
    linear: Decoupling<N, SLOW, FAST>,
    longest: f64,
    /// Length of step for which the weights are, s.
    length: f64,
    /// What each stage, and the step itself, takes of f(x0), then of D of each source.
    weights: [MatrixFunction<N>; ROWS[STAGES + 1]],
}

impl<const N: usize, const SLOW: usize, const FAST: usize> Exponential<N, SLOW, FAST> {
    /// The method that takes this part of the motion exactly.
    pub fn new(linear: Decoupling<N, SLOW, FAST>) -> Self {
        let longest = LONGEST / linear.blocks.fastest;
        Self { linear, longest, length: 0.0, weights: [MatrixFunction::ZERO; ROWS[STAGES + 1]] }
    }

    /// Makes the weights those of a step of this length.
    #[inline(always)]
    fn prepare(&mut self, length: f64) {
        if self.length == length {
            return;
        }
        self.length = length;
        let whole = moments(&self.linear.blocks, length, 1.0);
        for (stage, sources) in SOURCES.iter().enumerate() {
            let pushed = match node(stage) {
                1.0 => whole,
                end => moments(&self.linear.blocks, length, end),
            };
            let row = &mut self.weights[ROWS[stage]..ROWS[stage + 1]];
            row[0] = pushed[0];
            for (weight, &own) in row[1..].iter_mut().zip(*sources) {
                *weight = MatrixFunction::ZERO;
                for (factor, moment) in course(sources, own).iter().zip(&pushed[1..]) {
                    weight.add(*factor, moment);
                }
            }
        }
    }

    /// [`Method::trial`] in the registers that every processor has.
    #[inline(always)]
    pub fn portable<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        let length = rounded(attempt.h);
        self.prepare(length);
        let (left, pull) = (attempt.h - length, self.linear.to_coordinates(attempt.slope));
        let Self { linear, weights, .. } = self;
        Step { linear, weights, attempt, left, pull, rest: [[0.0; N]; STAGES] }.trial()
    }
}

/// A length of step to 2^-32 of it: steps between a master's instants differ in their last digits,
/// and are to share their weights. What is left is too short for the slope to change.
fn rounded(h: f64) -> f64 {
    const HALF: u64 = 1 << (f64::MANTISSA_DIGITS - 1 - 32 - 1);
    f64::from_bits((h.to_bits() + HALF) & !(2 * HALF - 1))
}

/// What a push that grows as (s/h)^k, k = 0 to 3, leaves at `end` h: h end^(k+1) k! phi_(k+1)(end h L).
#[inline(always)]
fn moments<const N: usize>(linear: &Blocks<N>, h: f64, end: f64) -> [MatrixFunction<N>; PHIS] {
    let mut factor = h;
    let phis = phis(linear, end * h);
    std::array::from_fn(|k| {
        factor *= end * k.max(1) as f64;
        phis[k].scaled(factor)
    })
}

impl<const N: usize, const SLOW: usize, const FAST: usize> Method<N>
    for Exponential<N, SLOW, FAST>
{
    fn max_step(&self) -> f64 {
        self.longest
    }

    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        in_widest(self, attempt)
    }
}

/// The same operations in the same order, so the same bits, but four states at a time where the processor
/// can: whatever is always inlined is compiled again for its wider registers.
#[multiversion(targets("x86_64+avx"))]
fn in_widest<S: System<N>, const N: usize, const SLOW: usize, const FAST: usize>(
    method: &mut Exponential<N, SLOW, FAST>,
    attempt: &Attempt<S, N>,
) -> Trial<N> {
    method.portable(attempt)
}
