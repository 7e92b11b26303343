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
//! Two things can be wrong. D at a stage, because the stage is: that shows in D at the step's end, once
//! the end is known, which costs no right-hand side where another step follows. And the cubic,
//! because D is none: that shows in its difference to the parabola through fewer points.

use crate::blocks::{Blocks, Function, PHIS, phis};
use crate::decoupling::Decoupling;
use crate::integrate::{Method, System, Trial};

/// Stages after the first.
const STAGES: usize = 4;
/// Inner Lobatto points, (1 -+ 1/sqrt 5)/2.
const LOBATTO: [f64; 2] = [0.276_393_202_250_021, 0.723_606_797_749_979];
/// Times of the stages over the step. A straight line through zero and two thirds of the way meets the
/// integral of a parabola, so the second stage gains an order.
const NODES: [f64; STAGES] = [2.0 / 3.0 * LOBATTO[0], LOBATTO[0], LOBATTO[1], 1.0];
/// For each stage, and for the step itself, the stages whose D it is made of.
const SOURCES: [&[usize]; STAGES + 1] = [&[], &[0], &[0, 1], &[1, 2], &[1, 2, 3]];
/// Most sources of a stage.
const DEGREE: usize = 3;
/// One weight for f(x0) in each row of [`SOURCES`], and one for each source.
const WEIGHTS: usize = {
    let (mut weights, mut row) = (0, 0);
    while row < SOURCES.len() {
        weights += 1 + SOURCES[row].len();
        row += 1;
    }
    weights
};
/// The stages' errors in the error of the step, over the error of D in the last stage. It is 0.68 for
/// short steps; with this the error found stays below the one that is asked for.
const STAGE_SHARE: f64 = 2.0;
/// The quadrature's error over the last difference of D and the share to which the differences fall.
/// Where D is smooth it is smaller by two falls more; D that moves twice as fast as the fastest
/// oscillator, as squares of it do, is not.
const QUADRATURE: f64 = 0.5;
/// Longest step, rad of the fastest oscillator: the cubic is to follow D at its frequency.
const LONGEST: f64 = 2.0;

/// The method with the oscillators of one system.
#[derive(Debug, Clone)]
pub struct Exponential<const N: usize, const F: usize> {
    linear: Decoupling<N, F>,
    longest: f64,
    /// Length of step for which the weights are, s.
    length: f64,
    /// What each stage, and the step itself, takes of f(x0), then of D of each source.
    weights: [Function<N>; WEIGHTS],
}

impl<const N: usize, const F: usize> Exponential<N, F> {
    /// The method that takes this part of the motion exactly.
    pub fn new(linear: Decoupling<N, F>) -> Self {
        let longest = LONGEST / linear.blocks.fastest;
        Self { linear, longest, length: 0.0, weights: [Function::ZERO; WEIGHTS] }
    }

    /// Makes the weights those of a step of this length.
    fn prepare(&mut self, length: f64) {
        if self.length == length {
            return;
        }
        self.length = length;
        let (mut pushed, mut known, mut next) = ([Function::ZERO; PHIS], 0.0, 0);
        for (stage, sources) in SOURCES.iter().enumerate() {
            let end = *NODES.get(stage).unwrap_or(&1.0);
            if end != known {
                (pushed, known) = (moments(&self.linear.blocks, length, end), end);
            }
            let mut take = |weight| {
                self.weights[next] = weight;
                next += 1;
            };
            take(pushed[0]);
            for &own in *sources {
                let mut weight = Function::ZERO;
                for (factor, moment) in course(sources, own).iter().zip(&pushed[1..]) {
                    weight.add(*factor, moment);
                }
                take(weight);
            }
        }
    }
}

/// A length of step to 2^-32 of it: steps between a master's instants differ in their last digits,
/// and are to share their weights. What is left is too short for the slope to change.
fn rounded(h: f64) -> f64 {
    const HALF: u64 = 1 << (f64::MANTISSA_DIGITS - 1 - 32 - 1);
    f64::from_bits((h.to_bits() + HALF) & !(2 * HALF - 1))
}

/// What a push that grows as (s/h)^k, k = 0 to 3, leaves at `end` h: h end^(k+1) k! phi_(k+1)(end h L).
fn moments<const N: usize>(linear: &Blocks<N>, h: f64, end: f64) -> [Function<N>; PHIS] {
    let mut factor = h;
    let phis = phis(linear, end * h);
    std::array::from_fn(|k| {
        factor *= end * k.max(1) as f64;
        phis[k].scaled(factor)
    })
}

