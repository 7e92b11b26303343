//! The variables: value reference = row, rows are only ever appended.

use crate::Autopilot;
use crate::commands::BREAKPOINTS;
use crate::law::LONGEST_PERIOD_S;
use crate::running::{Outputs, Running};
use fmi_model::{Dependencies, Kind, Unit, Variable};

type Row = Variable<Autopilot>;

const DEGREES: f64 = 180.0 / core::f64::consts::PI;

// Names are those of the vehicle's units: what is connected has the same.
const ONE: &Unit = Unit::ONE;
const SECOND: &Unit = Unit::SECOND;
const SPEED: &Unit = &Unit::new("m/s", Some("Velocity"), [0, 1, -1, 0]);
const ANGLE: &Unit = &Unit::new("rad", Some("Angle"), [0, 0, 0, 1]).displayed_as("deg", DEGREES);
const ANGULAR_RATE: &Unit =
    &Unit::new("rad/s", Some("AngularVelocity"), [0, 0, -1, 1]).displayed_as("deg/s", DEGREES);
const MASS_PER_WIDTH: &Unit = &Unit::new("kg/m", Some("MassPerWidth"), [1, -1, 0, 0]);

/// Of the manoeuvre.
const LONGEST_TIME_S: f64 = 1e6;
/// A quarter of a turn.
const LARGEST_ANGLE: f64 = core::f64::consts::FRAC_PI_2;
const LARGEST_SPEED_M_PER_S: f64 = 1e4;

const ROWS: usize = 16 + 3 * BREAKPOINTS;

/// All rows.
pub(crate) const TABLE: [Row; ROWS] = [
    measured(0, "V", SPEED, "Measured airspeed"),
    measured(1, "gamma", ANGLE, "Measured flight-path angle"),
    measured(2, "q", ANGULAR_RATE, "Measured pitch rate"),
    measured(
        3,
        "fuel_mass",
        MASS_PER_WIDTH,
        "Measured fuel, which the gains follow; 0, not connected: that of fuel_fraction",
    ),
    Variable::input(4, "V_change", SPEED, "Wanted change of airspeed, added to the manoeuvre"),
    Variable::input(5, "gamma_wanted", ANGLE, "Wanted flight-path angle, added to the manoeuvre"),
    output("delta_e", ANGLE, "Elevator command as deviation from trim", |outputs| outputs[0]),
    output("phi", ONE, "Command of the fuel ratio as deviation from trim", |outputs| outputs[1]),
    output("missed", ONE, "Measurements that were not believed", |outputs| outputs[2]),
    output("saturated", ONE, "Samples with a command at its limit", |outputs| outputs[3]),
    Variable::parameter(
        "period",
        Kind::Real(SECOND),
        "Sampling period; 0: that of the first design in law.json",
        |autopilot: &Autopilot| autopilot.period_s,
        |autopilot, value| autopilot.period_s = value,
    )
    .within([0.0, LONGEST_PERIOD_S]),
    Variable::parameter(
        "fuel_fraction",
        Kind::Real(ONE),
        "Fuel at the start, as a part of full tanks",
        |autopilot: &Autopilot| autopilot.fuel_fraction,
        |autopilot, value| autopilot.fuel_fraction = value,
    )
    .within([0.0, 1.0]),
    Variable::parameter(
        "V_level",
        Kind::Real(SPEED),
        "Airspeed that changes are counted from; 0: that of law.json",
        |autopilot: &Autopilot| autopilot.level_speed_m_per_s,
        |autopilot, value| autopilot.level_speed_m_per_s = value,
    )
    .within([0.0, LARGEST_SPEED_M_PER_S]),
    Variable::parameter(
        "delta_e_trim",
        Kind::Real(ANGLE),
        "The vehicle's delta_e_trim: the limits are absolute; 0: that of law.json",
        |autopilot: &Autopilot| autopilot.trim[0],
        |autopilot, value| autopilot.trim[0] = value,
    )
    .within([-LARGEST_ANGLE, LARGEST_ANGLE]),
    Variable::parameter(
        "phi_trim",
        Kind::Real(ONE),
        "The vehicle's phi_trim, likewise",
        |autopilot: &Autopilot| autopilot.trim[1],
        |autopilot, value| autopilot.trim[1] = value,
    )
    .within([0.0, 10.0]),
    time::<0>("command1_time"),
    speed::<0>("command1_V_change"),
    angle::<0>("command1_gamma"),
    time::<1>("command2_time"),
    speed::<1>("command2_V_change"),
    angle::<1>("command2_gamma"),
    time::<2>("command3_time"),
    speed::<2>("command3_V_change"),
    angle::<2>("command3_gamma"),
    time::<3>("command4_time"),
    speed::<3>("command4_V_change"),
    angle::<3>("command4_gamma"),
    time::<4>("command5_time"),
    speed::<4>("command5_V_change"),
    angle::<4>("command5_gamma"),
    time::<5>("command6_time"),
    speed::<5>("command6_V_change"),
    angle::<5>("command6_gamma"),
    time::<6>("command7_time"),
    speed::<6>("command7_V_change"),
    angle::<6>("command7_gamma"),
    time::<7>("command8_time"),
    speed::<7>("command8_V_change"),
    angle::<7>("command8_gamma"),
    Variable::calculated(
        "sampling_period",
        SECOND,
        "Sampling period in use",
        |running: &Running| running.period_s(),
    ),
];

/// An input that a failed sensor may feed.
const fn measured(
    number: usize,
    name: &'static str,
    unit: &'static Unit,
    description: &'static str,
) -> Row {
    Variable::input(number, name, unit, description).accepting_non_finite()
}

/// An output: what is measured acts from the next sample on.
const fn output(
    name: &'static str,
    unit: &'static Unit,
    description: &'static str,
    get: fn(&Outputs) -> f64,
) -> Row {
    Variable::output(name, unit, description, Dependencies::NONE, get)
}

const fn time<const I: usize>(name: &'static str) -> Row {
    let description = match I {
        0 => "Time of the first breakpoint of the manoeuvre, after the start",
        _ => "Time of the next breakpoint; 0: unused",
    };
    Variable::parameter(
        name,
        Kind::Real(SECOND),
        description,
        |autopilot: &Autopilot| autopilot.breakpoints[I].time_s,
        |autopilot, value| autopilot.breakpoints[I].time_s = value,
    )
    .within([0.0, LONGEST_TIME_S])
}

const fn speed<const I: usize>(name: &'static str) -> Row {
    Variable::parameter(
        name,
        Kind::Real(SPEED),
        "Wanted change of airspeed at the breakpoint",
        |autopilot: &Autopilot| autopilot.breakpoints[I].wanted[0],
        |autopilot, value| autopilot.breakpoints[I].wanted[0] = value,
    )
    .within([-LARGEST_SPEED_M_PER_S, LARGEST_SPEED_M_PER_S])
}

const fn angle<const I: usize>(name: &'static str) -> Row {
    Variable::parameter(
        name,
        Kind::Real(ANGLE),
        "Wanted flight-path angle at the breakpoint",
        |autopilot: &Autopilot| autopilot.breakpoints[I].wanted[1],
        |autopilot, value| autopilot.breakpoints[I].wanted[1] = value,
    )
    .within([-LARGEST_ANGLE, LARGEST_ANGLE])
}
