//! From data and parameters to a vehicle that can fly.

use crate::aero::{Aero, Elastic};
use crate::atmosphere::Atmosphere;
use crate::dynamics::Vehicle;
use crate::error::Error;
use crate::modes::{MODES, SLOSH};
use crate::params::{AeroData, EARTH_TOML, EarthData, PARKER2007_TOML, VEHICLE_TOML, VehicleData};
use crate::trim::Condition;

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
    /// Published rigid part, derived elastic part.
    Parker2007 = 2,
}

/// What shapes a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Build {
    /// Which parts can move.
    pub configuration: Configuration,
    /// Coefficient set.
    pub aero: AeroSet,
    /// Propellant left, 0 to 1.
    pub fuel_fraction: f64,
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
    /// Published coefficient set.
    pub parker2007: AeroData,
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: VehicleData::parse("vehicle.toml", VEHICLE_TOML)?,
            earth: EarthData::parse("earth.toml", EARTH_TOML)?,
            parker2007: AeroData::parse("aero/parker2007.toml", PARKER2007_TOML)?,
        })
    }

    /// The data of a coefficient set.
    pub fn aero(&self, set: AeroSet) -> &AeroData {
        match set {
            AeroSet::Parker2007 => &self.parker2007,
        }
    }
}

impl Vehicle {
    /// Puts a vehicle together.
    ///
    /// # Errors
    /// [`Error`] if the modes cannot be found.
    pub fn new(data: &Data, build: &Build) -> Result<Self, Error> {
        let set = data.aero(build.aero);
        let atmosphere = Atmosphere::new(&data.earth);
        let aero = Aero::new(set);
        Ok(Self {
            atmosphere,
            aero,
            elastic: Elastic::default(),
            mass: 14364.07,
            inertia: set.inertia.i_yy_kg_m2_per_m.value,
            mass_centre: aero.moment_centre,
            modes: 0,
            omega: [0.0; MODES],
            damping: [[0.0; MODES]; MODES],
            slosh: [[0.0; MODES]; SLOSH],
            limits: [
                data.vehicle.actuation.delta_e_limit_rad.value,
                data.vehicle.actuation.phi_limit.value,
            ],
        })
    }
}
