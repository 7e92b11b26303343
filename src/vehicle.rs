//! From data and parameters to a vehicle that can fly.

use crate::aero::Aero;
use crate::aeroelastic::{Strips, derive};
use crate::atmosphere::Atmosphere;
use crate::beam::{Beam, MassProperties, Oscillator};
use crate::burn::Burn;
use crate::dynamics::{Airframe, Vehicle};
use crate::error::Error;
use crate::intake::Intake;
use crate::modes::{MODES, Modes};
use crate::params::{
    AeroData, DataFile, EARTH, EarthData, OWN, PARKER2007, SHOCK_EXPANSION, VEHICLE, VehicleData,
    XU2015,
};
use crate::slosh::{SloshSettings, SloshingTank, fuel_kg_per_m};
use crate::trim::Condition;
use std::sync::Arc;

/// Which parts of the vehicle can move. The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// Rigid body: 5 states.
    Rigid = 1,
    /// Flexible beam with its mass spread evenly: 11 states.
    EvenMassBeam = 2,
    /// Flexible beam with sloshing propellant: 15 states.
    SloshBeam = 3,
}

/// Coefficient set of eq. (4). The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AeroSet {
    /// Published set, moved as little as possible towards Tables 2 and 3.
    Xu2015 = 1,
    /// Published rigid part, derived elastic part.
    Parker2007 = 2,
    /// Regression of the first-principles model.
    ShockExpansion = 3,
    /// That of the user, in a library that was built with one.
    Own = 4,
}

/// What shapes a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Build {
    /// Which parts can move.
    pub configuration: Configuration,
    /// Coefficient set.
    pub aero: AeroSet,
    /// Propellant at the start, 0 to 1.
    pub fuel_fraction: f64,
    /// Whether it burns in flight.
    pub fuel_burn: bool,
    /// Damping ratio of the sloshing masses.
    pub slosh_damping: f64,
    /// Sloshing frequency, rad/s; 0 takes the geometry of the tanks.
    pub slosh_frequency: f64,
    /// Flight condition: the tanks' geometry gives a frequency only under its effective gravity.
    pub condition: Condition,
}

/// All data files, read and checked.
#[derive(Debug, Clone)]
pub struct Data {
    /// Vehicle.
    pub vehicle: VehicleData,
    /// Gravity and air.
    pub earth: EarthData,
    /// Identified coefficient set.
    pub xu2015: AeroData,
    /// Published coefficient set.
    pub parker2007: AeroData,
    /// Coefficient set fitted to the first-principles model.
    pub shock_expansion: AeroData,
    /// Coefficient set of the user.
    pub own: Option<AeroData>,
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: VehicleData::embedded(&VEHICLE)?,
            earth: EarthData::embedded(&EARTH)?,
            xu2015: AeroData::embedded(&XU2015)?,
            parker2007: AeroData::embedded(&PARKER2007)?,
            shock_expansion: AeroData::embedded(&SHOCK_EXPANSION)?,
            own: OWN.as_ref().map(AeroData::embedded).transpose()?,
        })
    }

    /// The data of a coefficient set.
    pub fn aero(&self, set: AeroSet) -> &AeroData {
        match set {
            AeroSet::Xu2015 => &self.xu2015,
            AeroSet::Parker2007 => &self.parker2007,
            AeroSet::ShockExpansion => &self.shock_expansion,
            AeroSet::Own => self.own.as_ref().unwrap_or(&self.xu2015),
        }
    }
}

/// Least gravity, over gravity at rest, for which a vehicle is put together.
const WEIGHTLESS: f64 = 1e-3;

/// Gravity less the centrifugal part across the flight path, m/s^2: what the liquid feels in
/// steady flight.
fn effective_gravity(data: &Data, condition: &Condition) -> f64 {
    let atmosphere = Atmosphere::new(&data.earth);
    let start = condition.start(&atmosphere);
    let (gravity, distance) = atmosphere.gravity(start[1]);
    let felt = (gravity - start[0] * start[0] / distance) * libm::cos(start[2]);
    // Near orbital speed nothing holds the liquid down. No curve fit reaches there; the trim says so.
    felt.max(WEIGHTLESS * gravity)
}

/// The beam of a configuration with the sloshing masses on it.
///
/// # Errors
/// [`Error::Value`] if the tanks' geometry gives no sloshing frequency.
pub fn structure(data: &Data, build: &Build) -> Result<(Beam, Vec<Oscillator>), Error> {
    if build.configuration != Configuration::SloshBeam {
        return Ok((Beam::even(&data.vehicle, build.fuel_fraction), Vec::new()));
    }
    let settings = SloshSettings {
        damping_ratio: build.slosh_damping,
        frequency_rad_per_s: build.slosh_frequency,
        gravity_m_per_s2: effective_gravity(data, &build.condition),
    };
    let tanks = SloshingTank::pair(&data.vehicle, build.fuel_fraction, &settings)?;
    let beam = Beam::slosh(&data.vehicle, &tanks);
    let oscillators = tanks.iter().map(|tank| beam.attach(tank)).collect();
    Ok((beam, oscillators))
}

