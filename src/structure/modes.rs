//! Eigenmodes of the beam with its sloshing masses: `K phi = omega^2 M phi`. Table 1 and Fig. 5 of
//! the paper.
//!
//! One eigenproblem for beam *and* sloshing masses: the liquid is part of the modes, and the equations of
//! motion need no slosh force. They contain the two rigid-body modes; every mode here is M-orthogonal to
//! these, so it has neither momentum nor angular momentum.

mod align;
mod jacobi;
mod lanczos;
mod vectors;

use super::beam::{Beam, Oscillator};
use super::shape::{Point, Shape};
use crate::error::Error;

/// Flexible modes kept.
pub const FLEXIBLE: usize = 3;
/// Slosh modes kept: one per tank.
pub const SLOSH: usize = 2;
/// All modes kept. Arrays over the modes hold the flexible ones first, then the slosh modes.
pub const MODES: usize = FLEXIBLE + SLOSH;

/// The lowest modes. Without sloshing masses the last [`SLOSH`] entries stay 0; for a rigid body,
/// [`Modes::default`], all do.
///
/// Normalisation: the nose deflection of a flexible mode is 1; in a slosh mode the larger of the two
/// displacements relative to the beam is 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Modes {
    /// Number of modes: 0, 3 or 5.
    pub count: usize,
    /// Angular frequencies, rad/s; ascending among the flexible and among the slosh modes.
    pub omega_rad_per_s: [f64; MODES],
    /// Modal masses `phi^T M phi`, kg/m.
    pub modal_mass: [f64; MODES],
    /// Displacement of sloshing mass j relative to its node in mode i, `[j][i]`.
    pub slosh_displacement: [[f64; MODES]; SLOSH],
    /// Share of a mode's strain energy that is in the beam, the rest being in the springs.
    pub beam_energy_share: [f64; MODES],
    /// Deflection and slope of the beam, one entry per mode.
    pub shape: Vec<Shape>,
    /// Orthogonal matrix Q from eigenmodes to shapes, `[eigenmode][shape]`, each normalised to modal mass 1:
    /// the identity except after [`Modes::aligned_to`]. Frequencies and energies are those of the eigenmodes.
    pub rotation: [[f64; MODES]; MODES],
}

impl Modes {
    /// The [`FLEXIBLE`] lowest modes of a beam, and one more for each of up to [`SLOSH`]
    /// sloshing masses. Slosh modes are those with the largest kinetic energy in the sloshing masses.
    ///
    /// # Panics
    /// With more than [`SLOSH`] oscillators.
    pub fn solve(beam: &Beam, oscillators: &[Oscillator]) -> Result<Self, Error> {
        Self::sorted(beam, oscillators, lanczos::lowest_modes)
    }

    /// The same, with shapes to nine digits and frequencies to thirteen, in two thirds of the time.
    ///
    /// # Panics
    /// With more than [`SLOSH`] oscillators.
    pub fn nearly(beam: &Beam, oscillators: &[Oscillator]) -> Result<Self, Error> {
        Self::sorted(beam, oscillators, lanczos::nearly_lowest_modes)
    }

    fn sorted(
        beam: &Beam,
        oscillators: &[Oscillator],
        lowest: fn(&lanczos::Structure, usize) -> Result<Vec<lanczos::EigenPair>, Error>,
    ) -> Result<Self, Error> {
        assert!(oscillators.len() <= SLOSH, "a slosh mode for each of {SLOSH} sloshing masses");
        let count = FLEXIBLE + oscillators.len();
        let structure = lanczos::Structure { beam, oscillators };
        let pairs = lowest(&structure, count)?;

        let sloshing_share = |displacement: &[f64]| -> f64 {
            let masses = &displacement[beam.unknowns()..];
            masses.iter().zip(oscillators).map(|(w, o)| o.mass * w * w).sum()
        };
        let mut order: Vec<usize> = (0..count).collect();
        // The sort is stable, so equal modes keep their order.
        order.sort_by(|&a, &b| {
            let share = |i: usize| sloshing_share(&pairs[i].displacement);
            share(a).total_cmp(&share(b))
        });
        order[..FLEXIBLE].sort_unstable();
        order[FLEXIBLE..].sort_unstable();

        let mut modes = Self { count, ..Self::default() };
        for (i, pair) in order.into_iter().map(|rank| &pairs[rank]).enumerate() {
            modes.append(i, pair, &structure);
        }
        Ok(modes)
    }

