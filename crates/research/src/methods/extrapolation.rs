//! Extrapolation of the explicit midpoint rule (Gragg, Bulirsch, Stoer): any order, and no coefficients that would have
//! to be known to more digits for a reference flight.
//!
//! ```text
//! y_1 = x + s f(x),  y_(m+1) = y_(m-1) + 2 s f(y_m),  s = h/n,   T_j1 = y_n for n = n_j = 2 j
//! T_(j,k+1) = T_jk + (T_jk - T_(j-1,k)) / ((n_j/n_(j-k))^2 - 1)
//! ```
//!
//! (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., 1993, section II.9, eqs (9.10),
//! (9.13), without the smoothing step.) T_kk has order 2 k and takes k^2 + 1 right-hand sides.

use ahv::solve::{Attempt, Method, Scalar, System, Trial, step_factor};
use std::array::from_fn;

/// Columns of the table.
pub struct Extrapolation<const COLUMNS: usize>;

/// The last two diagonal entries of a table with some columns, for a step of length `h` (s).
pub fn extrapolate<S: Scalar, const N: usize, const COLUMNS: usize>(
    f: impl Fn(&[S; N]) -> [S; N],
    x: &[S; N],
    slope: &[S; N],
    h: S,
) -> [[S; N]; 2] {
    let mut row = [[S::default(); N]; COLUMNS];
    let mut ends = [*x; 2];
    for j in 0..COLUMNS {
        let n = 2 * (j + 1);
        let step = h / S::constant(n as f64);
        let (mut before, mut y) = (*x, from_fn(|i| x[i] + step * slope[i]));
        for _ in 1..n {
            let rates = f(&y);
            (before, y) = (y, from_fn(|i| before[i] + step * rates[i] * 2.0));
        }
        for (k, entry) in row.iter_mut().enumerate().take(j + 1) {
            let upper = std::mem::replace(entry, y);
            if k < j {
                let squared = |n: usize| S::constant((n * n) as f64);
                let ratio = squared(n) / squared(2 * (j - k)) - 1.0;
                y = from_fn(|i| y[i] + (y[i] - upper[i]) / ratio);
            }
        }
        ends = [ends[1], row[j]];
    }
    ends
}

impl<const N: usize, const COLUMNS: usize> Method<N> for Extrapolation<COLUMNS> {
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        let &Attempt { x, slope, t, h, .. } = attempt;
        // The vehicle's controls do not move within a step.
        let f = |y: &[f64; N]| attempt.rates(t, y);
        let [lower, next] = extrapolate::<f64, N, COLUMNS>(f, x, slope, h);
        let error = attempt.error(&next, &from_fn(|i| (next[i] - lower[i]) / h));
        let factor = step_factor(error, 2 * COLUMNS as i32 - 1);
        Trial { next, slope: None, error, factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verif_a_table_with_four_columns_has_order_eight() {
        let error = |h: f64| {
            let [_, next] = extrapolate::<f64, 1, 4>(|y| [y[0]], &[1.0], &[1.0], h);
            (next[0] - libm::exp(h)).abs()
        };
        let order = libm::log2(error(1.0) / error(0.5));
        assert!((8.5..9.5).contains(&order), "a step's error falls with the power {order}");
    }
}
