//! An explicit exponential Runge-Kutta method whose linear part is frozen at trim.
//!
//! With u = x - x0, F0 = f(t0, x0) and a constant matrix L, x' = f(t, x) reads
//!
//! ```text
//! u'   = F0 + L u + D,   D(s) = f(t0 + s, x) - F0 - L u,   D(0) = 0
//! u(h) = h phi_1(h L) F0 + integral from 0 to h of exp((h - s) L) D(s) ds
//! ```
//!
//! L is the part of the Jacobian at trim that the fast states drive ([`Decoupling`]), so the residual D is
//! the nonlinearity, the slow part and the change of the Jacobian since trim.
//!
//! # Stages
//!
//! In the integral of stage i, D is the polynomial in theta = s/h that is zero at theta = 0 and D_j at the
//! nodes c_j of the stage's sources; l_j(theta) = sum_k l_jk theta^k is its Lagrange basis:
//!
//! ```text
//! u_i = c_i h phi_1(c_i h L) F0 + h sum_j a_ij(h L) D_j
//! a_ij(z) = sum_k l_jk k! c_i^(k+1) phi_(k+1)(c_i z),   phi_k(z) = sum_n z^n / (n + k)!
//! ```
//!
//! | stage i | node c_i | sources j | |
//! |---|---|---|---|
//! | 0 | 2/3 | none | exponential Euler |
//! | 1 | 1 | 0 | a_10 = 3/2 phi_2; the step may end here |
//! | 2 | (1 - 1/sqrt 5)/2 | 0, 1 | parabola |
//! | 3 | (1 + 1/sqrt 5)/2 | 1, 2 | parabola |
//! | end | 1 | 2, 3, 1 | cubic through the Lobatto nodes |
//!
//! A step that ends at stage 1 costs two right-hand sides, a full step five; f at the end is the next F0.
//!
//! # Order
//!
//! The weights b_j = a_ij of the last row satisfy the stiff order conditions of quadrature,
//! sum_j b_j(z) c_j^k / k! = phi_(k+1)(z), for k = 1, 2, 3 and every z, those of stage 1 for k = 1: the
//! method is exact for D that are such polynomials in time. At z = 0 they hold to k = 5 (Lobatto) and k = 2
//! (Radau). Conditions that couple stages through J = df/dx - L: for L = 0 all classical conditions of order
//! 3 hold, and of those of order 4 all but b A A c = 1/24 (it is 0.0148). So the full step has order 3, with
//! the leading error 0.027 h^4 J^3 F0, and stage 1 has order 2, with h^3 J^2 F0 / 6; both gain one order
//! where J^2 = 0, as for forces that depend on positions only. Tests: `verif_polynomial_residuals_are_exact`,
//! `verif_the_classical_order_is_three_and_two`, and those of the order in `verif_exponential`.
//!
//! # Error estimates
//!
//! ```text
//! stage 1:   h (D_1 - D_0/c_0)
//! full step: h (q_3 min(1, |q_3| / (2 |q_2|)) + (D_end - D_1)/2)
//! ```
//!
//! The first compares D at the end with the straight line that was integrated. In the second, q_3 is the
//! integral of the cubic less that of the parabola through c_3 and 1, and q_2 that of the parabola less that
//! of the line through 1, both for L = 0: the differences fall geometrically, so the next is extrapolated.
//! D_end - D_1, which costs nothing as f at the end is needed anyway, measures the errors of the stages.
//!
//! Sources: M. Hochbruck, A. Ostermann, Explicit exponential Runge-Kutta methods for semilinear parabolic
//! problems, SIAM J. Numer. Anal. 43(3), 2005, 1069-1090 (stiff order conditions); the same, Exponential
//! integrators, Acta Numerica 19, 2010, 209-286, section 2 (phi functions, derivation). Nodes, sources and
//! error estimates are our own.

mod scheme;
mod step;

use super::blocks::{Blocks, MatrixFunction, PHIS, phis};
use super::decoupling::Decoupling;
use super::integrate::{Attempt, Method, System, Trial};
use multiversion::multiversion;
use scheme::{ROWS, SOURCES, STAGES, lagrange, node};
use step::Step;

