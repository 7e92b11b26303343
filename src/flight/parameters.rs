//! What can be chosen before a flight.

use crate::data::{AeroSet, Data};
use crate::structure::{FLEXIBLE, MODES};
use crate::vehicle::{Condition, Configuration, Factors, SensorStations, VehicleOptions};

/// Meaning of the two inputs. The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputMode {
    /// Added to the trim controls.
    DeviationFromTrim = 1,
    /// The controls themselves.
    Absolute = 2,
}

/// Added to the initial state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Offsets {
    /// Incidence, rad.
    pub alpha: f64,
    /// Pitch rate, rad/s.
    pub q: f64,
    /// Flexible modal coordinates, then displacements of the sloshing masses against their tanks, m.
    pub displacement: [f64; MODES],
    /// Their rates, m/s.
    pub rate: [f64; MODES],
}

/// What can be chosen before a flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// Vehicle and initial flight condition.
    pub options: VehicleOptions,
    /// Start from trimmed flight, or from the values below.
    pub trim: bool,
    /// Meaning of the inputs; always absolute without trim.
    pub input_mode: InputMode,
    /// Incidence to start from without trim, rad.
    pub alpha0: f64,
    /// Pitch rate to start from without trim, rad/s.
    pub q0: f64,
    /// Flexible modal coordinates to start from without trim, m at the nose.
    pub eta0: [f64; FLEXIBLE],
    /// Disturbance of the start.
    pub offsets: Offsets,
}

impl Parameters {
    /// The values that `vehicle.toml` gives.
    pub fn new(data: &Data) -> Self {
        let default = &data.vehicle.default;
        Self {
            options: VehicleOptions {
                configuration: Configuration::SloshBeam,
                aero: if data.own.is_some() { AeroSet::Own } else { AeroSet::Xu2015 },
                fuel_fraction: default.fuel_fraction.value,
                fuel_burn: false,
                slosh_damping: default.slosh_damping.value,
                slosh_frequency: default.slosh_frequency_rad_per_s.value,
                condition: Condition {
                    mach: default.mach.value,
                    altitude: default.altitude_m.value,
                    gamma: 0.0,
                },
                stations: SensorStations {
                    imu: default.imu_station_m.value,
                    probe: default.probe_station_m.value,
                },
                factors: Factors::default(),
            },
            trim: true,
            input_mode: InputMode::DeviationFromTrim,
            alpha0: 0.0,
            q0: 0.0,
            eta0: [0.0; FLEXIBLE],
            offsets: Offsets::default(),
        }
    }
}
