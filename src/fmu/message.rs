//! Errors of the flight in the names of the FMU's variables: what a user reads in a master's log.

use crate::error::{Error, LimitedKind, LimitedQuantity, Sensor, StartCause, trim_limit};
use crate::short::short;
use crate::vehicle::STATE_NAMES;
use fmi_model::{ModelError, Remedy};
use std::fmt;

/// An error of the flight, told in the names of the FMU's variables.
#[derive(Debug, Clone, PartialEq)]
pub struct Message(pub Error);

impl From<Error> for Message {
    fn from(error: Error) -> Self {
        Self(error)
    }
}

impl std::error::Error for Message {}

impl ModelError for Message {
    fn remedy(&self) -> Remedy {
        match self.0 {
            // The integrator chose its own steps down to the last valid instant: a shorter
            // communication step gets no further.
            Error::Envelope { .. } | Error::Fuel { .. } | Error::StepSize { .. } => Remedy::End,
            Error::TooLong { .. } | Error::Numberless { .. } => Remedy::ShorterStep,
            _ => Remedy::Reset,
        }
    }
}

/// The variable that shows a quantity.
fn shown(kind: LimitedKind) -> &'static str {
    match kind {
        LimitedKind::Altitude => "h",
        LimitedKind::Mach => "mach",
        LimitedKind::Incidence => "alpha",
        LimitedKind::Elevator => "delta_e",
        LimitedKind::FuelRatio => "phi",
        LimitedKind::Slosh(tank) => ["slosh1", "slosh2"][tank],
        LimitedKind::ChokingMargin => "choking_margin",
        LimitedKind::State(number) => STATE_NAMES[number],
    }
}

/// The parameter behind a start outside the limits, its value, and what else to do.
fn parameter(cause: StartCause) -> (&'static str, f64, &'static str) {
    match cause {
        StartCause::Altitude(value) => ("altitude0", value, ""),
        StartCause::Mach(value) => ("mach0", value, ""),
        StartCause::Incidence(value) => ("alpha0", value, ""),
        StartCause::IncidenceOffset(value) => ("alpha_offset", value, ""),
        StartCause::Bending(mode, value) => (["eta10", "eta20", "eta30"][mode], value, ""),
        StartCause::SloshOffset(tank, value) => {
            (["slosh1_offset", "slosh2_offset"][tank], value, "")
        }
        StartCause::SloshFrequency(value) => ("slosh_frequency", value, ""),
        StartCause::FuelFraction(value) => ("fuel_fraction", value, ""),
        StartCause::TrimFuelRatio(value) => (
            "phi_trim",
            value,
            "; the burner chokes: choose another mach0, altitude0 or thrust_factor",
        ),
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Error::SensorOffBody { sensor, station_m, length_m } => {
                let name = match sensor {
                    Sensor::Imu => "imu_station",
                    Sensor::Probe => "probe_station",
                };
                let station = short(*station_m);
                write!(
                    f,
                    "{name} = {station} is refused: a sensor sits on the body, from 0 to {length_m} m"
                )
            }
            Error::SloshFrequency { asked_rad_per_s, least_rad_per_s } => write!(
                f,
                "slosh_frequency = {} is refused: 0 for the tanks' own frequencies, or \
                 {least_rad_per_s} and more",
                short(*asked_rad_per_s)
            ),
            Error::NoSloshFrequency { gravity_m_per_s2 } => write!(
                f,
                "slosh_frequency = 0 is refused: a positive frequency, since none follows from an \
                 effective gravity of {gravity_m_per_s2} m/s^2"
            ),
            Error::ModesNotFollowed => write!(
                f,
                "fuel_burn = 1 is refused: the modes cannot be followed until the tanks are empty; \
                 choose another slosh_frequency, or false"
            ),
            Error::StartOutside { limited, cause } => {
                let LimitedQuantity { kind, value, limits: [min, max] } = *limited;
                let (name, given, remedy) = parameter(*cause);
                let limit = match max {
                    f64::INFINITY => format!("from {min:.6} up"),
                    _ => format!("in [{min:.6}, {max:.6}]"),
                };
                write!(
                    f,
                    "{name} = {} is refused: it makes {} {value:.6} at the start; the model holds \
                     {limit}{remedy}",
                    short(given),
                    shown(kind)
                )
            }
            error @ Error::Inertia { .. } => write!(
                f,
                "{error}; raise inertia_factor or inertia.i_yy_kg_m2_per_m, or move the tanks towards \
                 the mass centre"
            ),
            Error::Trim { mach, altitude_m, gamma_rad, residual, limit } => {
                let name = |kind| match kind {
                    LimitedKind::Mach => "mach0".to_string(),
                    LimitedKind::Altitude => "altitude0".to_string(),
                    kind => shown(kind).to_string(),
                };
                write!(
                    f,
                    "no trim at mach0 = {}, altitude0 = {} m, gamma0 = {} rad: {} (largest residual \
                     {residual:.3e}); choose another flight condition, factors nearer to 1, or trim = \
                     false",
                    short(*mach),
                    short(*altitude_m),
                    short(*gamma_rad),
                    trim_limit(limit, name)
                )
            }
            Error::NotFinite { mach, altitude_m } => write!(
                f,
                "the vehicle has no finite accelerations at mach0 = {}, altitude0 = {} m: a number of \
                 its data, or one of its factors, is much too large or too small",
                short(*mach),
                short(*altitude_m)
            ),
            Error::Envelope { limited, time_s } => {
                let LimitedQuantity { kind, value, limits: [min, max] } = *limited;
                write!(
                    f,
                    "{} = {value:.6} reached the edge of its valid range [{min:.6}, {max:.6}] at t = \
                     {} s; {}, so the flight ends there",
                    shown(kind),
                    short(*time_s),
                    kind.beyond()
                )
            }
            Error::Numberless { limited } => {
                let LimitedQuantity { kind, value, limits } = *limited;
                let [min, max] = limits.map(short);
                write!(
                    f,
                    "{} = {}: the equations have numbers in [{min}, {max}] only; try a state nearer to \
                     flight, or a shorter step",
                    shown(kind),
                    short(value)
                )
            }
            Error::Fuel { time_s } => write!(
                f,
                "fuel_mass reached 0 at t = {} s: the fuel ran out, and the thrust of the curve fits is \
                 one with fuel, so the flight ends there; start with a larger fuel_fraction",
                short(*time_s)
            ),
            error => error.fmt(f),
        }
    }
}
