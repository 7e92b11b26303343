//! The one rigid body of pitch, bending and slosh: its mass centre and pitch inertia are those that are
//! asked for, by the [`MassCorrection`] of its beam.

use super::beam::{Beam, MassProperties, Oscillator};
use super::mass_correction::{MassCorrection, RigidMotion};
use crate::error::Error;
use std::borrow::Cow;

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
}

impl Beam {
    /// Its rigid motion: that of its moments, where these are known.
    pub fn rigid_motion(&self) -> Cow<'_, RigidMotion> {
        match self.correction.motion.rotation.is_empty() {
            true => Cow::Owned(RigidMotion::of(self)),
            false => Cow::Borrowed(&self.correction.motion),
        }
    }

    /// Gives the beam, with these sloshing masses on it, another mass centre and pitch inertia; the
    /// mass stays. Only the rigid motion of the beam changes.
    ///
    /// # Errors
    /// [`Error::Inertia`] if no body could have them: the kinetic energy would not be positive.
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
        // Also false for what is not a number.
        let possible = inertia > least && inertia.is_finite();
        if !possible {
            return Err(Error::Inertia { inertia, least, own: own.inertia, shift_m: shift });
        }
        self.correction = MassCorrection { first, second, motion };
        Ok(self)
    }
}