/// What a build does not owe to its coefficient set: beam, sloshing masses and modes.
#[derive(Debug, Clone)]
pub struct Body {
    beam: Beam,
    oscillators: Vec<Oscillator>,
    modes: Modes,
    strips: Strips,
    properties: MassProperties,
    /// Pitch inertia over that of the full vehicle.
    inertia_left: f64,
}

impl Body {
    /// Assembles the beam and solves for its modes.
    ///
    /// # Errors
    /// [`Error`] if the tanks give no frequency or the modes cannot be found.
    pub fn new(data: &Data, build: &Build) -> Result<Self, Error> {
        let (beam, oscillators) = structure(data, build)?;
        let properties = beam.mass_properties(&oscillators);
        let full = if build.fuel_fraction == 1.0 {
            properties
        } else {
            let (beam, oscillators) = structure(data, &Build { fuel_fraction: 1.0, ..*build })?;
            beam.mass_properties(&oscillators)
        };
        let modes = match build.configuration {
            Configuration::Rigid => Modes::default(),
            _ => Modes::solve(&beam, &oscillators)?,
        };
        let inertia_left = properties.inertia / full.inertia;
        let strips = Strips::new(&beam, &modes, &data.vehicle.geometry);
        Ok(Self { beam, oscillators, modes, strips, properties, inertia_left })
    }

    /// The same body, its modes in the basis nearest to those of another fuel level.
    ///
    /// # Errors
    /// Those of [`Modes::turned`].
    pub fn turned(mut self, data: &Data, reference: &Self) -> Result<Self, Error> {
        let reference = (&reference.modes, &reference.oscillators[..]);
        self.modes = self.modes.turned(&self.beam, &self.oscillators, reference)?;
        self.strips = Strips::new(&self.beam, &self.modes, &data.vehicle.geometry);
        Ok(self)
    }

    /// Displacement of the beam and of each sloshing mass, for each mode.
    pub fn displacements(&self) -> Vec<Vec<f64>> {
        self.modes.displacements(&self.oscillators)
    }

    /// `phi_i^T M v_k / mu_i` of the modes phi and of any displacements v.
    pub fn products(&self, displacements: &[Vec<f64>]) -> [[f64; MODES]; MODES] {
        self.modes.products(&self.beam, &self.oscillators, displacements)
    }

    /// What the equations of flight need of it, with a coefficient set around it.
    ///
    /// The set's inertia is that of the full vehicle; with less propellant it falls as the beam's
    /// own inertia does.
    pub fn airframe(&self, data: &Data, build: &Build, set: &AeroData) -> Airframe {
        let Self { beam, oscillators, modes, strips, properties, inertia_left } = self;
        // A force m g up on each sloshing mass and down on its tank.
        let gravity = effective_gravity(data, &build.condition);
        let damping = modes.damping(oscillators, &set.inertia.structural_damping.value);
        let floor = std::array::from_fn(|i| {
            let weights = oscillators.iter().zip(&modes.slosh_displacement);
            let work: f64 = weights.map(|(o, relative)| o.mass * gravity * relative[i]).sum();
            if i < modes.count { work / modes.modal_mass[i] } else { 0.0 }
        });
        Airframe {
            mass: properties.mass,
            inertia: set.inertia.i_yy_kg_m2_per_m.value * inertia_left,
            mass_centre: properties.centre_m,
            elastic: derive(&Aero::new(set), beam, modes, strips, properties.centre_m),
            stiffness: modes.stiffness(),
            damping: std::array::from_fn(|k| damping.map(|row| row[k])),
            floor,
            slosh: modes.slosh_displacement,
            turning: Default::default(),
        }
    }
}

impl Vehicle {
    /// Puts a vehicle together.
    ///
    /// # Errors
    /// [`Error`] if the tanks give no frequency or the modes cannot be found.
    pub fn new(data: &Data, build: &Build) -> Result<Self, Error> {
        let (body, set) = (Body::new(data, build)?, data.aero(build.aero));
        let burn = build.fuel_burn.then(|| Burn::new(data, build, &body, set)).transpose()?;
        Ok(Self { burn: burn.map(Arc::new), ..Self::with_body(data, build, &body, set) })
    }

    /// The vehicle of a build with any coefficient set around its body; its fuel does not burn.
    pub fn with_body(data: &Data, build: &Build, body: &Body, set: &AeroData) -> Self {
        Self {
            atmosphere: Atmosphere::new(&data.earth),
            aero: Aero::new(set),
            modes: body.modes.count,
            fuel: fuel_kg_per_m(&data.vehicle, build.fuel_fraction),
            omega: body.modes.omega_rad_per_s,
            airframe: body.airframe(data, build, set),
            burn: None,
            intake: Intake::new(&data.vehicle, &data.earth),
            limits: [
                data.vehicle.actuation.delta_e_limit_rad.value,
                data.vehicle.actuation.phi_limit.value,
            ],
        }
    }
}
