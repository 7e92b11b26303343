//! Polynomial interpolation at Chebyshev points on `[-1, 1]`.
//!
//! ```text
//! x_j = cos(j pi/n),   p(x) = sum_j l_j(x) p(x_j),   l_j(x) = (2/n) c_j sum_k c_k T_k(x_j) T_k(x)
//! ```
//!
//! over j, k = 0 to n, with c = 1/2 for the first and the last, and 1 for the others (Mason, Handscomb,
//! Chebyshev Polynomials, 2003, section 6.3.2). The error of a function that is analytic within an ellipse
//! with the foci -1 and 1, whose semi-axes add up to rho, falls with rho^-n (Trefethen, Approximation Theory
//! and Approximation Practice, 2013, theorem 8.2).

use std::f64::consts::PI;

/// Interpolation at `N` points.
#[derive(Debug)]
pub struct Chebyshev<const N: usize> {
    /// The points, from 1 to -1.
    pub points: [f64; N],
}

impl<const N: usize> Chebyshev<N> {
    /// The points; at least two.
    pub fn new() -> Self {
        let step = PI / (N - 1) as f64;
        Self { points: std::array::from_fn(|j| libm::cos(step * j as f64)) }
    }

    /// Weights of the values at the points in the value and in the slope of the polynomial at x.
    pub fn weights(&self, x: f64) -> [[f64; N]; 2] {
        let n = N - 1;
        let share = |k: usize| if k == 0 || k == n { 0.5 } else { 1.0 };
        let [mut values, mut slopes] = [[0.0; N]; 2];
        // T_k and its derivative, and those of T_(k-1).
        let [mut this, mut last] = [[1.0, 0.0], [x, 1.0]];
        for k in 0..N {
            for (j, (value, slope)) in values.iter_mut().zip(&mut slopes).enumerate() {
                // T_k(x_j) is the cosine of j k pi/n.
                let turns = j * k % (2 * n);
                let at_point = self.points[turns.min(2 * n - turns)];
                let factor = 2.0 / n as f64 * share(j) * share(k) * at_point;
                *value += factor * this[0];
                *slope += factor * this[1];
            }
            let double = 2.0 * x;
            (this, last) =
                ([double * this[0] - last[0], 2.0 * this[0] + double * this[1] - last[1]], this);
        }
        [values, slopes]
    }
}

impl<const N: usize> Default for Chebyshev<N> {
    fn default() -> Self {
        Self::new()
    }
}
