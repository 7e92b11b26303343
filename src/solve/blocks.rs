//! A matrix that couples the states in pairs, as an oscillator couples its coordinate with its rate,
//! and functions of it.

/// An N x N matrix L of 2 x 2 blocks. A state with an even number is paired with the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blocks<const N: usize> {
    /// Diagonal.
    own: [f64; N],
    /// In each row, the entry in the column of the paired state.
    cross: [f64; N],
    /// Sum of the eigenvalues of each state's block.
    sum: [f64; N],
    /// Their product.
    product: [f64; N],
    /// Largest magnitude of an eigenvalue.
    pub fastest: f64,
}

/// Each state's partner in its place.
#[inline(always)]
fn swapped<T: Copy, const N: usize>(x: &[T; N]) -> [T; N] {
    const { assert!(N.is_multiple_of(2), "states come in pairs") }
    std::array::from_fn(|i| x[i ^ 1])
}

impl<const N: usize> Blocks<N> {
    /// The blocks of a matrix, whose other entries are left out.
    pub fn of(matrix: impl Fn(usize, usize) -> f64) -> Self {
        let partners: [usize; N] = swapped(&std::array::from_fn(|i| i));
        let own = std::array::from_fn(|i| matrix(i, i));
        let cross = std::array::from_fn(|i| matrix(i, partners[i]));
        let [other, back] = [swapped(&own), swapped(&cross)];
        let sum: [f64; N] = std::array::from_fn(|i| own[i] + other[i]);
        let product: [f64; N] = std::array::from_fn(|i| own[i] * other[i] - cross[i] * back[i]);
        let largest = |(sum, product): (&f64, &f64)| {
            let half = 0.5 * sum.abs();
            let apart = half * half - product;
            if apart < 0.0 { libm::sqrt(*product) } else { half + libm::sqrt(apart) }
        };
        let fastest = sum.iter().zip(&product).map(largest).fold(0.0, f64::max);
        Self { own, cross, sum, product, fastest }
    }

    /// L x.
    #[inline(always)]
    pub fn times(&self, x: &[f64; N]) -> [f64; N] {
        let partner = swapped(x);
        let mut product = [0.0; N];
        for i in 0..N {
            product[i] = self.own[i] * x[i] + self.cross[i] * partner[i];
        }
        product
    }
}

/// A function of L: a 2 x 2 block meets its own characteristic equation (Cayley, Hamilton), so
/// whatever is made of it is a multiple of itself and of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatrixFunction<const N: usize> {
    /// Multiple of one, for each state's block.
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

/// Functions that [`phis`] gives.
pub const PHIS: usize = 4;
/// A term of a series below this does not count.
const NEGLIGIBLE: f64 = 1e-18;

/// phi_k(t L) for k = 1 to 4, where phi_k(z) = sum over n of z^n / (n + k)!; by their series, which
/// keep their digits while t L stays below about 4.
#[inline(always)]
pub fn phis<const N: usize>(blocks: &Blocks<N>, t: f64) -> [MatrixFunction<N>; PHIS] {
    let (sum, product) = (blocks.sum.map(|s| s * t), blocks.product.map(|p| p * t * t));
    // In multiples of one and z = t L: `factor` z f + `shift`.
    let climb = |f: &MatrixFunction<N>, factor: f64, shift: f64| MatrixFunction {
        identity: std::array::from_fn(|i| shift - factor * product[i] * f.linear[i]),
        linear: std::array::from_fn(|i| factor * (f.identity[i] + sum[i] * f.linear[i])),
    };
    let (size, mut term, mut last) = (t * blocks.fastest, 1.0, PHIS);
    while term > NEGLIGIBLE {
        last += 1;
        term *= size / last as f64;
    }
    // 4! phi_4 by Horner's rule, the others by phi_k = z phi_(k+1) + 1/k!.
    let mut fourth = MatrixFunction { identity: [1.0; N], linear: [0.0; N] };
    for n in (PHIS + 1..=last).rev() {
        fourth = climb(&fourth, 1.0 / n as f64, 1.0);
    }
    let third = climb(&fourth, 1.0 / 24.0, 1.0 / 6.0);
    let second = climb(&third, 1.0, 0.5);
    let first = climb(&second, 1.0, 1.0);
    [first, second, third, fourth.scaled(1.0 / 24.0)].map(|mut phi| {
        phi.linear = phi.linear.map(|multiple| multiple * t);
        phi
    })
}
