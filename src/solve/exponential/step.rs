//! One step of the exponential method.

use super::scheme::{
    COARSE, COARSE_DEGREE, ENDS, FINE, FINE_DEGREE, NODES, SOURCES, STAGES, lagrange,
};
use super::weights::Weights;
use crate::solve::blocks::MatrixFunction;
use crate::solve::decoupling::Decoupling;
use crate::solve::integrate::{Attempt, System, Trial, step_factor};

/// Error over the tolerance below which the step ends at the first rung. Small, as the tolerance of the
/// altitude is large against its excursions.
const EARLY_ERROR: f64 = 1e-3;
/// Share of D_end - D_1 in the error estimate of the second rung. For constant J the stages cause an error of
/// 6 (b_1/6 + b_2 a_20 c_0^2/2) = 0.161 times h (D_end - D_1); the larger share keeps the error of long steps
/// within the tolerance.
const STAGE_SHARE: f64 = 0.5;
/// Error of the cubic's integral over q_3 |q_3/q_2|. For smooth D the error is smaller by (q_3/q_2)^2; not so
/// for D at twice the frequency of the fastest oscillator, as in squares of its coordinate.
const QUADRATURE_SHARE: f64 = 0.5;
/// Error of the second rung over the tolerance above which a third is not tried: it gains three to five digits.
const REACH: f64 = 1e5;
/// Error of Lobatto's rule with six points over that with four, for a frequency y/h, over y^4: C_6/C_4 of the errors
/// C_n h^(2n-1) D^(2n-2), C_n = n (n-1)^3 (n-2)!^4 / ((2n-1) (2n-2)!^3) (Abramowitz, Stegun, eq. 25.4.32).
const LOBATTO_RATIO: f64 = lobatto_error(6) / lobatto_error(4);
/// Right-hand sides of a step of three rungs over those of a step of two.
const COST: f64 = 2.0;
/// Powers of h with which the errors of the rungs fall.
const ORDERS: [i32; 3] = [3, 5, 6];

/// Weights of each D_j in the integral over 0 to 1 of the polynomial through all `sources` less that of the
/// polynomial through all but the first, for L = 0.
const fn difference(sources: &[usize]) -> [f64; ENDS[1]] {
    let (_, fewer) = sources.split_at(1);
    let mut weights = [0.0; ENDS[1]];
    let mut i = 0;
    while i < sources.len() {
        let j = sources[i];
        weights[j] = integral(lagrange(sources, j));
        if i > 0 {
            weights[j] -= integral(lagrange(fewer, j));
        }
        i += 1;
    }
    weights
}

/// Integral over 0 to 1 of the cubic with these coefficients of theta, theta^2, theta^3.
const fn integral([a, b, c, ..]: [f64; FINE_DEGREE]) -> f64 {
    a / 2.0 + b / 3.0 + c / 4.0
}

/// Weights of q_3, cubic less parabola, and of q_2, parabola less straight line.
const DIFFERENCES: [[f64; ENDS[1]]; 2] = [difference(&[2, 3, 1]), difference(&[3, 1])];

const fn lobatto_error(points: usize) -> f64 {
    let n = points as f64;
    let [inner, all] = [factorial(points - 2), factorial(2 * points - 2)];
    n * (n - 1.0) * (n - 1.0) * (n - 1.0) / (2.0 * n - 1.0) * inner * inner * inner * inner
        / (all * all * all)
}

const fn factorial(n: usize) -> f64 {
    if n == 0 { 1.0 } else { n as f64 * factorial(n - 1) }
}

#[inline(always)]
fn sum_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

#[inline(always)]
fn difference_of<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// A step length rounded to 2^-32 relative: steps between a master's communication points differ in their
/// last digits and can then share weights. [`Step`] covers the remainder by u' = F0 + L u + D.
fn rounded(h: f64) -> f64 {
    const HALF: u64 = 1 << (f64::MANTISSA_DIGITS - 1 - 32 - 1);
    f64::from_bits((h.to_bits() + HALF) & !(2 * HALF - 1))
}

