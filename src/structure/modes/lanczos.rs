//! The slowest modes by a band Lanczos iteration on the flexibility.
//!
//! With K^+ the exact statics of [`Beam::deflect`], the operator `A = K^+ M` on motions without
//! momentum is symmetric in the product `x^T M y`, and its largest eigenvalues are the flexibilities
//! `1/omega^2` of the slowest modes. No matrix is factored and nothing is shifted. The two
//! rigid-body modes are the first two vectors of the basis: orthogonalisation against the basis
//! is the projection on the flexible motions.
//!
//! **No mode is missed.** The iteration starts with the answers to a force on the nose and to one
//! on each sloshing mass. A mode phi enters them with `phi(nose)` and `phi(mass j)`, over omega^2.
//! Were all of these 0, the springs would be slack (`k_j (phi_j - w_j) = omega^2 m_j phi_j = 0`),
//! phi a mode of the bare beam, and a bare free-free beam moves at its ends in every mode. By the
//! same argument a multiple eigenvalue has at most as many modes as there are starting vectors,
//! and they enter independently. So the Krylov space contains every mode, equal frequencies
//! included, and the residuals, together with the guard mode, tell when it is large enough.

use super::jacobi;
use crate::error::Error;
use crate::structure::beam::{Beam, Oscillator};
use multiversion::multiversion;

/// Heave and pitch.
const RIGID: usize = 2;
/// Vectors for each mode before the first look at the small eigenproblem: fewer seldom suffice.
const FIRST_LOOK: usize = 4;
/// Steps between later looks.
const STRIDE: usize = 3;
/// Vectors at which the search is given up; 24 are usual.
const LARGEST_BASIS: usize = 240;
/// Residual over eigenvalue at which a mode counts as found. The error of omega goes with its
/// square, that of the shape with itself over the relative gap: both below rounding.
const RESIDUAL: f64 = 1e-13;
/// The first mode beyond those asked for need only be told apart.
const GUARD_RESIDUAL: f64 = 1e-3;
/// A vector of which orthogonalisation leaves less than this, relative, adds nothing.
const NOTHING_LEFT: f64 = 1e-14;

/// Beam with sloshing masses: vectors hold the beam's displacement, then that of each mass.
pub(super) struct Structure<'a> {
    pub beam: &'a Beam,
    pub oscillators: &'a [Oscillator],
}

/// A mode with `phi^T M phi = 1`.
pub(super) struct EigenPair {
    /// 1/omega^2, s^2.
    pub flexibility: f64,
    pub displacement: Vec<f64>,
}

impl Structure<'_> {
    fn unknowns(&self) -> usize {
        self.beam.unknowns() + self.oscillators.len()
    }

    pub(super) fn mass_times(&self, displacement: &[f64]) -> Vec<f64> {
        let beam = self.beam.unknowns();
        let mut product = vec![0.0; self.unknowns()];
        self.beam.mass_times(&displacement[..beam], &mut product[..beam]);
        for (j, oscillator) in self.oscillators.iter().enumerate() {
            product[beam + j] = oscillator.mass * displacement[beam + j];
        }
        product
    }

    /// Statics: a force on a sloshing mass reaches the beam through its spring.
    fn deflect(&self, mut load: Vec<f64>) -> Vec<f64> {
        let beam = self.beam.unknowns();
        for (j, oscillator) in self.oscillators.iter().enumerate() {
            load[2 * oscillator.node] += load[beam + j];
        }
        let mut displacement = vec![0.0; self.unknowns()];
        self.beam.deflect(&load[..beam], &mut displacement[..beam]);
        for (j, oscillator) in self.oscillators.iter().enumerate() {
            displacement[beam + j] =
                displacement[2 * oscillator.node] + load[beam + j] / oscillator.stiffness;
        }
        displacement
    }

    /// Unit heave, and unit pitch about the middle.
    fn rigid_modes(&self) -> [Vec<f64>; RIGID] {
        let middle = 0.5 * self.beam.length_m();
        let arm = |node: usize| self.beam.station(node) - middle;
        let nodes = 0..=self.beam.elements();
        let masses = self.oscillators.iter();
        [
            nodes.clone().flat_map(|_| [1.0, 0.0]).chain(masses.clone().map(|_| 1.0)).collect(),
            nodes.flat_map(|i| [arm(i), 1.0]).chain(masses.map(|o| arm(o.node))).collect(),
        ]
    }
}

/// An M-orthonormal basis, heave and pitch first.
struct Basis<'a> {
    structure: &'a Structure<'a>,
    vectors: Vec<Vec<f64>>,
    /// M times each vector: a vector's momenta, or the load of its inertia forces.
    products: Vec<Vec<f64>>,
}

impl<'a> Basis<'a> {
    fn new(structure: &'a Structure<'a>) -> Self {
        let mut basis = Self { structure, vectors: Vec::new(), products: Vec::new() };
        for mode in structure.rigid_modes() {
            basis.push(mode);
        }
        basis
    }

    /// Adds what is new in a vector; returns its components along the basis, the new one last.
    fn push(&mut self, mut vector: Vec<f64>) -> Vec<f64> {
        let mut components = vec![0.0; self.vectors.len()];
        // Twice is enough (Parlett, The Symmetric Eigenvalue Problem, section 6.9).
        for _ in 0..2 {
            let along: Vec<f64> = self.products.iter().map(|p| dot(p, &vector)).collect();
            for ((total, along), basis) in components.iter_mut().zip(along).zip(&self.vectors) {
                *total += along;
                add_scaled(&mut vector, -along, basis);
            }
        }
        let mut product = self.structure.mass_times(&vector);
        let norm = dot(&vector, &product).sqrt();
        let before = dot(&components, &components).sqrt() + norm;
        if norm > NOTHING_LEFT * before {
            scale(&mut vector, 1.0 / norm);
            scale(&mut product, 1.0 / norm);
            self.vectors.push(vector);
            self.products.push(product);
            components.push(norm);
        }
        components
    }

