//! The same motions in another basis.

use super::{FLEXIBLE, MODES, Modes, SLOSH, lanczos};
use crate::error::Error;
use crate::structure::beam::{Beam, Oscillator};
use crate::structure::shape::Shape;
use nalgebra::SMatrix;

type Matrix = SMatrix<f64, MODES, MODES>;

/// Newton's iteration for the nearest rotation converges in about eight steps; the rest guards
/// against cycling at rounding level.
const MAX_STEPS: usize = 40;
/// Change of an entry that counts as none.
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

    /// `phi_i^T M v_k / mu_i` of the shapes phi and of any displacements v.
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
                products[i][k] = lanczos::dot(&load, displacement) / self.modal_mass[i];
            }
        }
        products
    }

    /// These motions in the basis nearest to the modes of a reference, the same vehicle under another
    /// load, in the product of the mass matrix: the orthogonal Procrustes problem (Golub and Van Loan,
    /// Matrix Computations, 4th ed., section 6.4.1). As liquid moves the beam in proportion to its
    /// mass, so the reference's slosh modes do. The scaling is that of [`Modes`]; a slosh mode keeps
    /// the tank whose displacement it counts.
    ///
    /// # Errors
    /// [`Error::ModesNotFollowed`] if the motions have a part that no reference has.
    pub fn aligned_to(
        &self,
        beam: &Beam,
        oscillators: &[Oscillator],
        reference: (&Self, &[Oscillator]),
    ) -> Result<Self, Error> {
        let count = self.count;
        let (reference, others) = reference;
        let [own, other] = [oscillators, others].map(|o| o.iter().map(|o| o.mass).sum::<f64>());
        // Without liquid both are zero.
        let ratio = own / other.max(f64::MIN_POSITIVE);
        let mut wanted = reference.clone();
        for shape in wanted.shape.iter_mut().skip(FLEXIBLE) {
            shape.w.iter_mut().chain(&mut shape.slope).for_each(|part| *part *= ratio);
        }
        let wanted = wanted.displacements(oscillators);
        let products = self.products(beam, oscillators, &wanted);
        let structure = lanczos::Structure { beam, oscillators };
        let mut overlap = Matrix::identity();
        for (k, wanted) in wanted.iter().enumerate() {
            let norm = lanczos::dot(wanted, &structure.mass_times(wanted)).sqrt();
            for i in 0..count {
                overlap[(i, k)] = products[i][k] * self.modal_mass[i].sqrt() / norm;
            }
        }
        let mut rotation = nearest_rotation(overlap).ok_or(Error::ModesNotFollowed)?;

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
                sum(&|i| self.slosh_displacement[counted_tank(reference, k)][i])
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

/// The tank whose displacement is 1 in a slosh mode.
fn counted_tank(modes: &Modes, mode: usize) -> usize {
    let [fore, aft] = modes.slosh_displacement.map(|relative| relative[mode].abs());
    usize::from(aft > fore)
}

/// The orthogonal polar factor, by Newton's iteration (Higham, Functions of Matrices, section 8.3);
/// none of a singular matrix.
fn nearest_rotation(mut matrix: Matrix) -> Option<Matrix> {
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
