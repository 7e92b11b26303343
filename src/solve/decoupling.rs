//! Block diagonalisation of the fast linear part of a system.
//!
//! Slow states x_s, fast states x_f. L keeps the columns of the Jacobian J that belong to fast states:
//!
//! ```text
//! L = [0  J_sf]     S^-1 J_ff S = B, 2 x 2 blocks     K = J_sf J_ff^-1
//!     [0  J_ff]
//!
//! x_f = S y_f             y_f = S^-1 x_f
//! x_s = y_s + K S y_f     y_s = x_s - K x_f
//! y_f' = B y_f,  y_s' = 0   for x' = L x
//! ```
//!
//! A pair of eigenvalues of J_ff with sum s and product p spans the null space of J_ff^2 - s J_ff + p. A
//! vector v in it is found by inverse iteration on that matrix, with p (1 + 1e-10) to keep it regular.
//! Then v and w = J_ff v / r, r = |J_ff v|_max, are two columns of S: J_ff v = r w and J_ff w = s w -
//! (p/r) v, so the block is [0, -p/r; r, s]. Eigenvalues come from the QR algorithm (nalgebra), conjugate
//! ones in pairs, real ones in pairs of neighbours.
//!
//! The transformation is refused if |S|_max |S^-1|_max exceeds 1e4; then each pair of fast states is its
//! own block of L, whose other entries are dropped. L affects efficiency only, as the method integrates
//! what L leaves out.
//!
//! Tests: `verif_the_coordinates_decouple_every_vehicle`,
//! `verif_a_jacobian_that_cannot_be_decoupled_still_gives_a_method`.

use super::blocks::Blocks;
use nalgebra::{DMatrix, Schur};

/// The linear part L and the coordinates y in which it is block diagonal.
///
/// Of N states the first SLOW and those after SLOW + FAST are slow. Coordinates hold y_f first, then y_s.
#[derive(Debug, Clone)]
pub struct Decoupling<const N: usize, const SLOW: usize, const FAST: usize> {
    /// Columns [K S; S] of the map from coordinates to states.
    from_fast: [[f64; N]; FAST],
    /// Columns [S^-1; -K] of the map from states to coordinates.
    to_fast: [[f64; N]; FAST],
    /// L in coordinates.
    pub blocks: Blocks<N>,
}

/// Largest |S|_max |S^-1|_max, with states scaled by their nominal values.
const MAX_CONDITION: f64 = 1e4;
/// Relative shift of p that keeps the matrix of the inverse iteration regular.
const SHIFT: f64 = 1e-10;
/// Steps of inverse iteration; each gains a factor of about [`SHIFT`].
const ITERATIONS: usize = 2;
/// Iteration limit for QR, which may not converge for repeated eigenvalues.
const MAX_QR_ITERATIONS: usize = 500;

impl<const N: usize, const SLOW: usize, const FAST: usize> Decoupling<N, SLOW, FAST> {
    /// From a system's Jacobian, of N states or fewer, scaled by the nominal values of the states.
    pub fn new(jacobian: &DMatrix<f64>, nominal: &[f64; N]) -> Self {
        const { assert!(N.is_multiple_of(2) && FAST.is_multiple_of(2), "states come in pairs") }
        const { assert!(SLOW + FAST <= N, "fast states are states") }
        let all = jacobian.nrows();
        let scaled = DMatrix::from_fn(all, all, |i, j| jacobian[(i, j)] * nominal[j] / nominal[i]);
        Self::decoupled(&scaled, nominal).unwrap_or_else(|| {
            let fast = jacobian.view_range(SLOW.., SLOW..).into_owned();
            let same = |i, j| f64::from(i == j);
            Self {
                from_fast: columns(|i, j| same(i, SLOW + j)),
                to_fast: columns(same),
                blocks: blocks(&fast),
            }
        })
    }

    fn decoupled(scaled: &DMatrix<f64>, nominal: &[f64; N]) -> Option<Self> {
        let fast = scaled.view_range(SLOW.., SLOW..).into_owned();
        let driven = scaled.view_range(..SLOW, SLOW..).into_owned();
        let (shapes, block_matrix) = block_basis(&fast)?;
        let inverse = shapes.clone().try_inverse()?;
        let accepted = shapes.amax() * inverse.amax() < MAX_CONDITION;
        let k = product(&driven, &fast.try_inverse()?);
        let from_fast = stacked(&product(&k, &shapes), &shapes);
        let to_fast = stacked(&-k, &inverse);
        // Fast coordinates are scaled by the nominal values, slow ones have the unit of their state.
        let unit = |i: usize| if i < SLOW { nominal[i] } else { 1.0 };
        accepted.then(|| Self {
            from_fast: columns(|i, j| entry(&from_fast, i, j) * nominal[i]),
            to_fast: columns(|i, j| {
                let i = Self::state(i);
                entry(&to_fast, i, j) * unit(i) / nominal[SLOW + j]
            }),
            blocks: blocks(&block_matrix),
        })
    }

