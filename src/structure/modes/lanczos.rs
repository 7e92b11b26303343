//! The lowest modes of `K phi = omega^2 M phi` by a band Lanczos iteration on the inverse problem
//!
//! ```text
//! A phi = phi / omega^2,   A = K^+ M
//! ```
//!
//! on displacements M-orthogonal to heave and pitch, where K^+ is the static solution of
//! [`Beam::deflect`]. A is symmetric in the inner product x^T M y. K is singular on rigid-body motion
//! only, so no shift is needed, and no matrix is factored.
//!
//! # Iteration
//!
//! Starting vectors: the static responses to a unit force on the nose and on each sloshing mass, 1 or 3,
//! which is the bandwidth p. Step j computes A v_j, M-orthogonalises it against heave, pitch and all v_i
//! (full reorthogonalisation, Gram-Schmidt twice) and appends the normalised rest as v_(j+p). A vector
//! whose rest is below 1e-14 is dropped (deflation), which lowers p. The components of A v_j are column j
//! of the projected matrix T_n = V_n^T M A V_n, a band matrix of half-width p.
//!
//! # Stopping
//!
//! A Ritz pair T_n s = theta s, x = V_n s has the residual `A x - theta x = R s`, R the part of A V_n
//! outside V_n. With its M-norm rho and the distance `gap` of theta to the other eigenvalues of A,
//!
//! ```text
//! |theta - 1/omega^2| <= min(rho, rho^2/gap),   sin(angle between x and phi) <= rho/gap
//! ```
//!
//! The iteration ends when rho <= 1e-13 theta for all wanted modes and rho <= 1e-3 theta for the next
//! one, the guard, or when all p starting vectors are exhausted. One Rayleigh-Ritz step in the Ritz
//! vectors follows. Where shapes to nine digits suffice ([`nearly_lowest_modes`]), rho <= 1e-9 theta does,
//! without that step: frequencies have an error of second order in rho.
//!
//! # No mode is missed
//!
//! A mode phi contributes phi(nose) / omega^2 and phi(mass j) / omega^2 to the starting vectors. If all
//! of these were 0, the springs would be slack (`k_j (phi_j - w_j) = omega^2 m_j phi_j = 0`) and phi a
//! mode of the bare beam with a node at its free end, which does not exist. For the same reason a
//! multiple eigenvalue has at most p modes, and they are independent in the starting vectors. So the
//! Krylov space contains every mode.
//!
//! Sources: A. Ruhe, Implementation aspects of band Lanczos algorithms, Math. Comp. 33(146), 1979,
//! 680-687; B. N. Parlett, The Symmetric Eigenvalue Problem, 1980, sections 6.9 (Gram-Schmidt twice) and
//! 11.7 (residual bounds). Tests: `verif_frequencies_are_right_and_none_is_missed` (Sylvester's law of
//! inertia, 32 digits), `verif_shapes_are_those_of_inverse_iteration_in_double_double`.

use super::jacobi;
use super::vectors::{add_all, dot, dots, scale};
use crate::error::Error;
use crate::structure::beam::{Beam, Oscillator};

/// Number of rigid-body modes: heave and pitch.
const RIGID_BODY_MODES: usize = 2;
/// Steps between computations of the Ritz values.
const CHECK_INTERVAL: usize = 3;
/// Limit of the basis; 24 vectors are usual.
const MAX_BASIS: usize = 240;
/// rho/theta at which a mode has converged.
const RESIDUAL: f64 = 1e-13;
/// The same where shapes to nine digits suffice.
const COARSE_RESIDUAL: f64 = 1e-9;
/// rho/theta at which the guard mode has converged: it only needs to be separated.
const GUARD_RESIDUAL: f64 = 1e-3;
/// Relative norm after orthogonalisation below which a vector is dropped.
const DEFLATION: f64 = 1e-14;