    /// Statics under a load, after the rigid-body motion that it causes has been taken out of it.
    fn answer(&self, mut load: Vec<f64>) -> Vec<f64> {
        for (mode, product) in self.vectors.iter().zip(&self.products).take(RIGID) {
            let momentum = dot(mode, &load);
            add_scaled(&mut load, -momentum, product);
        }
        self.structure.deflect(load)
    }

    /// A times a vector of the basis.
    fn flex(&self, index: usize) -> Vec<f64> {
        self.structure.deflect(self.products[index].clone())
    }

    /// Linear combination of the vectors behind the rigid-body modes.
    fn combine(&self, weights: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.structure.unknowns()];
        for (weight, vector) in weights.iter().zip(&self.vectors[RIGID..]) {
            add_scaled(&mut sum, *weight, vector);
        }
        sum
    }
}

/// The `count` slowest modes, slowest first.
pub(super) fn lowest_modes(structure: &Structure, count: usize) -> Result<Vec<EigenPair>, Error> {
    let mut basis = Basis::new(structure);
    let masses = structure.beam.unknowns()..structure.unknowns();
    for place in std::iter::once(0).chain(masses) {
        let mut load = vec![0.0; structure.unknowns()];
        load[place] = 1.0;
        let answer = basis.answer(load);
        basis.push(answer);
    }

    let mut columns: Vec<Vec<f64>> = Vec::new();
    loop {
        let exhausted = basis.vectors.len() <= RIGID + columns.len();
        if exhausted
            || (columns.len() >= FIRST_LOOK * count && columns.len().is_multiple_of(STRIDE))
        {
            let ritz = jacobi::eigen(leading_block(&columns));
            let found = |i: usize, tolerance: f64| {
                let (flexibility, weights) = &ritz[i];
                remainder(&columns, weights) <= tolerance * flexibility
            };
            if exhausted && ritz.len() < count || columns.len() > LARGEST_BASIS {
                let found = (0..count.min(ritz.len())).filter(|&i| found(i, RESIDUAL)).count();
                return Err(Error::Modes { count, found });
            }
            if exhausted || (0..count).all(|i| found(i, RESIDUAL)) && found(count, GUARD_RESIDUAL) {
                let guess = ritz[..count].iter().map(|(_, weights)| basis.combine(weights));
                return Ok(polish(structure, guess));
            }
        }
        let image = basis.flex(RIGID + columns.len());
        columns.push(basis.push(image).split_off(RIGID));
    }
}

/// A in the vectors that it has been applied to. Column j of `columns` holds the components of A
/// times vector j; the later of two symmetric entries is always there.
fn leading_block(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = columns.len();
    (0..n).map(|i| (0..n).map(|j| columns[i.max(j)][i.min(j)]).collect()).collect()
}

/// Norm of the part of A x outside the vectors that A has been applied to: what `A x - x/omega^2`
/// amounts to for a Ritz vector x with these `weights`.
fn remainder(columns: &[Vec<f64>], weights: &[f64]) -> f64 {
    let n = columns.len();
    let outside = n..columns[n - 1].len();
    let square: f64 = outside
        .map(|row| {
            let entry = |(column, weight): (&Vec<f64>, &f64)| {
                column.get(row).map_or(0.0, |component| component * weight)
            };
            let sum: f64 = columns.iter().zip(weights).map(entry).sum();
            sum * sum
        })
        .sum();
    square.sqrt()
}

/// One Rayleigh-Ritz step in the modes themselves. There A is graded and almost diagonal, so that
/// a fast mode beside a slow one comes out to its own last digits, not to those of the slow one.
fn polish(structure: &Structure, slowest_first: impl Iterator<Item = Vec<f64>>) -> Vec<EigenPair> {
    let mut basis = Basis::new(structure);
    for vector in slowest_first {
        basis.push(vector);
    }
    let count = basis.vectors.len() - RIGID;
    let columns: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            let image = basis.flex(RIGID + i);
            basis.products[RIGID..].iter().map(|product| dot(product, &image)).collect()
        })
        .collect();
    jacobi::eigen(leading_block(&columns))
        .into_iter()
        .map(|(flexibility, weights)| EigenPair {
            flexibility,
            displacement: basis.combine(&weights),
        })
        .collect()
}

/// In eight running sums: quicker, more accurate, and the same on every platform, in registers of any
/// width.
#[multiversion(targets("x86_64+avx"))]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, a_rest) = a.as_chunks::<8>();
    let (b, b_rest) = b.as_chunks::<8>();
    for (a, b) in a.iter().zip(b) {
        for ((sum, x), y) in sums.iter_mut().zip(a).zip(b) {
            *sum += x * y;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}

#[multiversion(targets("x86_64+avx"))]
fn add_scaled(target: &mut [f64], factor: f64, vector: &[f64]) {
    for (x, y) in target.iter_mut().zip(vector) {
        *x += factor * y;
    }
}

fn scale(vector: &mut [f64], factor: f64) {
    for x in vector {
        *x *= factor;
    }
}
