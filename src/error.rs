//! What can go wrong, with the quantity, the value and the limit, in the words of the physics.

use crate::short::short;
use std::fmt;

/// A physical quantity that has limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitedKind {
    /// Altitude, m.
    Altitude,
    /// Mach number.
    Mach,
    /// Incidence, rad.
    Incidence,
    /// Elevator deflection, rad.
    Elevator,
    /// Fuel equivalence ratio.
    FuelRatio,
    /// Displacement of the sloshing mass in the tank of this number, m.
    Slosh(usize),
    /// Fuel equivalence ratio that can still be added before the burner chokes.
    ChokingMargin,
    /// State of this number.
    State(usize),
}

impl LimitedKind {
    /// Its unit after a number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Altitude | Self::Slosh(_) => " m",
            Self::Incidence | Self::Elevator => " rad",
            _ => "",
        }
    }

    /// What is beyond its limits.
    pub fn beyond(self) -> &'static str {
        match self {
            Self::Slosh(_) => "beyond it the liquid would leave its depth",
            Self::ChokingMargin => "beyond it the burner chokes",
            _ => "beyond it the curve fits mean nothing",
        }
    }
}

impl fmt::Display for LimitedKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Altitude => f.write_str("altitude"),
            Self::Mach => f.write_str("Mach number"),
            Self::Incidence => f.write_str("incidence"),
            Self::Elevator => f.write_str("elevator deflection"),
            Self::FuelRatio => f.write_str("fuel ratio"),
            Self::Slosh(0) => f.write_str("displacement of the fore liquid"),
            Self::Slosh(_) => f.write_str("displacement of the aft liquid"),
            Self::ChokingMargin => f.write_str("margin from thermal choking"),
            Self::State(number) => write!(f, "state {number}"),
        }
    }
}

/// A quantity with its value and limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedQuantity {
    /// Which one.
    pub kind: LimitedKind,
    /// Its value.
    pub value: f64,
    /// Its limits.
    pub limits: [f64; 2],
}

impl LimitedQuantity {
    /// Distance to the nearer limit over the width of the range, if it has one; negative outside.
    pub fn margin(&self) -> f64 {
        let [min, max] = self.limits;
        let (nearest, width) = (f64::min(self.value - min, max - self.value), max - min);
        // The divisor is chosen, not the quotient: infinity over infinity would be computed too.
        nearest / if width.is_finite() { width } else { 1.0 }
    }
}

/// A sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sensor {
    /// Inertial measurement unit.
    Imu,
    /// Incidence vane.
    Probe,
}

/// The parameter behind a start outside the limits, with its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StartCause {
    /// Altitude, m.
    Altitude(f64),
    /// Mach number.
    Mach(f64),
    /// Incidence without trim, rad.
    Incidence(f64),
    /// Offset of the incidence, rad.
    IncidenceOffset(f64),
    /// Flexible mode of this number, m at the nose.
    Bending(usize, f64),
    /// Offset of the liquid in the tank of this number, m.
    SloshOffset(usize, f64),
    /// Frequency of the sloshing masses, rad/s.
    SloshFrequency(f64),
    /// Propellant left.
    FuelFraction(f64),
    /// Fuel equivalence ratio of the trim: the burner chokes.
    TrimFuelRatio(f64),
}

