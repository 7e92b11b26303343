//! Beam, liquid and modes of a vehicle at one fuel level.

use super::airframe::Airframe;
use super::assembly::VehicleDefinition;
use super::options::Configuration;
use crate::air::curve_fits::Aero;
use crate::air::strip_theory::{StripIntegrals, elastic_derivatives};
use crate::error::Error;
use crate::structure::{Beam, MODES, MassProperties, Modes, Oscillator, SLOSH};

/// Beam, sloshing masses and modes of a vehicle at one fuel level.
#[derive(Debug, Clone)]
pub struct Body {
    /// Beam.
    pub beam: Beam,
    /// Sloshing masses.
    pub oscillators: Vec<Oscillator>,
    /// Coupled modes.
    pub modes: Modes,
    /// Mass, mass centre and pitch inertia of beam and sloshing masses.
    pub properties: MassProperties,
    strips: StripIntegrals,
}

impl Body {
    /// Assembles the beam and computes its modes.
    ///
    /// # Errors
    /// Those of [`VehicleDefinition::structure`]; [`Error::Modes`] if the modes cannot be found.
    pub fn new(definition: &VehicleDefinition) -> Result<Self, Error> {
        Self::with_modes(definition, Modes::solve)
    }

    /// The same, with the modes in the basis nearest to those of a reference at another fuel level, to nine
    /// digits ([`Modes::nearly`]).
    ///
    /// # Errors
    /// Those of [`Body::new`] and [`Modes::aligned_to`].
    pub fn aligned(definition: &VehicleDefinition, reference: &Self) -> Result<Self, Error> {
        let reference = (&reference.modes, &reference.oscillators[..]);
        Self::with_modes(definition, |beam, oscillators| {
            Modes::nearly(beam, oscillators)?.aligned_to(beam, oscillators, reference)
        })
    }

    fn with_modes(
        definition: &VehicleDefinition,
        modes: impl FnOnce(&Beam, &[Oscillator]) -> Result<Modes, Error>,
    ) -> Result<Self, Error> {
        let (beam, oscillators) = definition.structure()?;
        let properties = beam.mass_properties(&oscillators);
        let modes = match definition.options.configuration {
            Configuration::Rigid => Modes::default(),
            _ => modes(&beam, &oscillators)?,
        };
        let strips = StripIntegrals::new(&beam, &modes, &definition.vehicle.geometry);
        Ok(Self { beam, oscillators, modes, strips, properties })
    }

    /// Displacement of the beam and of each sloshing mass, for each mode.
    pub fn displacements(&self) -> Vec<Vec<f64>> {
        self.modes.displacements(&self.oscillators)
    }

    /// `phi_i^T M v_k / mu_i` for the modes phi and any displacements v.
    pub fn products(&self, displacements: &[Vec<f64>]) -> [[f64; MODES]; MODES] {
        self.modes.products(&self.beam, &self.oscillators, displacements)
    }

    /// Coefficients of the equations of motion.
    ///
    /// # Errors
    /// [`Error::NoSloshFrequency`] if the tanks' geometry gives no sloshing frequency.
    pub fn airframe(&self, definition: &VehicleDefinition) -> Result<Airframe, Error> {
        let Self { beam, oscillators, modes, strips, properties } = self;
        let VehicleDefinition { aero, options, .. } = definition;
        // The floor exerts m g up on each sloshing mass and down on its tank.
        let gravity = definition.effective_gravity();
        let damping = modes.damping(oscillators, &aero.inertia.structural_damping.value);
        let floor = std::array::from_fn(|i| {
            let weights = oscillators.iter().zip(&modes.slosh_displacement);
            let work: f64 = weights.map(|(o, relative)| o.mass * gravity * relative[i]).sum();
            // Both are zero for a mode that does not exist.
            work / modes.modal_mass[i].max(f64::MIN_POSITIVE)
        });
        let rate = options.factors.pitch_rate;
        let tanks = definition.tanks(options.fuel_fraction)?;
        Ok(Airframe {
            mass: properties.mass,
            inertia: properties.inertia,
            mass_centre: properties.centre_m,
            elastic: elastic_derivatives(
                &Aero::new(aero),
                beam,
                modes,
                strips,
                properties.centre_m,
                rate,
            ),
            stiffness: modes.stiffness(),
            damping: std::array::from_fn(|k| damping.map(|row| row[k])),
            floor,
            slosh: modes.slosh_displacement,
            turning: Default::default(),
            imu: modes.at(&beam.point(options.stations.imu)),
            probe: modes.at(&beam.point(options.stations.probe)),
            depth: tanks.map_or([0.0; SLOSH], |tanks| tanks.map(|tank| tank.depth_m)),
        })
    }
}