/// Coefficients of s, s^2 and s^3 of the polynomial that is one at the node of `own`, zero at those
/// of the other sources and at 0.
const fn course(sources: &[usize], own: usize) -> [f64; DEGREE] {
    let mut coefficients = [1.0 / NODES[own], 0.0, 0.0];
    let mut i = 0;
    while i < sources.len() {
        if sources[i] != own {
            let other = NODES[sources[i]];
            let per = 1.0 / (NODES[own] - other);
            let [a, b, _] = coefficients;
            coefficients = [-other * per * a, per * (a - other * b), per * b];
        }
        i += 1;
    }
    coefficients
}

/// Integral over the step of the polynomial through D of all `sources` less that of the polynomial
/// without the first of them, without the functions of L: what each stage's D counts.
const fn difference(sources: &[usize]) -> [f64; STAGES] {
    let (_, fewer) = sources.split_at(1);
    let mut weights = [0.0; STAGES];
    let mut i = 0;
    while i < sources.len() {
        let own = sources[i];
        let [a, b, c] = course(sources, own);
        weights[own] = a / 2.0 + b / 3.0 + c / 4.0;
        if i > 0 {
            let [a, b, c] = course(fewer, own);
            weights[own] -= a / 2.0 + b / 3.0 + c / 4.0;
        }
        i += 1;
    }
    weights
}

/// Cubic less parabola, and parabola less straight line.
const DIFFERENCES: [[f64; STAGES]; 2] = [difference(&[1, 2, 3]), difference(&[2, 3])];

/// A sum of functions of L, each times its own vector: a vector, and one that L is still to meet.
struct Sum<const N: usize> {
    one: [f64; N],
    linear: [f64; N],
}

impl<const N: usize> Sum<N> {
    #[inline]
    fn add(&mut self, function: &Function<N>, x: &[f64; N]) {
        for (i, x) in x.iter().enumerate() {
            self.one[i] += function.one[i] * x;
            self.linear[i] += function.linear[i] * x;
        }
    }

    #[inline]
    fn of(&self, blocks: &Blocks<N>) -> [f64; N] {
        let linear = blocks.times(&self.linear);
        std::array::from_fn(|i| self.one[i] + linear[i])
    }
}

#[inline]
fn sum_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[inline]
fn difference_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

impl<const N: usize, const F: usize> Method<N> for Exponential<N, F> {
    fn error_order(&self) -> i32 {
        5
    }

    fn longest(&self) -> f64 {
        self.longest
    }

    fn trial(
        &mut self,
        system: &impl System<N>,
        x: &[f64; N],
        [t, h]: [f64; 2],
        slope: &[f64; N],
    ) -> Trial<N> {
        let length = rounded(h);
        self.prepare(length);
        let left = h - length;

        let (linear, blocks) = (&self.linear, &self.linear.blocks);
        let pull = linear.to_coordinates(slope);
        // In the coordinates of `linear`: D of the stages, and the way from x.
        let mut rest = [[0.0; N]; STAGES];
        let mut moved = [0.0; N];
        let mut last = ([0.0; N], *slope);
        let mut weights = self.weights.iter();
        for (stage, sources) in SOURCES.iter().enumerate() {
            let mut sum = Sum { one: [0.0; N], linear: [0.0; N] };
            let mut take = |x| weights.next().map(|weight| sum.add(weight, x));
            take(&pull);
            for &source in *sources {
                take(&rest[source]);
            }
            moved = sum.of(blocks);
            if let Some(node) = NODES.get(stage) {
                let next = sum_of(x, &linear.to_states(&moved));
                let rates = system.derivatives(t + node * h, &next);
                let (change, own) = (difference_of(&rates, slope), blocks.times(&moved));
                rest[stage] = difference_of(&linear.to_coordinates(&change), &own);
                last = (moved, rates);
            }
        }
        let (before, rates) = last;
        let mut next = sum_of(x, &linear.to_states(&moved));
        for i in 0..N {
            next[i] += left * rates[i];
        }
        let end = system.derivatives(t + h, &next);
        // What the quadrature misses, in the coordinates, and D at the end less D of the last stage.
        let [cubic, parabola]: [[f64; N]; 2] = DIFFERENCES.map(|weights| {
            std::array::from_fn(|i| (0..STAGES).map(|stage| weights[stage] * rest[stage][i]).sum())
        });
        let own = blocks.times(&difference_of(&moved, &before));
        let missed = linear.to_states(&std::array::from_fn(|i| {
            let falls = (cubic[i] / parabola[i]).abs();
            cubic[i] * (QUADRATURE * falls).min(1.0) - STAGE_SHARE * own[i]
        }));
        let high = std::array::from_fn(|i| missed[i] + STAGE_SHARE * (end[i] - rates[i]));
        Trial { next, slope: Some(end), high, low: [0.0; N] }
    }
}