/// A failure of the model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// A data file does not hold what the model needs.
    #[error("{file}: {key}: {problem}")]
    Data {
        /// Name of the data file.
        file: String,
        /// Key inside the file, with its table: `beam.elements`.
        key: String,
        /// What is wrong, with value and limit.
        problem: String,
    },
    /// A data file cannot be read.
    #[error("{file} cannot be read: {problem}")]
    File {
        /// Its path.
        file: String,
        /// What hinders.
        problem: String,
    },
    /// A sensor is not on the body.
    #[error("a sensor at {station_m} m is off the body, which extends from 0 to {length_m} m")]
    SensorOffBody {
        /// Which one.
        sensor: Sensor,
        /// Its station, m aft of the nose.
        station_m: f64,
        /// Length of the body, m.
        length_m: f64,
    },
    /// The sloshing masses are asked to move more slowly than the modes can be told apart.
    #[error("a sloshing frequency of {asked_rad_per_s} rad/s is below {least_rad_per_s} rad/s")]
    SloshFrequency {
        /// Frequency asked for, rad/s.
        asked_rad_per_s: f64,
        /// The least, rad/s.
        least_rad_per_s: f64,
    },
    /// No sloshing frequency follows from the tanks: gravity does not hold the liquid.
    #[error("no sloshing frequency follows from an effective gravity of {gravity_m_per_s2} m/s^2")]
    NoSloshFrequency {
        /// Gravity less the centrifugal relief, m/s^2.
        gravity_m_per_s2: f64,
    },
    /// The modes change too much from one fuel level to the next.
    #[error("the modes cannot be followed until the tanks are empty")]
    ModesNotFollowed,
    /// The flight would start outside the limits of the model.
    #[error(
        "{} = {:.6} at the start is outside [{:.6}, {:.6}]",
        limited.kind, limited.value, limited.limits[0], limited.limits[1]
    )]
    StartOutside {
        /// What is outside its limits.
        limited: LimitedQuantity,
        /// What puts it there.
        cause: StartCause,
    },
    /// The eigenmodes of the beam with its sloshing masses were not found.
    #[error(
        "only {found} of the {count} lowest modes of the beam were found; \
         check stiffness, masses and sloshing frequencies"
    )]
    Modes {
        /// Modes asked for.
        count: usize,
        /// Modes found.
        found: usize,
    },
    /// No body with these masses and tanks has the pitch inertia that is asked for.
    #[error(
        "a pitch inertia of {inertia:.5e} kg m^2/m is refused: beam and sloshing masses, {own:.5e} by \
         themselves, with the mass centre moved by {shift_m:.3} m, need more than {least:.5e}"
    )]
    Inertia {
        /// Inertia about the mass centre that is asked for, kg m^2/m.
        inertia: f64,
        /// The least that leaves the beam a positive kinetic energy, kg m^2/m.
        least: f64,
        /// Inertia by density and sloshing masses, kg m^2/m.
        own: f64,
        /// Mass centre asked for less that by density and sloshing masses, m.
        shift_m: f64,
    },
    /// No level flight within the limits of vehicle and curve fits.
    #[error(
        "no trim at Mach {}, altitude {} m, flight-path angle {} rad: {} (largest residual {residual:.3e})",
        short(*mach), short(*altitude_m), short(*gamma_rad), trim_limit(limit, |kind| kind.to_string())
    )]
    Trim {
        /// Mach number asked for.
        mach: f64,
        /// Altitude asked for, m.
        altitude_m: f64,
        /// Flight-path angle asked for, rad.
        gamma_rad: f64,
        /// Largest scaled residual of the trim equations, with the unknowns cut to their limits.
        residual: f64,
        /// The limit that was hit, with the value beyond it; none if the equations have no solution
        /// near steady flight.
        limit: Option<LimitedQuantity>,
    },
    /// The equations of motion have no value where the search for a trim starts.
    #[error(
        "the vehicle has no finite accelerations at Mach {}, altitude {} m: a number of its data, or \
         one of its factors, is much too large or too small",
        short(*mach), short(*altitude_m)
    )]
    NotFinite {
        /// Mach number asked for.
        mach: f64,
        /// Altitude asked for, m.
        altitude_m: f64,
    },
    /// The flight reached the edge of the region in which the curve fits hold.
    #[error(
        "{} = {:.6} reached the edge of its valid range [{:.6}, {:.6}] at t = {} s; {}",
        limited.kind, limited.value, limited.limits[0], limited.limits[1], short(*time_s),
        limited.kind.beyond()
    )]
    Envelope {
        /// What reached its limit, with its value at the last valid instant.
        limited: LimitedQuantity,
        /// The last valid instant, s.
        time_s: f64,
    },
    /// A state so far off that the equations have no numbers.
    #[error(
        "{} = {}: the equations have numbers in [{}, {}] only",
        limited.kind, short(limited.value), short(limited.limits[0]), short(limited.limits[1])
    )]
    Numberless {
        /// The state.
        limited: LimitedQuantity,
    },
    /// The tanks ran empty.
    #[error(
        "the fuel ran out at t = {} s, and the thrust of the curve fits is one with fuel",
        short(*time_s)
    )]
    Fuel {
        /// The last instant with fuel, s.
        time_s: f64,
    },
    /// The integrator cannot hold the tolerance.
    #[error(
        "no step holds the tolerance {tolerance:.1e} at t = {} s; raise the tolerance",
        short(*time_s)
    )]
    StepSize {
        /// Relative tolerance asked for.
        tolerance: f64,
        /// Time reached, s.
        time_s: f64,
    },
    /// The interval takes more steps than anyone waits for.
    #[error(
        "a step of {asked_s:e} s is too long: {trials} steps of the integrator reach t = {} s; \
         go on from there with shorter communication steps",
        short(*time_s)
    )]
    TooLong {
        /// Length of the interval, s.
        asked_s: f64,
        /// Steps tried.
        trials: usize,
        /// Time reached, s.
        time_s: f64,
    },
}

/// The limit of a trim, with names of quantities as the reader knows them.
pub fn trim_limit(limit: &Option<LimitedQuantity>, name: impl Fn(LimitedKind) -> String) -> String {
    let Some(LimitedQuantity { kind, value, limits: [min, max] }) = *limit else {
        return "the equations have no solution near steady flight".into();
    };
    let (name, unit) = (name(kind), kind.unit());
    match kind {
        LimitedKind::Mach | LimitedKind::Altitude => {
            format!("{name} = {}{unit} is beyond [{min}, {max}]", short(value))
        }
        _ => format!("{name} = {value:.4}{unit} is beyond [{min:.4}, {max:.4}]"),
    }
}
