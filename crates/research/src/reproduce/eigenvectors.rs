//! Eigenvectors by inverse iteration.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector};

/// Distance from the eigenvalue at which the matrix is factored, over the size of the balanced
/// matrix: small against the distance to the next eigenvalue, large against rounding.
const SHIFT: f64 = 1e-9;
/// Inverse iterations; each reduces other components by the ratio of the distances to their eigenvalues.
const STEPS: usize = 3;

/// The eigenvector of a known eigenvalue, by inverse iteration.
pub fn direction(matrix: &DMatrix<f64>, value: Complex<f64>) -> DVector<Complex<f64>> {
    // Entries differ by many orders of magnitude (m, rad), so the matrix is balanced.
    let mut balanced = matrix.clone();
    let scale = balance_parlett_reinsch(&mut balanced);
    let shift = value + SHIFT * balanced.norm();
    let n = matrix.nrows();
    let shifted = DMatrix::from_fn(n, n, |row, column| {
        let diagonal = if row == column { shift } else { Complex::ZERO };
        Complex::from(balanced[(row, column)]) - diagonal
    });
    let factors = shifted.lu();
    // A start vector that is hardly ever orthogonal to the eigenvector.
    let mut vector = DVector::from_fn(n, |row, _| Complex::new(1.0, 0.1 * (row + 1) as f64));
    for _ in 0..STEPS {
        if let Some(next) = factors.solve(&vector) {
            vector = next.unscale(next.norm());
        }
    }
    vector.zip_map(&scale, |entry, scale| entry * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_eigenvectors_in_bad_scales() {
        let matrix = DMatrix::from_row_slice(
            4,
            4,
            &[0., 2400., 0., 0., -1e-6, -0.1, 1e-3, 0., 0., 0., 0., 1., 0., 50., -400., -0.4],
        );
        for value in matrix.complex_eigenvalues().iter() {
            let vector = direction(&matrix, *value);
            let complex = matrix.map(Complex::from);
            let residual = &complex * &vector - &vector * *value;
            assert!(residual.norm() < 1e-8 * vector.norm() * complex.norm(), "{value}");
        }
    }
}
