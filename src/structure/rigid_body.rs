//! Mass centre and pitch inertia of beam and sloshing masses, set by the [`MassCorrection`] of the beam.
//!
//! Beam and sloshing masses (points at their nodes) have the mass m, the mass centre x_own and the
//! inertia I_own. To move the mass centre by D to x_c and make the inertia about x_c equal to I, equate
//! the moments about x_b, with d = x_own - x_b:
//!
//! ```text
//! first:   m d + delta       = m (d + D)        =>  delta = m D
//! second:  I_own + m d^2 + j = I + m (d + D)^2  =>  j = I - I_own + m ((d + D)^2 - d^2)
//! ```
//!
//! Positive definite if and only if I_b + j > delta^2 / m_b. Test:
//! `verif_an_inertia_that_leaves_the_body_none_is_refused_with_its_numbers`.

use super::beam::{Beam, MassProperties, Oscillator};
use super::mass_correction::{MassCorrection, RigidMotion};
use crate::error::Error;
use std::borrow::Cow;

impl RigidMotion {
    /// h and r of a beam's density.
    pub fn of(beam: &Beam) -> Self {
        let own = beam.density_properties(&[]);
        let MassProperties { mass, centre_m, inertia } = own;
        let nodes = 0..=beam.elements();
        let heave: Vec<f64> = nodes.clone().flat_map(|_| [1.0, 0.0]).collect();
        let rotation: Vec<f64> = nodes.flat_map(|i| [beam.station(i) - centre_m, 1.0]).collect();
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
            rotation: momenta(&rotation, inertia),
        }
    }
}

impl Beam {
    /// h and r, from the correction if there is one.
    pub fn rigid_motion(&self) -> Cow<'_, RigidMotion> {
        match self.correction.motion.rotation.is_empty() {
            true => Cow::Owned(RigidMotion::of(self)),
            false => Cow::Borrowed(&self.correction.motion),
        }
    }

    /// Sets mass centre and pitch inertia of the beam with these sloshing masses; the mass is unchanged.
    ///
    /// # Errors
    /// [`Error::Inertia`] if the mass matrix would not be positive definite.
    pub fn with_mass_properties(
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
        // False for NaN, too.
        let positive_definite = inertia > least && inertia.is_finite();
        if !positive_definite {
            return Err(Error::Inertia { inertia, least, own: own.inertia, shift_m: shift });
        }
        self.correction = MassCorrection { first, second, motion };
        Ok(self)
    }
}