    fn append(&mut self, i: usize, pair: &lanczos::EigenPair, structure: &lanczos::Structure) {
        let (u, omega2) = (&pair.displacement, 1.0 / pair.flexibility);
        let masses = &u[structure.beam.unknowns()..];
        let mut relative = [0.0; SLOSH];
        for ((relative, w), o) in relative.iter_mut().zip(masses).zip(structure.oscillators) {
            *relative = w - u[2 * o.node];
        }
        let unit = if i < FLEXIBLE {
            u[0]
        } else if relative[1].abs() > relative[0].abs() {
            relative[1]
        } else {
            relative[0]
        };
        let springs: f64 =
            structure.oscillators.iter().zip(relative).map(|(o, r)| o.stiffness * r * r).sum();
        self.omega_rad_per_s[i] = omega2.sqrt();
        self.rotation[i][i] = 1.0;
        self.modal_mass[i] = 1.0 / (unit * unit);
        for (row, relative) in self.slosh_displacement.iter_mut().zip(relative) {
            row[i] = relative / unit;
        }
        // The displacement has modal mass 1, so omega^2 is twice the strain energy.
        self.beam_energy_share[i] = (1.0 - springs / omega2).clamp(0.0, 1.0);
        let nodal = &u[..structure.beam.unknowns()];
        self.shape.push(Shape::scaled(nodal, 1.0 / unit));
    }

    /// Deflection and slope (1/m) of each mode at a point.
    pub fn at(&self, point: &Point) -> [[f64; MODES]; 2] {
        let mut at = [[0.0; MODES]; 2];
        for (i, shape) in self.shape.iter().enumerate() {
            (at[0][i], at[1][i]) = (shape.w_at(point), shape.slope_at(point));
        }
        at
    }

    /// One over the modal mass, m/kg; 0 for a mode that does not exist. The divisor is never 0: a compiler
    /// may execute a division before the condition that guards it.
    pub fn per_modal_mass(&self, mode: usize) -> f64 {
        f64::from(u8::from(mode < self.count)) / self.modal_mass[mode].max(f64::MIN_POSITIVE)
    }

    /// Modal stiffness matrix K of `eta'' + D eta' + K eta = N / mu`, 1/s^2.
    pub fn stiffness(&self) -> [[f64; MODES]; MODES] {
        self.in_shapes(&self.omega_rad_per_s.map(|omega| omega * omega))
    }

    /// Modal damping matrix D of `eta'' + D eta' + K eta = N / mu`, 1/s.
    ///
    /// For eigenmodes `D_ik = (1/mu_i) sum_j c_j s_ji s_jk + delta_ik 2 zeta_i omega_i e_i`, with the
    /// displacement s_ji of sloshing mass j relative to its node and the beam's share e_i of the strain
    /// energy. The dampers of the sloshing masses couple the modes. Slosh modes have the structural
    /// damping ratio of the first flexible mode, as they bend the beam quasi-statically.
    pub fn damping(
        &self,
        oscillators: &[Oscillator],
        structural_ratio: &[f64; FLEXIBLE],
    ) -> [[f64; MODES]; MODES] {
        let structural = std::array::from_fn(|i| {
            let ratio = structural_ratio.get(i).unwrap_or(&structural_ratio[0]);
            2.0 * ratio * self.omega_rad_per_s[i] * self.beam_energy_share[i]
        });
        let mut damping = self.in_shapes(&structural);
        for (i, row) in damping.iter_mut().enumerate().take(self.count) {
            for (k, entry) in row.iter_mut().enumerate().take(self.count) {
                let power: f64 = oscillators
                    .iter()
                    .zip(&self.slosh_displacement)
                    .map(|(oscillator, relative)| oscillator.damping * relative[i] * relative[k])
                    .sum();
                *entry += power / self.modal_mass[i];
            }
        }
        damping
    }

    /// mu^-1/2 Q^T diag Q mu^1/2: a matrix that is diagonal in the eigenmodes, in terms of the shapes.
    fn in_shapes(&self, diagonal: &[f64; MODES]) -> [[f64; MODES]; MODES] {
        let mut matrix = [[0.0; MODES]; MODES];
        for (i, row) in matrix.iter_mut().enumerate().take(self.count) {
            for (k, entry) in row.iter_mut().enumerate().take(self.count) {
                let parts = self.rotation.iter().zip(diagonal);
                let sum: f64 = parts.map(|(q, value)| value * q[i] * q[k]).sum();
                *entry = sum * (self.modal_mass[k] / self.modal_mass[i]).sqrt();
            }
        }
        matrix
    }
}
