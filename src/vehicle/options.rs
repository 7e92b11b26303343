//! What shapes a vehicle.

use super::factors::Factors;
use super::state::{GAMMA, H, STATES, State, V};
use crate::air::Atmosphere;
use crate::data::AeroSet;
use crate::error::{Error, Sensor};

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

/// Flight condition to be held.
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
    /// State on this condition with everything else zero.
    pub fn start(&self, atmosphere: &Atmosphere) -> State {
        let mut x = [0.0; STATES];
        x[V] = self.mach * atmosphere.sound_speed(self.altitude);
        x[H] = self.altitude;
        x[GAMMA] = self.gamma;
        x
    }
}

/// Where the sensors sit, m from the nose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorStations {
    /// Inertial measurement unit.
    pub imu: f64,
    /// Incidence vane.
    pub probe: f64,
}

impl SensorStations {
    /// Whether both are on a body of this length, m.
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

/// What shapes a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VehicleOptions {
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
    /// Where the sensors sit.
    pub stations: SensorStations,
    /// What is uncertain.
    pub factors: Factors,
}
