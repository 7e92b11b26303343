//! Coordinates in which the oscillators of a system do not feel each other.

use super::blocks::Blocks;
use nalgebra::{DMatrix, Schur};

/// The fast part L of a system's linear motion in coordinates of its own.
///
/// Of N states the first SLOW are slow, the FAST after them fast, and what is left slow again. L is the
/// Jacobian as the fast ones move it: how they move each other, and how they move the slow ones. In the
/// coordinates, of which the fast ones come first, it is made of 2 x 2 blocks.
#[derive(Debug, Clone)]
pub struct Decoupling<const N: usize, const SLOW: usize, const FAST: usize> {
    /// Change of all states for one of each fast coordinate.
    out: [[f64; N]; FAST],
    /// Change of all coordinates for one of each fast state.
    into: [[f64; N]; FAST],
    /// L in the coordinates.
    pub blocks: Blocks<N>,
}

/// Largest product of the largest entries of a change and of its inverse, in typical sizes: beyond it
/// rounding would cost the tolerance its digits.
const WORST: f64 = 1e4;
/// An eigenvalue is missed by this share of its square, so that inverse iteration meets no singular
/// matrix.
const MISS: f64 = 1e-10;
/// Each iteration gains the digits of [`MISS`].
const ITERATIONS: usize = 2;
/// Of the QR algorithm: a few for each eigenvalue, without end for some that are multiple.
const SWEEPS: usize = 500;

impl<const N: usize, const SLOW: usize, const FAST: usize> Decoupling<N, SLOW, FAST> {
    /// Of a system's Jacobian, of N states or fewer, about typical sizes of the states. Where no
    /// coordinates decouple it well, each pair of states counts as an oscillator by itself.
    pub fn new(jacobian: &DMatrix<f64>, nominal: &[f64; N]) -> Self {
        const { assert!(N.is_multiple_of(2) && FAST.is_multiple_of(2), "states come in pairs") }
        const { assert!(SLOW + FAST <= N, "fast states are states") }
        let all = jacobian.nrows();
        let scaled = DMatrix::from_fn(all, all, |i, j| jacobian[(i, j)] * nominal[j] / nominal[i]);
        Self::decoupled(&scaled, nominal).unwrap_or_else(|| {
            let fast = jacobian.view_range(SLOW.., SLOW..).into_owned();
            let same = |i, j| f64::from(i == j);
            Self {
                out: columns(|i, j| same(i, SLOW + j)),
                into: columns(same),
                blocks: blocks(&fast),
            }
        })
    }

    fn decoupled(scaled: &DMatrix<f64>, nominal: &[f64; N]) -> Option<Self> {
        let fast = scaled.view_range(SLOW.., SLOW..).into_owned();
        let driven = scaled.view_range(..SLOW, SLOW..).into_owned();
        let (shapes, own) = shapes(&fast)?;
        let inverse = shapes.clone().try_inverse()?;
        let well = shapes.amax() * inverse.amax() < WORST;
        // The slow states move by L_sf x_f, which is how L_sf L_ff^-1 x_f moves: without that they rest.
        let carried = product(&driven, &fast.try_inverse()?);
        let out = stacked(&product(&carried, &shapes), &shapes);
        let into = stacked(&-carried, &inverse);
        // A fast coordinate is in typical sizes of the states, a slow one in the units of its state.
        let unit = |i: usize| if i < SLOW { nominal[i] } else { 1.0 };
        well.then(|| Self {
            out: columns(|i, j| entry(&out, i, j) * nominal[i]),
            into: columns(|i, j| {
                let i = Self::state(i);
                entry(&into, i, j) * unit(i) / nominal[SLOW + j]
            }),
            blocks: blocks(&own),
        })
    }

    /// The state in whose place a coordinate is: the fast ones come first.
    const fn state(coordinate: usize) -> usize {
        (coordinate + SLOW) % N
    }

    /// A change of the states, from one of the coordinates.
    #[inline(always)]
    pub fn to_states(&self, coordinates: &[f64; N]) -> [f64; N] {
        let mut slow = [0.0; N];
        for i in FAST..N {
            slow[Self::state(i)] = coordinates[i];
        }
        plus_columns(slow, &self.out, coordinates)
    }

    /// A change of the coordinates, from one of the states.
    #[inline(always)]
    pub fn to_coordinates(&self, states: &[f64; N]) -> [f64; N] {
        let slow = std::array::from_fn(|i| if i < FAST { 0.0 } else { states[Self::state(i)] });
        plus_columns(slow, &self.into, &states[SLOW..])
    }
}

fn columns<const N: usize, const FAST: usize>(
    entry: impl Fn(usize, usize) -> f64,
) -> [[f64; N]; FAST] {
    std::array::from_fn(|j| std::array::from_fn(|i| entry(i, j)))
}

/// The blocks of a matrix of the first coordinates; the others are not moved.
fn blocks<const N: usize>(matrix: &DMatrix<f64>) -> Blocks<N> {
    Blocks::of(|i, j| entry(matrix, i, j))
}

/// An entry of a matrix, zero for a state that is not in use.
fn entry(matrix: &DMatrix<f64>, i: usize, j: usize) -> f64 {
    matrix.get((i, j)).map_or(0.0, |entry| *entry)
}

/// Adds a multiple of each column.
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

/// Not nalgebra's product, whose rounding depends on the processor.
fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(a.nrows(), b.ncols(), |i, j| {
        (0..b.nrows()).map(|k| a[(i, k)] * b[(k, j)]).sum()
    })
}

/// In columns, two states that keep to themselves for each pair of eigenvalues; and the matrix of the
/// 2 x 2 blocks that move them.
///
/// A pair with sum s and product p spans the null space of A^2 - s A + p. With v in it and
/// w = A v / r, for any r: A v = r w and A w = s w - p/r v.
fn shapes(a: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let n = a.nrows();
    let square = product(a, a);
    let (mut shapes, mut blocks) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    for (pair, [s, p]) in pairs(a)?.into_iter().enumerate() {
        let near = &square - a * s + DMatrix::identity(n, n) * (p + MISS * p.abs());
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

/// Sum and product of the eigenvalues, two by two: those that are conjugate, and real ones.
fn pairs(a: &DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    let values = Schur::try_new(a.clone(), f64::EPSILON, SWEEPS)?.complex_eigenvalues();
    let complex = values.iter().filter(|value| value.im > 0.0);
    let mut pairs: Vec<_> =
        complex.map(|value| [2.0 * value.re, value.re * value.re + value.im * value.im]).collect();
    let mut real: Vec<_> = values.iter().filter(|value| value.im == 0.0).map(|v| v.re).collect();
    real.sort_by(f64::total_cmp);
    pairs.extend(real.chunks_exact(2).map(|two| [two[0] + two[1], two[0] * two[1]]));
    pairs.sort_by(|a, b| a[1].total_cmp(&b[1]));
    Some(pairs)
}
