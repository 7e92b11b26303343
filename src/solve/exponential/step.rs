//! One step of the exponential method.

use super::scheme::{EARLY, NODES, ROWS, SOURCES, STAGES, course, node};
use crate::solve::blocks::MatrixFunction;
use crate::solve::decoupling::Decoupling;
use crate::solve::integrate::{Attempt, System, Trial};

/// Error over the tolerance below which the step ends early. So small because the tolerance of an altitude
/// is large, and its excursions are to keep their digits.
const EARLY_ERROR: f64 = 1e-3;
/// The stages' errors in the error of the step, over the error of D in the early end. It is 0.16 for
/// short steps; with this the error found stays below the one that is asked for.
const STAGE_SHARE: f64 = 0.5;
/// The quadrature's error over the last difference of D and the share to which the differences fall.
/// Where D is smooth it is smaller by two falls more; D that moves twice as fast as the fastest
/// oscillator, as squares of it do, is not.
const QUADRATURE: f64 = 0.5;

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
const DIFFERENCES: [[f64; STAGES]; 2] = [difference(&[2, 3, 1]), difference(&[3, 1])];

#[inline(always)]
fn sum_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[inline(always)]
fn difference_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// A step under way.
pub(super) struct Step<'a, S, const N: usize, const SLOW: usize, const FAST: usize> {
    pub linear: &'a Decoupling<N, SLOW, FAST>,
    /// What each stage, and the step itself, takes of f(x0), then of D of each source.
    pub weights: &'a [MatrixFunction<N>; ROWS[STAGES + 1]],
    pub attempt: &'a Attempt<'a, S, N>,
    /// What the weights leave of the step's length, s.
    pub left: f64,
    /// The slope in the coordinates.
    pub pull: [f64; N],
    /// D of the stages in the coordinates.
    pub rest: [[f64; N]; STAGES],
}

/// A stage, or the step's end.
struct Reached<const N: usize> {
    state: [f64; N],
    rates: [f64; N],
    /// In the coordinates.
    d: [f64; N],
}

impl<S: System<N>, const N: usize, const SLOW: usize, const FAST: usize>
    Step<'_, S, N, SLOW, FAST>
{
    /// A stage from those before; the last is the end.
    #[inline(always)]
    fn reach<const STAGE: usize>(&self) -> Reached<N> {
        let (linear, blocks) = (self.linear, &self.linear.blocks);
        let (node, Attempt { x, slope, t, h, .. }) = (node(STAGE), self.attempt);
        let row = &self.weights[ROWS[STAGE]..ROWS[STAGE + 1]];
        // Sums of functions of L: multiples of one, and of L.
        let (mut moved, mut linear_in) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let mut take = |weight: &MatrixFunction<N>, x: f64| {
                moved[i] += weight.identity[i] * x;
                linear_in[i] += weight.linear[i] * x;
            };
            take(&row[0], self.pull[i]);
            for (weight, &source) in row[1..].iter().zip(SOURCES[STAGE]) {
                take(weight, self.rest[source][i]);
            }
        }
        moved = sum_of(&moved, &blocks.times(&linear_in));
        let mut drift = blocks.times(&moved);
        let mut time = node * (h - self.left);
        // Only where the step may end does it matter what the weights leave.
        if node == 1.0 {
            for i in 0..N {
                moved[i] += self.left * (self.pull[i] + drift[i]);
            }
            drift = blocks.times(&moved);
            time = *h;
        }
        let state = sum_of(x, &linear.to_states(&moved));
        let rates = self.attempt.rates(t + time, &state);
        let change = linear.to_coordinates(&difference_of(&rates, slope));
        let d = difference_of(&change, &drift);
        Reached { state, rates, d }
    }

    /// What an error of D (in the coordinates) makes of the step, over the tolerance.
    #[inline(always)]
    fn error(&self, next: &[f64; N], missed: &[f64; N]) -> f64 {
        self.attempt.error(next, &self.linear.to_states(missed))
    }

    /// The step's end, early or not.
    #[inline(always)]
    pub fn trial(mut self) -> Trial<N> {
        self.rest[0] = self.reach::<0>().d;
        let early = self.reach::<EARLY>();
        // The error of the early end is half of this for short steps in which D changes with the state.
        let missed = std::array::from_fn(|i| early.d[i] - self.rest[0][i] / NODES[0]);
        let error = self.error(&early.state, &missed);
        if error < EARLY_ERROR {
            return Trial { next: early.state, slope: Some(early.rates), error, order: 3 };
        }
        self.rest[EARLY] = early.d;
        self.rest[2] = self.reach::<2>().d;
        self.rest[3] = self.reach::<3>().d;
        let end = self.reach::<STAGES>();
        let rest = &self.rest;
        let quadrature = |weights: &[f64; STAGES], i: usize| -> f64 {
            (0..STAGES).map(|stage| weights[stage] * rest[stage][i]).sum()
        };
        let missed = std::array::from_fn(|i| {
            let [cubic, parabola] =
                [quadrature(&DIFFERENCES[0], i), quadrature(&DIFFERENCES[1], i)];
            // A coordinate at rest has neither: the divisor stays above zero, not the division behind a
            // condition, which a compiler would speculate.
            let size = parabola.abs().max(f64::MIN_POSITIVE);
            let falls = (QUADRATURE * cubic.abs()).min(size) / size;
            cubic * falls + STAGE_SHARE * (end.d[i] - rest[EARLY][i])
        });
        let error = self.error(&end.state, &missed);
        Trial { next: end.state, slope: Some(end.rates), error, order: 5 }
    }
}
