//! The kept modes of one fuel level in the basis nearest to the modes of another level.
//!
//! With the own modes Phi (mu_i = phi_i^T M phi_i) and the reference modes V, the rotation Q minimises
//!
//! ```text
//! || V N^-1/2 - Phi mu^-1/2 Q ||_M   over Q^T Q = 1,   N_k = v_k^T M v_k
//! Q = orthogonal polar factor of O,   O_ik = phi_i^T M v_k / sqrt(mu_i N_k)
//! ```
//!
//! (orthogonal Procrustes problem: Golub, Van Loan, Matrix Computations, 4th ed., section 6.4.1).
//! Newton's iteration X <- (X + X^-T)/2 from X = O converges to it quadratically (Higham, Functions of
//! Matrices, 2008, section 8.3).

use super::vectors::dot;
use super::{FLEXIBLE, MODES, Modes, SLOSH, lanczos};
use crate::error::Error;
use crate::structure::beam::{Beam, Oscillator};
use crate::structure::shape::Shape;
use nalgebra::SMatrix;

type Matrix = SMatrix<f64, MODES, MODES>;

/// Limit of Newton's iteration; about eight steps are usual.
const MAX_STEPS: usize = 40;
/// Largest change of an entry at convergence.
const CONVERGED: f64 = 1e-15;

impl Modes {
    /// Displacement of the beam and of each sloshing mass, for each shape.
    pub fn displacements(&self, oscillators: &[Oscillator]) -> Vec<Vec<f64>> {
        let beam = |shape: &Shape| -> Vec<f64> {
            shape.w.iter().zip(&shape.slope).flat_map(|(w, slope)| [*w, *slope]).collect()
        };
        let shapes = self.shape.iter().enumerate();
        shapes
            .map(|(i, shape)| {
                let masses = oscillators.iter().zip(&self.slosh_displacement);
                let mut displacement = beam(shape);
                displacement.extend(masses.map(|(o, relative)| shape.w[o.node] + relative[i]));
                displacement
            })
            .collect()
    }

    /// `phi_i^T M v_k / mu_i` for the shapes phi and any displacements v.
    pub fn products(
        &self,
        beam: &Beam,
        oscillators: &[Oscillator],
        displacements: &[Vec<f64>],
    ) -> [[f64; MODES]; MODES] {
        let structure = lanczos::Structure { beam, oscillators };
        let mut products = [[0.0; MODES]; MODES];
        for (i, shape) in self.displacements(oscillators).iter().enumerate() {
            let load = structure.mass_times(shape);
            for (k, displacement) in displacements.iter().enumerate() {
                products[i][k] = dot(&load, displacement) / self.modal_mass[i];
            }
        }
        products
    }

    /// The modes in the basis nearest to those of a reference, the same vehicle at another fuel level.
    ///
    /// The beam's share of the reference's slosh modes is scaled by the mass of liquid. Shapes are
    /// normalised as in [`Modes`]; a slosh mode is normalised by the tank of the reference.
    ///
    /// # Errors
    /// [`Error::ModesNotFollowed`] if O is singular.
    pub fn aligned_to(
        &self,
        beam: &Beam,
        oscillators: &[Oscillator],
        reference: (&Self, &[Oscillator]),
    ) -> Result<Self, Error> {
        let count = self.count;
        let (reference, others) = reference;
        let [liquid, other] = [oscillators, others].map(|o| o.iter().map(|o| o.mass).sum::<f64>());
        // Both masses are zero without liquid.
        let ratio = liquid / other.max(f64::MIN_POSITIVE);
        let mut target = reference.clone();
        for shape in target.shape.iter_mut().skip(FLEXIBLE) {
            shape.w.iter_mut().chain(&mut shape.slope).for_each(|part| *part *= ratio);
        }
        let structure = lanczos::Structure { beam, oscillators };
        let own = self.displacements(oscillators);
        let mut overlap = Matrix::identity();
        for (k, target) in target.displacements(oscillators).iter().enumerate() {
            let load = structure.mass_times(target);
            let norm = dot(target, &load).sqrt();
            for (i, own) in own.iter().enumerate() {
                overlap[(i, k)] = dot(own, &load) / (self.modal_mass[i].sqrt() * norm);
            }
        }
        let mut rotation = polar_factor(overlap).ok_or(Error::ModesNotFollowed)?;

        let mut aligned = Self { shape: Vec::with_capacity(count), ..self.clone() };
        let per_root_mass: [f64; MODES] =
            std::array::from_fn(|i| 1.0 / self.modal_mass[i].max(f64::MIN_POSITIVE).sqrt());
        for k in 0..count {
            let sum = |value: &dyn Fn(usize) -> f64| -> f64 {
                (0..count).map(|i| value(i) * per_root_mass[i] * rotation[(i, k)]).sum()
            };
            let unit = if k < FLEXIBLE {
                sum(&|i| self.shape[i].w[0])
            } else {
                sum(&|i| self.slosh_displacement[normalising_tank(reference, k)][i])
            };
            let scaled = |value: &dyn Fn(usize) -> f64| sum(value) / unit;
            let nodes = 0..self.shape[k].w.len();
            aligned.shape.push(Shape {
                w: nodes.clone().map(|n| scaled(&|i| self.shape[i].w[n])).collect(),
                slope: nodes.map(|n| scaled(&|i| self.shape[i].slope[n])).collect(),
            });
            for tank in 0..SLOSH {
                aligned.slosh_displacement[tank][k] = scaled(&|i| self.slosh_displacement[tank][i]);
            }
            aligned.modal_mass[k] = 1.0 / (unit * unit);
            if unit < 0.0 {
                rotation.column_mut(k).neg_mut();
            }
        }
        aligned.rotation = std::array::from_fn(|i| std::array::from_fn(|k| rotation[(i, k)]));
        Ok(aligned)
    }
}

/// The tank whose displacement normalises a slosh mode.
fn normalising_tank(modes: &Modes, mode: usize) -> usize {
    let [fore, aft] = modes.slosh_displacement.map(|relative| relative[mode].abs());
    usize::from(aft > fore)
}

/// The orthogonal polar factor; none of a singular matrix.
fn polar_factor(mut matrix: Matrix) -> Option<Matrix> {
    for _ in 0..MAX_STEPS {
        let next = (matrix + matrix.try_inverse()?.transpose()) * 0.5;
        let change = (next - matrix).amax();
        matrix = next;
        if change < CONVERGED {
            break;
        }
    }
    Some(matrix)
}
