//! The rigid motion of a beam, and moments of mass that its density does not have.
//!
//! Pitch, bending and slosh share one kinetic energy, so the pitch inertia of the equations of flight
//! and the mass centre must be those of the mass matrix that the modes are orthogonal in. A beam's
//! density gives it a mass m_b, a mass centre x_b and an inertia I_b of its own. With the fields
//! 1 (heave) and b = x - x_b (rotation), `h = M_b 1 / m_b` and `r = M_b b / I_b` measure the mean
//! translation and the mean rotation of any displacement, and
//!
//! `M = M_b + delta (h r^T + r h^T) + j r r^T`
//!
//! has the same mass, the first moment delta about x_b and the inertia I_b + j. It differs from M_b in
//! the rigid motion of the beam alone: whatever is orthogonal to heave and rotation in M_b is so in M,
//! so a beam without sloshing masses keeps its modes. A product with M takes O(n).

use crate::beam::{Beam, MassProperties, Oscillator};
use crate::error::Error;
use std::borrow::Cow;

/// Mean translation and rotation of the displacements of a beam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RigidMotion {
    /// Mass, kg/m.
    pub mass: f64,
    /// Mass centre x_b of the density, m from the nose.
    pub centre_m: f64,
    /// Inertia I_b of the density about it, kg m^2/m.
    pub inertia: f64,
    /// h, one entry for each entry of a displacement.
    pub translation: Vec<f64>,
    /// r, 1/m.
    pub rotation: Vec<f64>,
}

impl RigidMotion {
    /// Of a beam's density.
    pub fn of(beam: &Beam) -> Self {
        let own = beam.density_properties(&[]);
        let MassProperties { mass, centre_m, inertia } = own;
        let nodes = 0..=beam.elements();
        let heave: Vec<f64> = nodes.clone().flat_map(|_| [1.0, 0.0]).collect();
        let turn: Vec<f64> = nodes.flat_map(|i| [beam.station(i) - centre_m, 1.0]).collect();
        let momenta = |field: &[f64], total: f64| {
            let mut product = vec![0.0; field.len()];
            beam.density_times(field, &mut product);
            product.iter_mut().for_each(|entry| *entry /= total);
            product
        };
        Self {
            mass,
            centre_m,
            inertia,
            translation: momenta(&heave, mass),
            rotation: momenta(&turn, inertia),
        }
    }

    /// Mean translation at x_b (unit of w) and mean slope (that over m) of nodal deflections and slopes.
    pub fn part(&self, w: &[f64], slope: &[f64]) -> [f64; 2] {
        [&self.translation, &self.rotation].map(|measure| {
            let (pairs, _) = measure.as_chunks::<2>();
            pairs
                .iter()
                .zip(w.iter().zip(slope))
                .map(|([by_w, by_slope], (w, s))| by_w * w + by_slope * s)
                .sum()
        })
    }
}

/// Moments of mass beyond those of the density.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Moments {
    /// delta, kg: of the mass per metre of width.
    pub first: f64,
    /// j, kg m^2/m.
    pub second: f64,
    /// Where they act; empty if there are none.
    pub motion: RigidMotion,
}

impl Moments {
    /// Adds `(delta (h r^T + r h^T) + j r r^T) displacement` to a product.
    pub fn add_product(&self, displacement: &[f64], product: &mut [f64]) {
        let RigidMotion { translation, rotation, .. } = &self.motion;
        let mean =
            |measure: &[f64]| -> f64 { measure.iter().zip(displacement).map(|(m, u)| m * u).sum() };
        let (moved, turned) = (mean(translation), mean(rotation));
        let along_h = self.first * turned;
        let along_r = self.first * moved + self.second * turned;
        for ((entry, h), r) in product.iter_mut().zip(translation).zip(rotation) {
            *entry += along_h * h + along_r * r;
        }
    }
}

impl Beam {
    /// Its rigid motion: that of its moments, where these are known.
    pub fn rigid_motion(&self) -> Cow<'_, RigidMotion> {
        match self.moments.motion.rotation.is_empty() {
            true => Cow::Owned(RigidMotion::of(self)),
            false => Cow::Borrowed(&self.moments.motion),
        }
    }

    /// Gives the beam, with these sloshing masses on it, another mass centre and pitch inertia; the
    /// mass stays. Only the rigid motion of the beam changes.
    ///
    /// # Errors
    /// [`Error::Inertia`] if no body could have them: the kinetic energy would not be positive.
    pub fn with_moments(
        mut self,
        oscillators: &[Oscillator],
        centre_m: f64,
        inertia: f64,
    ) -> Result<Self, Error> {
        let own = self.density_properties(oscillators);
        let motion = RigidMotion::of(&self);
        let (shift, off) = (centre_m - own.centre_m, own.centre_m - motion.centre_m);
        let first = own.mass * shift;
        let moved = own.mass * ((off + shift) * (off + shift) - off * off);
        let second = inertia - own.inertia + moved;
        let body = motion.inertia + second;
        let least = inertia - body + first * first / motion.mass;
        // Also false for what is not a number.
        let possible = inertia > least && inertia.is_finite();
        if !possible {
            return Err(Error::Inertia { inertia, least, own: own.inertia, shift_m: shift });
        }
        self.moments = Moments { first, second, motion };
        Ok(self)
    }
}
