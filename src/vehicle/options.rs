//! Options of a vehicle.

use super::factors::Factors;
use super::state::{GAMMA, H, STATES, State, V};
use crate::air::Atmosphere;
use crate::data::AeroSet;
use crate::error::{Error, Sensor};

/// Degrees of freedom. The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// Rigid body: 5 states.
    Rigid = 1,
    /// Flexible beam with its mass spread evenly: 11 states.
    EvenMassBeam = 2,
    /// Flexible beam with sloshing propellant: 15 states.
    SloshBeam = 3,
}

/// Flight condition.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condition {
    /// Mach number.
    pub mach: f64,
    /// Altitude, m.
    pub altitude: f64,
    /// Flight-path angle, rad.
    pub gamma: f64,
}

impl Condition {
    /// State with this condition and all other components zero.
    pub fn start(&self, atmosphere: &Atmosphere) -> State {
        let mut x = [0.0; STATES];
        x[V] = self.mach * atmosphere.sound_speed(self.altitude);
        x[H] = self.altitude;
        x[GAMMA] = self.gamma;
        x
    }
}

/// Stations of the sensors, m from the nose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorStations {
    /// Inertial measurement unit.
    pub imu: f64,
    /// Incidence vane.
    pub probe: f64,
}

impl SensorStations {
    /// Checks that both are on a body of this length, m.
    ///
    /// # Errors
    /// [`Error::SensorOffBody`].
    pub fn check(&self, length_m: f64) -> Result<(), Error> {
        for (sensor, station_m) in [(Sensor::Imu, self.imu), (Sensor::Probe, self.probe)] {
            if !(0.0..=length_m).contains(&station_m) {
                return Err(Error::SensorOffBody { sensor, station_m, length_m });
            }
        }
        Ok(())
    }
}

/// Options of a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VehicleOptions {
    /// Degrees of freedom.
    pub configuration: Configuration,
    /// Coefficient set.
    pub aero: AeroSet,
    /// Propellant at the start, 0 to 1.
    pub fuel_fraction: f64,
    /// Whether fuel burns in flight.
    pub fuel_burn: bool,
    /// Damping ratio of the sloshing masses.
    pub slosh_damping: f64,
    /// Sloshing frequency, rad/s; 0 takes the geometry of the tanks.
    pub slosh_frequency: f64,
    /// Flight condition; its effective gravity determines the sloshing frequency.
    pub condition: Condition,
    /// Sensor stations.
    pub stations: SensorStations,
    /// Uncertainty factors.
    pub factors: Factors,
}
