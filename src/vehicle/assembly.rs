//! Beam, liquid and coefficient set from data files and options.

use super::options::{Configuration, VehicleOptions};
use super::state::{GAMMA, H, V};
use crate::air::Atmosphere;
use crate::data::{AeroData, Data, EarthData, Inertia, VehicleData};
use crate::error::Error;
use crate::structure::tanks::{SloshSettings, SloshingTank};
use crate::structure::{Beam, Oscillator};

/// Lower limit of the effective gravity, relative to gravity.
const MIN_GRAVITY: f64 = 1e-3;

/// What a build asks of the data files: with its factors applied, and its coefficient set chosen. Boxed
/// as [`Data`] is.
#[derive(Debug, Clone)]
pub struct VehicleDefinition {
    /// Vehicle.
    pub vehicle: Box<VehicleData>,
    /// Gravity and air.
    pub earth: Box<EarthData>,
    /// Coefficient set.
    pub aero: Box<AeroData>,
    /// Options.
    pub options: VehicleOptions,
}

impl VehicleDefinition {
    /// With the coefficient set of the options.
    pub fn new(data: &Data, options: &VehicleOptions) -> Self {
        Self::with_coefficients(data, options, data.aero(options.aero))
    }

    /// With any coefficient set.
    pub fn with_coefficients(data: &Data, options: &VehicleOptions, set: &AeroData) -> Self {
        let factors = &options.factors;
        Self {
            vehicle: factors.vehicle(&data.vehicle).into(),
            earth: factors.earth(&data.earth).into(),
            aero: factors.aero(set).into(),
            options: *options,
        }
    }

    /// The same vehicle with another amount of fuel.
    pub fn at(&self, fuel_fraction: f64) -> Self {
        Self { options: VehicleOptions { fuel_fraction, ..self.options }, ..self.clone() }
    }

    /// Gravity less centrifugal acceleration, normal to the flight path, m/s^2.
    pub(crate) fn effective_gravity(&self) -> f64 {
        let atmosphere = Atmosphere::new(&self.earth);
        let start = self.options.condition.start(&atmosphere);
        let (gravity, distance) = atmosphere.gravity(start[H]);
        let felt = (gravity - start[V] * start[V] / distance) * libm::cos(start[GAMMA]);
        // It vanishes at orbital speed, which is outside all curve fits; the trim reports that.
        felt.max(MIN_GRAVITY * gravity)
    }

    pub(crate) fn tanks(&self, fuel_fraction: f64) -> Result<Option<[SloshingTank; 2]>, Error> {
        if self.options.configuration != Configuration::SloshBeam {
            return Ok(None);
        }
        let settings = SloshSettings {
            damping_ratio: self.options.slosh_damping,
            frequency_rad_per_s: self.options.slosh_frequency,
            gravity_m_per_s2: self.effective_gravity(),
        };
        SloshingTank::pair(&self.vehicle, fuel_fraction, &settings).map(Some)
    }

    /// Beam and sloshing masses without the correction of mass centre and inertia.
    fn assembled(&self, fuel_fraction: f64) -> Result<(Beam, Vec<Oscillator>), Error> {
        let Some(tanks) = self.tanks(fuel_fraction)? else {
            return Ok((Beam::even(&self.vehicle, fuel_fraction), Vec::new()));
        };
        let beam = Beam::slosh(&self.vehicle, &tanks);
        let oscillators = tanks.iter().map(|tank| beam.attach(tank)).collect();
        Ok((beam, oscillators))
    }

    /// The beam of a configuration and its sloshing masses, with the mass centre and the pitch inertia of the
    /// coefficient set. The set's inertia is that of the full vehicle; with less propellant it decreases in
    /// proportion to the inertia computed from the densities.
    ///
    /// # Errors
    /// [`Error::NoSloshFrequency`], [`Error::SloshFrequency`], [`Error::Inertia`] if no
    /// body could have the wanted inertia.
    pub fn structure(&self) -> Result<(Beam, Vec<Oscillator>), Error> {
        let fuel = self.options.fuel_fraction;
        let (beam, oscillators) = self.assembled(fuel)?;
        let own = beam.density_properties(&oscillators);
        let full = if fuel == 1.0 {
            own
        } else {
            let (beam, oscillators) = self.assembled(1.0)?;
            beam.density_properties(&oscillators)
        };
        let Inertia { i_yy_kg_m2_per_m, mass_centre_shift_m, .. } = &self.aero.inertia;
        let shift = match self.options.configuration {
            Configuration::Rigid => 0.0,
            _ => mass_centre_shift_m.as_ref().map_or(0.0, |shift| shift.value),
        };
        let centre = own.centre_m + shift + self.options.factors.mass_centre_shift_m;
        let inertia = i_yy_kg_m2_per_m.value * own.inertia / full.inertia;
        Ok((beam.with_mass_properties(&oscillators, centre, inertia)?, oscillators))
    }

    /// The same vehicle with the inertial measurement unit at the point whose flight-path angle Table 3
    /// uses, relative to the mass centre (m from the nose).
    pub fn with_imu_of_table_3(mut self, mass_centre_m: f64) -> Self {
        let offset = match self.options.configuration {
            Configuration::Rigid => 0.0,
            _ => self.aero.reference.gamma_offset_m.as_ref().map_or(0.0, |offset| offset.value),
        };
        self.options.stations.imu = mass_centre_m + offset;
        self
    }
}

/// [`VehicleDefinition::structure`] from data and options.
///
/// # Errors
/// Those of [`VehicleDefinition::structure`].
pub fn structure(data: &Data, options: &VehicleOptions) -> Result<(Beam, Vec<Oscillator>), Error> {
    VehicleDefinition::new(data, options).structure()
}