/// Beam with sloshing masses. Vectors hold the beam's displacement, then that of each mass.
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

    /// K^+ load. A force on a sloshing mass acts on the beam through the spring.
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

    /// Unit heave, and unit rotation about mid-length.
    fn rigid_modes(&self) -> [Vec<f64>; RIGID_BODY_MODES] {
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
    /// M times each vector.
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

    /// Orthonormalises a vector and appends it; returns its components along the basis, the new one last.
    fn push(&mut self, mut vector: Vec<f64>) -> Vec<f64> {
        let mut components = vec![0.0; self.vectors.len()];
        // Parlett, section 6.9: twice is enough.
        for _ in 0..2 {
            let mut along = dots(&self.products, &vector);
            for (total, along) in components.iter_mut().zip(&mut along) {
                *total += *along;
                *along = -*along;
            }
            add_all(&mut vector, &along, &self.vectors);
        }
        let mut product = self.structure.mass_times(&vector);
        let norm = dot(&vector, &product).sqrt();
        let before = dot(&components, &components).sqrt() + norm;
        if norm > DEFLATION * before {
            scale(&mut vector, 1.0 / norm);
            scale(&mut product, 1.0 / norm);
            self.vectors.push(vector);
            self.products.push(product);
            components.push(norm);
        }
        components
    }

    /// K^+ load, with the load made self-equilibrated by the inertia forces of its rigid-body acceleration.
    fn static_response(&self, mut load: Vec<f64>) -> Vec<f64> {
        for (mode, product) in self.vectors.iter().zip(&self.products).take(RIGID_BODY_MODES) {
            let momentum = dot(mode, &load);
            add_all(&mut load, &[-momentum], std::slice::from_ref(product));
        }
        self.structure.deflect(load)
    }

    /// A times a vector of the basis.
    fn apply(&self, index: usize) -> Vec<f64> {
        self.structure.deflect(self.products[index].clone())
    }

    /// Linear combination of the vectors after the rigid-body modes.
    fn combine(&self, weights: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.structure.unknowns()];
        let vectors = &self.vectors[RIGID_BODY_MODES..][..weights.len()];
        add_all(&mut sum, weights, vectors);
        sum
    }

    /// From eigenvalues and eigenvectors of the projected matrix.
    fn pairs(&self, eigen: Vec<(f64, Vec<f64>)>) -> Vec<EigenPair> {
        let pair = |(flexibility, weights): (f64, Vec<f64>)| EigenPair {
            flexibility,
            displacement: self.combine(&weights),
        };
        eigen.into_iter().map(pair).collect()
    }
}

/// The `count` lowest modes, lowest first.
pub(super) fn lowest_modes(structure: &Structure, count: usize) -> Result<Vec<EigenPair>, Error> {
    let first_check = (4 * count).next_multiple_of(CHECK_INTERVAL);
    let ritz = ritz_pairs(structure, count, first_check, RESIDUAL)?;
    Ok(rayleigh_ritz(structure, ritz.into_iter().map(|pair| pair.displacement)))
}

/// The same, with shapes to nine digits, in two thirds of the time.
pub(super) fn nearly_lowest_modes(
    structure: &Structure,
    count: usize,
) -> Result<Vec<EigenPair>, Error> {
    ritz_pairs(structure, count, 3 * count + 2, COARSE_RESIDUAL)
}

/// The iteration. `first_check` is the number of steps before the Ritz values are computed first.
fn ritz_pairs(
    structure: &Structure,
    count: usize,
    first_check: usize,
    residual: f64,
) -> Result<Vec<EigenPair>, Error> {
    let mut basis = Basis::new(structure);
    let masses = structure.beam.unknowns()..structure.unknowns();
    for entry in std::iter::once(0).chain(masses) {
        let mut load = vec![0.0; structure.unknowns()];
        load[entry] = 1.0;
        let response = basis.static_response(load);
        basis.push(response);
    }

    let mut columns: Vec<Vec<f64>> = Vec::new();
    loop {
        let exhausted = basis.vectors.len() <= RIGID_BODY_MODES + columns.len();
        let check = columns.len() >= first_check
            && (columns.len() - first_check).is_multiple_of(CHECK_INTERVAL);
        if exhausted || check {
            let mut ritz = jacobi::eigen(projected_matrix(&columns));
            let converged = |i: usize, tolerance: f64| {
                let (flexibility, weights) = &ritz[i];
                residual_norm(&columns, weights) <= tolerance * flexibility
            };
            if exhausted && ritz.len() < count || columns.len() > MAX_BASIS {
                let found = (0..count.min(ritz.len())).filter(|&i| converged(i, residual)).count();
                return Err(Error::Modes { count, found });
            }
            if exhausted
                || (0..count).all(|i| converged(i, residual)) && converged(count, GUARD_RESIDUAL)
            {
                ritz.truncate(count);
                return Ok(basis.pairs(ritz));
            }
        }
        let image = basis.apply(RIGID_BODY_MODES + columns.len());
        columns.push(basis.push(image).split_off(RIGID_BODY_MODES));
    }
}

/// T_n, from the components of A v_j in column j: of two symmetric entries the one in the later column is
/// always known.
fn projected_matrix(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = columns.len();
    (0..n).map(|i| (0..n).map(|j| columns[i.max(j)][i.min(j)]).collect()).collect()
}

/// rho: the M-norm of R s for the Ritz vector with weights s.
fn residual_norm(columns: &[Vec<f64>], weights: &[f64]) -> f64 {
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

/// One Rayleigh-Ritz step in the converged modes, lowest first. Their projected matrix is graded and almost
/// diagonal, so Jacobi rotations give each eigenvalue to full relative accuracy.
fn rayleigh_ritz(structure: &Structure, modes: impl Iterator<Item = Vec<f64>>) -> Vec<EigenPair> {
    let mut basis = Basis::new(structure);
    for vector in modes {
        basis.push(vector);
    }
    let count = basis.vectors.len() - RIGID_BODY_MODES;
    let columns: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            let image = basis.apply(RIGID_BODY_MODES + i);
            basis.products[RIGID_BODY_MODES..].iter().map(|product| dot(product, &image)).collect()
        })
        .collect();
    basis.pairs(jacobi::eigen(projected_matrix(&columns)))
}