    /// Index of the state that corresponds to a coordinate.
    const fn state(coordinate: usize) -> usize {
        (coordinate + SLOW) % N
    }

    /// States from coordinates.
    #[inline(always)]
    pub fn to_states(&self, coordinates: &[f64; N]) -> [f64; N] {
        let mut slow = [0.0; N];
        for i in FAST..N {
            slow[Self::state(i)] = coordinates[i];
        }
        plus_columns(slow, &self.from_fast, coordinates)
    }

    /// Coordinates from states.
    #[inline(always)]
    pub fn to_coordinates(&self, states: &[f64; N]) -> [f64; N] {
        let slow = std::array::from_fn(|i| if i < FAST { 0.0 } else { states[Self::state(i)] });
        plus_columns(slow, &self.to_fast, &states[SLOW..])
    }
}

fn columns<const N: usize, const FAST: usize>(
    entry: impl Fn(usize, usize) -> f64,
) -> [[f64; N]; FAST] {
    std::array::from_fn(|j| std::array::from_fn(|i| entry(i, j)))
}

/// The blocks of a matrix that acts on the first coordinates; those of the others are zero.
fn blocks<const N: usize>(matrix: &DMatrix<f64>) -> Blocks<N> {
    Blocks::of(|i, j| entry(matrix, i, j))
}

/// An entry of a matrix, zero beyond its size.
fn entry(matrix: &DMatrix<f64>, i: usize, j: usize) -> f64 {
    matrix.get((i, j)).map_or(0.0, |entry| *entry)
}

/// sum + sum_j column_j multiple_j.
#[inline(always)]
fn plus_columns<const N: usize, const FAST: usize>(
    mut sum: [f64; N],
    columns: &[[f64; N]; FAST],
    multiples: &[f64],
) -> [f64; N] {
    for (column, x) in columns.iter().zip(&multiples[..FAST]) {
        for i in 0..N {
            sum[i] += column[i] * x;
        }
    }
    sum
}

fn stacked(top: &DMatrix<f64>, bottom: &DMatrix<f64>) -> DMatrix<f64> {
    let (slow, all) = (top.nrows(), top.nrows() + bottom.nrows());
    DMatrix::from_fn(
        all,
        top.ncols(),
        |i, j| {
            if i < slow { top[(i, j)] } else { bottom[(i - slow, j)] }
        },
    )
}

/// A product with a fixed order of summation: nalgebra's rounding depends on the processor.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(a.nrows(), b.ncols(), |i, j| {
        (0..b.nrows()).map(|k| a[(i, k)] * b[(k, j)]).sum()
    })
}

/// S and B of a matrix A = S B S^-1; none if the iteration fails.
fn block_basis(a: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let n = a.nrows();
    let square = product(a, a);
    let (mut shapes, mut blocks) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    for (pair, [s, p]) in eigenvalue_pairs(a)?.into_iter().enumerate() {
        let near = &square - a * s + DMatrix::identity(n, n) * (p + SHIFT * p.abs());
        let near = near.lu();
        let mut v = DMatrix::from_element(n, 1, 1.0);
        for _ in 0..ITERATIONS {
            v = near.solve(&v)?;
            v /= v.amax();
        }
        let w = product(a, &v);
        let r = w.amax();
        let [first, second] = [2 * pair, 2 * pair + 1];
        shapes.set_column(first, &v.column(0));
        shapes.set_column(second, &(w / r).column(0));
        blocks[(second, first)] = r;
        blocks[(first, second)] = -p / r;
        blocks[(second, second)] = s;
    }
    Some((shapes, blocks))
}

/// Sum and product of each pair of eigenvalues: conjugate ones, and real neighbours.
fn eigenvalue_pairs(a: &DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    let values = Schur::try_new(a.clone(), f64::EPSILON, MAX_QR_ITERATIONS)?.complex_eigenvalues();
    let complex = values.iter().filter(|value| value.im > 0.0);
    let mut pairs: Vec<_> =
        complex.map(|value| [2.0 * value.re, value.re * value.re + value.im * value.im]).collect();
    let mut real: Vec<_> = values.iter().filter(|value| value.im == 0.0).map(|v| v.re).collect();
    real.sort_by(f64::total_cmp);
    pairs.extend(real.chunks_exact(2).map(|two| [two[0] + two[1], two[0] * two[1]]));
    pairs.sort_by(|a, b| a[1].total_cmp(&b[1]));
    Some(pairs)
}
