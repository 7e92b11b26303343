//! Block-diagonal matrices of 2 x 2 blocks, one per oscillator, and their phi functions.
//!
//! By Cayley and Hamilton a block with trace s and determinant p satisfies L^2 = s L - p, so any power series
//! of it is a 1 + b L. With z = t L, z^2 = s t z - p t^2 and the recurrence
//!
//! ```text
//! phi_k(z) = sum_n z^n / (n + k)!,   phi_k(z) = z phi_(k+1)(z) + 1/k!
//! z (a + b z) = -p t^2 b + (a + s t b) z
//! ```
//!
//! The phi_k of the largest k comes from its Taylor series by Horner's rule, the others from the recurrence (Hochbruck,
//! Ostermann, Exponential integrators, Acta Numerica 19, 2010, section 2.1). Test:
//! `verif_the_functions_are_those_of_the_exponential`.

/// An N x N matrix L of 2 x 2 blocks: rows and columns 2 i and 2 i + 1 form a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blocks<const N: usize> {
    diagonal: [f64; N],
    /// The other entry of each row.
    off_diagonal: [f64; N],
    /// Trace of each row's block.
    trace: [f64; N],
    /// Determinant of each row's block.
    determinant: [f64; N],
    /// Largest magnitude of an eigenvalue.
    pub spectral_radius: f64,
}

/// Exchanges the two entries of each pair.
#[inline(always)]
fn swapped<T: Copy, const N: usize>(x: &[T; N]) -> [T; N] {
    const { assert!(N.is_multiple_of(2), "states come in pairs") }
    std::array::from_fn(|i| x[i ^ 1])
}

impl<const N: usize> Blocks<N> {
    /// The diagonal blocks of a matrix; its other entries are ignored.
    pub fn of(matrix: impl Fn(usize, usize) -> f64) -> Self {
        let partners: [usize; N] = swapped(&std::array::from_fn(|i| i));
        let diagonal = std::array::from_fn(|i| matrix(i, i));
        let off_diagonal = std::array::from_fn(|i| matrix(i, partners[i]));
        let [other, back] = [swapped(&diagonal), swapped(&off_diagonal)];
        let trace: [f64; N] = std::array::from_fn(|i| diagonal[i] + other[i]);
        let determinant: [f64; N] =
            std::array::from_fn(|i| diagonal[i] * other[i] - off_diagonal[i] * back[i]);
        let largest = |(trace, determinant): (&f64, &f64)| {
            let half = 0.5 * trace.abs();
            let discriminant = half * half - determinant;
            if discriminant < 0.0 {
                libm::sqrt(*determinant)
            } else {
                half + libm::sqrt(discriminant)
            }
        };
        let spectral_radius = trace.iter().zip(&determinant).map(largest).fold(0.0, f64::max);
        Self { diagonal, off_diagonal, trace, determinant, spectral_radius }
    }

    /// L x.
    #[inline(always)]
    pub fn times(&self, x: &[f64; N]) -> [f64; N] {
        let partner = swapped(x);
        let mut product = [0.0; N];
        for i in 0..N {
            product[i] = self.diagonal[i] * x[i] + self.off_diagonal[i] * partner[i];
        }
        product
    }
}

/// A function of [`Blocks`]: in each block a multiple of the identity plus a multiple of L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatrixFunction<const N: usize> {
    /// Multiple of the identity, for each row's block.
    pub identity: [f64; N],
    /// Multiple of L.
    pub linear: [f64; N],
}

impl<const N: usize> MatrixFunction<N> {
    /// Zero.
    pub const ZERO: Self = Self { identity: [0.0; N], linear: [0.0; N] };

    /// `factor` times the function.
    #[inline(always)]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            identity: self.identity.map(|multiple| multiple * factor),
            linear: self.linear.map(|multiple| multiple * factor),
        }
    }

    /// Adds `factor` times another function.
    #[inline(always)]
    pub fn add(&mut self, factor: f64, other: &Self) {
        for i in 0..N {
            self.identity[i] += factor * other.identity[i];
            self.linear[i] += factor * other.linear[i];
        }
    }
}

/// Size below which a term of the Taylor series is dropped.
const NEGLIGIBLE: f64 = 1e-18;

/// phi_k(t L) for k = 1 to K. The Taylor series loses no digits to cancellation for t |L| below about 4.
#[inline(always)]
pub fn phis<const N: usize, const K: usize>(blocks: &Blocks<N>, t: f64) -> [MatrixFunction<N>; K] {
    let (trace, determinant) = (blocks.trace.map(|s| s * t), blocks.determinant.map(|p| p * t * t));
    // factor z f + shift, in multiples of 1 and z = t L.
    let climb = |f: &MatrixFunction<N>, factor: f64, shift: f64| MatrixFunction {
        identity: std::array::from_fn(|i| shift - factor * determinant[i] * f.linear[i]),
        linear: std::array::from_fn(|i| factor * (f.identity[i] + trace[i] * f.linear[i])),
    };
    let (size, mut term, mut last) = (t * blocks.spectral_radius, 1.0, K);
    while term > NEGLIGIBLE {
        last += 1;
        term *= size / last as f64;
    }
    // K! phi_K = 1 + z/(K+1) (1 + z/(K+2) (1 + ...)).
    let mut highest = MatrixFunction { identity: [1.0; N], linear: [0.0; N] };
    for n in (K + 1..=last).rev() {
        highest = climb(&highest, 1.0 / n as f64, 1.0);
    }
    let reciprocals = const { reciprocal_factorials::<K>() };
    let mut phis = [highest; K];
    for k in (1..K).rev() {
        let factor = if k + 1 == K { reciprocals[k] } else { 1.0 };
        phis[k - 1] = climb(&phis[k], factor, reciprocals[k - 1]);
    }
    phis[K - 1] = highest.scaled(reciprocals[K - 1]);
    phis.map(|mut phi| {
        phi.linear = phi.linear.map(|multiple| multiple * t);
        phi
    })
}

/// 1/k! for k = 1 to K.
const fn reciprocal_factorials<const K: usize>() -> [f64; K] {
    let (mut reciprocals, mut factorial, mut k) = ([1.0; K], 1.0, 1);
    while k <= K {
        factorial *= k as f64;
        reciprocals[k - 1] = 1.0 / factorial;
        k += 1;
    }
    reciprocals
}