/// Longest step, rad of the fastest oscillator: the cubic must resolve D at its frequency.
const MAX_STEP_RAD: f64 = 2.0;

/// The method with the linear part L of one system.
#[derive(Debug, Clone)]
pub struct Exponential<const N: usize, const SLOW: usize, const FAST: usize> {
    linear: Decoupling<N, SLOW, FAST>,
    max_step: f64,
    /// Step length the weights were computed for, s.
    weights_h: f64,
    /// For each stage and for the end: c_i h phi_1(c_i h L), then h a_ij(h L) of each source.
    weights: [MatrixFunction<N>; ROWS[STAGES + 1]],
}

impl<const N: usize, const SLOW: usize, const FAST: usize> Exponential<N, SLOW, FAST> {
    /// The method that integrates this linear part exactly.
    pub fn new(linear: Decoupling<N, SLOW, FAST>) -> Self {
        let max_step = MAX_STEP_RAD / linear.blocks.spectral_radius;
        let weights = [MatrixFunction::ZERO; ROWS[STAGES + 1]];
        Self { linear, max_step, weights_h: 0.0, weights }
    }

    /// Computes the weights of a step of length `h`, s.
    #[inline(always)]
    fn prepare(&mut self, h: f64) {
        if self.weights_h == h {
            return;
        }
        self.weights_h = h;
        let full = monomials(&self.linear.blocks, h, 1.0);
        for (stage, sources) in SOURCES.iter().enumerate() {
            let integrals = match node(stage) {
                1.0 => full,
                node => monomials(&self.linear.blocks, h, node),
            };
            let row = &mut self.weights[ROWS[stage]..ROWS[stage + 1]];
            row[0] = integrals[0];
            for (weight, &source) in row[1..].iter_mut().zip(*sources) {
                *weight = MatrixFunction::ZERO;
                for (factor, integral) in lagrange(sources, source).iter().zip(&integrals[1..]) {
                    weight.add(*factor, integral);
                }
            }
        }
    }

    /// [`Method::trial`] compiled for the baseline instruction set.
    #[inline(always)]
    pub fn portable<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        let weights_h = rounded(attempt.h);
        self.prepare(weights_h);
        let remainder = attempt.h - weights_h;
        let slope = self.linear.to_coordinates(attempt.slope);
        let Self { linear, weights, .. } = self;
        let residuals = [[0.0; N]; STAGES];
        Step { linear, weights, attempt, remainder, slope, residuals }.trial()
    }
}

/// A step length rounded to 2^-32 relative: steps between a master's communication points differ in their
/// last digits and can then share weights. [`Step`] covers the remainder by u' = F0 + L u.
fn rounded(h: f64) -> f64 {
    const HALF: u64 = 1 << (f64::MANTISSA_DIGITS - 1 - 32 - 1);
    f64::from_bits((h.to_bits() + HALF) & !(2 * HALF - 1))
}

/// Integrals from 0 to c h of exp((c h - s) L) (s/h)^k ds = h c^(k+1) k! phi_(k+1)(c h L), k = 0 to 3.
#[inline(always)]
fn monomials<const N: usize>(linear: &Blocks<N>, h: f64, c: f64) -> [MatrixFunction<N>; PHIS] {
    let mut factor = h;
    let phis = phis(linear, c * h);
    std::array::from_fn(|k| {
        factor *= c * k.max(1) as f64;
        phis[k].scaled(factor)
    })
}

impl<const N: usize, const SLOW: usize, const FAST: usize> Method<N>
    for Exponential<N, SLOW, FAST>
{
    fn max_step(&self) -> f64 {
        self.max_step
    }

    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        vectorised(self, attempt)
    }
}

/// [`Exponential::portable`] compiled again with AVX, four states at a time: the same operations in the same
/// order, so the same bits.
#[multiversion(targets("x86_64+avx"))]
fn vectorised<S: System<N>, const N: usize, const SLOW: usize, const FAST: usize>(
    method: &mut Exponential<N, SLOW, FAST>,
    attempt: &Attempt<S, N>,
) -> Trial<N> {
    method.portable(attempt)
}
