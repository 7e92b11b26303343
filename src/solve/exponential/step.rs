//! One step of the exponential method.

use super::scheme::{EARLY, NODES, ROWS, SOURCES, STAGES, lagrange, node};
use crate::solve::blocks::MatrixFunction;
use crate::solve::decoupling::Decoupling;
use crate::solve::integrate::{Attempt, System, Trial};

/// Error over the tolerance below which the step ends at stage 1. Small, as the tolerance of the altitude is
/// large against its excursions.
const EARLY_ERROR: f64 = 1e-3;
/// Share of D_end - D_1 in the error estimate of a full step. For constant J the stages cause an error of
/// 6 (b_1/6 + b_2 a_20 c_0^2/2) = 0.161 times h (D_end - D_1); the larger share keeps the error of long steps
/// within the tolerance.
const STAGE_SHARE: f64 = 0.5;
/// Error of the cubic's integral over q_3 |q_3/q_2|. For smooth D the error is smaller by (q_3/q_2)^2; not so
/// for D at twice the frequency of the fastest oscillator, as in squares of its coordinate.
const QUADRATURE_SHARE: f64 = 0.5;

/// Weights of each D_j in the integral over 0 to 1 of the polynomial through all `sources` less that of the
/// polynomial through all but the first, for L = 0.
const fn difference(sources: &[usize]) -> [f64; STAGES] {
    let (_, fewer) = sources.split_at(1);
    let mut weights = [0.0; STAGES];
    let mut i = 0;
    while i < sources.len() {
        let j = sources[i];
        let [a, b, c] = lagrange(sources, j);
        weights[j] = a / 2.0 + b / 3.0 + c / 4.0;
        if i > 0 {
            let [a, b, c] = lagrange(fewer, j);
            weights[j] -= a / 2.0 + b / 3.0 + c / 4.0;
        }
        i += 1;
    }
    weights
}

/// Weights of q_3, cubic less parabola, and of q_2, parabola less straight line.
const DIFFERENCES: [[f64; STAGES]; 2] = [difference(&[2, 3, 1]), difference(&[3, 1])];

#[inline(always)]
fn sum_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[inline(always)]
fn difference_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// A step in progress. Vectors "in coordinates" are those of [`Decoupling`].
pub(super) struct Step<'a, S, const N: usize, const SLOW: usize, const FAST: usize> {
    pub linear: &'a Decoupling<N, SLOW, FAST>,
    /// As [`super::Exponential`] has them.
    pub weights: &'a [MatrixFunction<N>; ROWS[STAGES + 1]],
    pub attempt: &'a Attempt<'a, S, N>,
    /// Step length less that of the weights, s.
    pub remainder: f64,
    /// F0, in coordinates.
    pub slope: [f64; N],
    /// D of the stages, in coordinates.
    pub residuals: [[f64; N]; STAGES],
}

/// A stage, or the end of the step.
struct Stage<const N: usize> {
    state: [f64; N],
    rates: [f64; N],
    /// D, in coordinates.
    residual: [f64; N],
}

impl<S: System<N>, const N: usize, const SLOW: usize, const FAST: usize>
    Step<'_, S, N, SLOW, FAST>
{
    /// A stage from those before it; number [`STAGES`] is the end of the step.
    #[inline(always)]
    fn stage<const STAGE: usize>(&self) -> Stage<N> {
        let (linear, blocks) = (self.linear, &self.linear.blocks);
        let (node, Attempt { x, slope, t, h, .. }) = (node(STAGE), self.attempt);
        let row = &self.weights[ROWS[STAGE]..ROWS[STAGE + 1]];
        // u = sum of (p + q L) v over the weights p + q L, as sum of p v and L times the sum of q v.
        let (mut u, mut q_sum) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let mut add = |weight: &MatrixFunction<N>, v: f64| {
                u[i] += weight.identity[i] * v;
                q_sum[i] += weight.linear[i] * v;
            };
            add(&row[0], self.slope[i]);
            for (weight, &source) in row[1..].iter().zip(SOURCES[STAGE]) {
                add(weight, self.residuals[source][i]);
            }
        }
        u = sum_of(&u, &blocks.times(&q_sum));
        let mut linear_rate = blocks.times(&u);
        let mut time = node * (h - self.remainder);
        // The remainder of the step length matters only where the step may end.
        if node == 1.0 {
            for i in 0..N {
                u[i] += self.remainder * (self.slope[i] + linear_rate[i]);
            }
            linear_rate = blocks.times(&u);
            time = *h;
        }
        let state = sum_of(x, &linear.to_states(&u));
        let rates = self.attempt.rates(t + time, &state);
        let change = linear.to_coordinates(&difference_of(&rates, slope));
        let residual = difference_of(&change, &linear_rate);
        Stage { state, rates, residual }
    }

    /// Error of the step over the tolerance, for an error of D (in coordinates) over the whole step.
    #[inline(always)]
    fn error(&self, next: &[f64; N], d_error: &[f64; N]) -> f64 {
        self.attempt.error(next, &self.linear.to_states(d_error))
    }

    /// Takes the step, which ends at stage 1 if its error is small enough.
    #[inline(always)]
    pub fn trial(mut self) -> Trial<N> {
        self.residuals[0] = self.stage::<0>().residual;
        let early = self.stage::<EARLY>();
        let d_error = std::array::from_fn(|i| early.residual[i] - self.residuals[0][i] / NODES[0]);
        let error = self.error(&early.state, &d_error);
        if error < EARLY_ERROR {
            return Trial { next: early.state, slope: Some(early.rates), error, order: 3 };
        }
        self.residuals[EARLY] = early.residual;
        self.residuals[2] = self.stage::<2>().residual;
        self.residuals[3] = self.stage::<3>().residual;
        let end = self.stage::<STAGES>();
        let residuals = &self.residuals;
        let quadrature = |weights: &[f64; STAGES], i: usize| -> f64 {
            (0..STAGES).map(|stage| weights[stage] * residuals[stage][i]).sum()
        };
        let d_error = std::array::from_fn(|i| {
            let [q3, q2] = DIFFERENCES.map(|weights| quadrature(&weights, i));
            // The divisor stays above zero: a compiler may execute a division before the condition that
            // guards it.
            let size = q2.abs().max(f64::MIN_POSITIVE);
            let fall = (QUADRATURE_SHARE * q3.abs()).min(size) / size;
            q3 * fall + STAGE_SHARE * (end.residual[i] - residuals[EARLY][i])
        });
        let error = self.error(&end.state, &d_error);
        Trial { next: end.state, slope: Some(end.rates), error, order: 5 }
    }
}