/// A step in progress. Vectors "in coordinates" are those of [`Decoupling`].
pub(super) struct Step<'a, S, const N: usize, const SLOW: usize, const FAST: usize> {
    linear: &'a Decoupling<N, SLOW, FAST>,
    attempt: &'a Attempt<'a, S, N>,
    /// Longest step, s.
    max_step: f64,
    /// Step length of the weights, s.
    weights_h: f64,
    /// F0, in coordinates.
    slope: [f64; N],
}

/// A stage.
struct Stage<const N: usize> {
    state: [f64; N],
    rates: [f64; N],
    /// D, in coordinates.
    residual: [f64; N],
}

/// What the third rung needs of the second.
pub(super) struct Coarse<const N: usize> {
    /// State at the end of the step.
    state: [f64; N],
    /// D of the stages, in coordinates.
    residuals: [[f64; N]; COARSE.end],
    /// Length of the next step over that of this one.
    factor: f64,
}

impl<const N: usize> Stage<N> {
    /// The step that ends here.
    #[inline(always)]
    fn end(self, error: f64, factor: f64) -> Trial<N> {
        Trial { next: self.state, slope: Some(self.rates), error, factor }
    }
}

impl<'a, S: System<N>, const N: usize, const SLOW: usize, const FAST: usize>
    Step<'a, S, N, SLOW, FAST>
{
    #[inline(always)]
    pub fn new(
        linear: &'a Decoupling<N, SLOW, FAST>,
        attempt: &'a Attempt<'a, S, N>,
        max_step: f64,
    ) -> Self {
        Self {
            linear,
            attempt,
            max_step,
            weights_h: rounded(attempt.h),
            slope: linear.to_coordinates(attempt.slope),
        }
    }

    /// A stage from its sources among the `residuals`, with its weights.
    #[inline(always)]
    fn stage(
        &self,
        stage: usize,
        weights: &[MatrixFunction<N>],
        residuals: &[[f64; N]],
    ) -> Stage<N> {
        let (linear, blocks) = (self.linear, &self.linear.blocks);
        let (node, Attempt { x, slope, t, h, .. }) = (NODES[stage], self.attempt);
        // The remainder of the step length matters only where the step may end; there u' = F0 + L u + D, and D is a
        // straight line up to the last source or known at the end.
        let ends = node == 1.0;
        let remainder = if ends { h - self.weights_h } else { 0.0 };
        // u = sum of (p + q L) v over the weights p + q L, as sum of p v and L times the sum of q v.
        let (mut u, mut q_sum) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let mut add = |weight: &MatrixFunction<N>, v: f64| {
                u[i] += weight.identity[i] * v;
                q_sum[i] += weight.linear[i] * v;
            };
            let mut rate = self.slope[i];
            add(&weights[0], rate);
            for (weight, &source) in weights[1..].iter().zip(SOURCES[stage]) {
                add(weight, residuals[source][i]);
            }
            if let (true, [.., last]) = (ends, SOURCES[stage]) {
                rate += residuals[*last][i] * (1.0 / NODES[*last]);
                u[i] += remainder * rate;
            }
        }
        u = sum_of(&u, &blocks.times(&q_sum));
        let mut linear_rate = blocks.times(&u);
        if ends {
            for i in 0..N {
                u[i] += remainder * linear_rate[i];
            }
            linear_rate = blocks.times(&u);
        }
        let time = if ends { *h } else { node * self.weights_h };
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

    /// The first two rungs, and `third` where their error is too large.
    #[inline(always)]
    pub fn coarse<const ROWS: usize>(
        self,
        weights: &mut Weights<N, ROWS>,
        third: impl FnOnce(Self, &Coarse<N>) -> Trial<N>,
    ) -> Trial<N> {
        weights.prepare::<{ COARSE_DEGREE + 1 }>(COARSE, &self.linear.blocks, self.weights_h);
        let of = |stage| weights.of(stage, COARSE.start);

        let mut residuals = [[0.0; N]; ENDS[1]];
        residuals[0] = self.stage(0, of(0), &residuals).residual;
        let early = self.stage(ENDS[0], of(ENDS[0]), &residuals);
        let d_error = std::array::from_fn(|i| early.residual[i] - residuals[0][i] / NODES[0]);
        let error = self.error(&early.state, &d_error);
        if error < EARLY_ERROR {
            return early.end(error, step_factor(error, ORDERS[0]));
        }

        residuals[ENDS[0]] = early.residual;
        residuals[2] = self.stage(2, of(2), &residuals).residual;
        residuals[3] = self.stage(3, of(3), &residuals).residual;
        let end = self.stage(ENDS[1], of(ENDS[1]), &residuals);
        let quadrature = |weights: &[f64; ENDS[1]], i: usize| -> f64 {
            (0..ENDS[1]).map(|stage| weights[stage] * residuals[stage][i]).sum()
        };
        let d_error = std::array::from_fn(|i| {
            let [q3, q2] = DIFFERENCES.map(|weights| quadrature(&weights, i));
            // The divisor stays above zero: a compiler may execute a division before the condition that
            // guards it.
            let size = q2.abs().max(f64::MIN_POSITIVE);
            let fall = (QUADRATURE_SHARE * q3.abs()).min(size) / size;
            q3 * fall + STAGE_SHARE * (end.residual[i] - residuals[ENDS[0]][i])
        });
        let error = self.error(&end.state, &d_error);
        let factor = step_factor(error, ORDERS[1]);
        if error > 1.0 && error < REACH {
            let [d0, d1, d2, d3] = residuals;
            let residuals = [d0, d1, d2, d3, end.residual];
            return third(self, &Coarse { state: end.state, residuals, factor });
        }
        // A step so long that it needs the third rung costs no more for its length.
        let longer = error <= 1.0 && COST * self.attempt.h <= self.max_step;
        end.end(error, if longer { factor.max(COST) } else { factor })
    }

    /// The third rung.
    #[inline(always)]
    pub fn fine<const ROWS: usize>(
        self,
        weights: &mut Weights<N, ROWS>,
        coarse: &Coarse<N>,
    ) -> Trial<N> {
        weights.prepare::<{ FINE_DEGREE + 1 }>(FINE, &self.linear.blocks, self.weights_h);
        let mut residuals = [[0.0; N]; STAGES];
        residuals[COARSE].copy_from_slice(&coarse.residuals);
        let of = |stage| weights.of(stage, FINE.start);
        residuals[5] = self.stage(5, of(5), &residuals).residual;
        residuals[6] = self.stage(6, of(6), &residuals).residual;
        residuals[7] = self.stage(7, of(7), &residuals).residual;
        residuals[8] = self.stage(8, of(8), &residuals).residual;
        let end = self.stage(ENDS[2], of(ENDS[2]), &residuals);
        let Self { linear, attempt, max_step, .. } = self;
        let stages = self.error(&end.state, &difference_of(&end.residual, &residuals[ENDS[1]]));
        let gain = std::array::from_fn(|i| (end.state[i] - coarse.state[i]) / attempt.h);
        let y = 2.0 * attempt.h * linear.blocks.spectral_radius;
        let quadrature = LOBATTO_RATIO * y * y * y * y * attempt.error(&end.state, &gain);
        let error = stages + quadrature;
        let factor = step_factor(error, ORDERS[2]);
        // Steps of two rungs may cost less where these need not be much longer.
        let longest = factor.min(max_step / attempt.h);
        let shorter = error <= 1.0 && COST * coarse.factor > longest;
        end.end(error, if shorter { coarse.factor } else { factor })
    }
}
