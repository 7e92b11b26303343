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
//! The stages form a ladder: each rung evaluates D at more nodes, at states from the polynomial of the rung below, and
//! ends with an approximation of u(h). The step ends at the first rung that is accurate enough.
//!
//! | rung | stage i | node c_i | sources j | |
//! |---|---|---|---|---|
//! | first | 0 | 2/3 | none | exponential Euler |
//! | | 1 | 1 | 0 | a_10 = 3/2 phi_2 |
//! | second | 2 | (1 - 1/sqrt 5)/2 | 0, 1 | parabola |
//! | | 3 | (1 + 1/sqrt 5)/2 | 1, 2 | parabola |
//! | | 4 | 1 | 2, 3, 1 | cubic through the four Lobatto points |
//! | third | 5 | (1 - sqrt(1/3 + 2 sqrt 7/21))/2 | 2, 3, 4 | cubic |
//! | | 6 | (1 - sqrt(1/3 - 2 sqrt 7/21))/2 | 2, 3, 4, 5 | quartic |
//! | | 7 | (1 + sqrt(1/3 - 2 sqrt 7/21))/2 | 3, 4, 5, 6 | quartic |
//! | | 8 | (1 + sqrt(1/3 + 2 sqrt 7/21))/2 | 4, 5, 6, 7 | quartic |
//! | | 9 | 1 | 5, 6, 7, 8, 4 | quintic through the six Lobatto points |
//!
//! Near trim and at moderate tolerances the first two rungs suffice; the third is for tight tolerances and flights
//! far from trim. A step that ends at them costs two, five and ten right-hand sides; f at the end is the next F0.
//!
//! # Order
//!
//! The weights b_j = a_ij of the end of a rung satisfy the stiff order conditions of quadrature,
//! sum_j b_j(z) c_j^k / k! = phi_(k+1)(z), for every z and k = 1, 3 and 5 at most: the
//! method is exact for D that are such polynomials in time. At z = 0 they hold to k = 2 (Radau), 5 and 9 (Lobatto).
//! Conditions that couple stages through J = df/dx - L: for L = 0 the second rung meets all classical conditions of order
//! 3, and of those of order 4 all but b A A c = 1/24 (it is 0.0148). So it has order 3, with
//! the leading error 0.027 h^4 J^3 F0, and the first has order 2, with h^3 J^2 F0 / 6; both gain one order
//! where J^2 = 0, as for forces that depend on positions only. The third rung converges with order five where D is
//! large. Tests: `verif_polynomial_residuals_are_exact`, `verif_the_classical_order_is_three_and_two`, and those of the
//! order in `verif_exponential`.
//!
//! # Error estimates
//!
//! ```text
//! first:   h (D_1 - D_0/c_0)
//! second:  h (q_3 min(1, |q_3| / (2 |q_2|)) + (D_4 - D_1)/2)
//! third:   |h (D_9 - D_4)| + 7.16e-7 (2 h omega)^4 |u_9 - u_4|
//! ```
//!
//! The first compares D at the end with the straight line that was integrated. In the second, q_3 is the
//! integral of the cubic less that of the parabola through c_3 and 1, and q_2 that of the parabola less that
//! of the line through 1, both for L = 0: the differences fall geometrically, so the next is extrapolated.
//! D_4 - D_1, which costs nothing as f at the end is needed anyway, measures the errors of the stages; so does
//! D_9 - D_4. The other term of the third is that of quadrature: the error of the second rung times the ratio of the
//! errors of Lobatto's rules with six and four points, for twice the frequency omega of the fastest oscillator, as in
//! squares of its coordinate.
//!
//! # Step lengths
//!
//! A step that ends at the second rung is followed by one of at least twice its length, if that is not too long: it may
//! need the third rung, but that costs no more for its length. After a third rung steps become as short as the
//! second allows where this costs less.
//!
//! Sources: M. Hochbruck, A. Ostermann, Explicit exponential Runge-Kutta methods for semilinear parabolic
//! problems, SIAM J. Numer. Anal. 43(3), 2005, 1069-1090 (stiff order conditions); the same, Exponential
//! integrators, Acta Numerica 19, 2010, 209-286, section 2 (phi functions, derivation); T. Buvoli, A class of
//! exponential integrators based on spectral deferred correction, SIAM J. Sci. Comput. 42(1), 2020, A1-A27 (rungs as
//! corrections). Nodes, sources and error estimates are our own.

mod scheme;
mod step;
mod weights;

use super::decoupling::Decoupling;
use super::integrate::{Attempt, Method, System, Trial};
use multiversion::multiversion;
use scheme::{COARSE, FINE, ROWS, STAGES};
use step::{Coarse, Step};
use weights::Weights;

/// Longest step, rad of the fastest oscillator: the polynomials must resolve D at its frequency.
const MAX_STEP_RAD: f64 = 2.0;

/// The method with the linear part L of one system.
#[derive(Debug, Clone)]
pub struct Exponential<const N: usize, const SLOW: usize, const FAST: usize> {
    linear: Decoupling<N, SLOW, FAST>,
    max_step: f64,
    coarse: Weights<N, { ROWS[COARSE.end] }>,
    fine: Weights<N, { ROWS[STAGES] - ROWS[FINE.start] }>,
}

impl<const N: usize, const SLOW: usize, const FAST: usize> Exponential<N, SLOW, FAST> {
    /// The method that integrates this linear part exactly.
    pub fn new(linear: Decoupling<N, SLOW, FAST>) -> Self {
        let max_step = MAX_STEP_RAD / linear.blocks.spectral_radius;
        Self { linear, max_step, coarse: Weights::NONE, fine: Weights::NONE }
    }

    /// [`Method::trial`] compiled for the baseline instruction set.
    pub fn portable<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        let Self { linear, max_step, coarse, fine } = self;
        Step::new(linear, attempt, *max_step).coarse(coarse, |step, coarse| step.fine(fine, coarse))
    }
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
    let Exponential { linear, max_step, coarse, fine } = method;
    Step::new(linear, attempt, *max_step)
        .coarse(coarse, |step, coarse| vectorised_fine(step, fine, coarse))
}

/// [`Step::fine`], likewise; apart from the other rungs, which are faster for it.
#[multiversion(targets("x86_64+avx"))]
fn vectorised_fine<
    S: System<N>,
    const N: usize,
    const SLOW: usize,
    const FAST: usize,
    const ROWS: usize,
>(
    step: Step<S, N, SLOW, FAST>,
    weights: &mut Weights<N, ROWS>,
    coarse: &Coarse<N>,
) -> Trial<N> {
    step.fine(weights, coarse)
}
