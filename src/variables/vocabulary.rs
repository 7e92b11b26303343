//! The vocabulary of the table's rows: units, masks of dependencies, constructors, enumerations.

use crate::flight::Setup;
use crate::vehicle::{self, CONTROLS, NOMINAL, STATES, eta};
use fmi_model::{Dependencies, Items, Kind, Unit, Variable};

/// Turns per radian.
const HERTZ: f64 = 0.5 / core::f64::consts::PI;
/// Degrees per radian.
const DEGREES: f64 = 180.0 / core::f64::consts::PI;

pub(super) const ONE: &Unit = Unit::ONE;
/// Feet per metre: the paper's unit of length.
const FEET: f64 = 1.0 / 0.3048;

pub(super) const METRE: &Unit =
    &Unit::new("m", Some("Length"), [0, 1, 0, 0]).with_others(&[("ft", FEET)]);
/// Slope per deflection: an angle over a length.
pub(super) const SLOPE: &Unit = &Unit::new("rad/m", None, [0, -1, 0, 1]);
pub(super) const SPEED: &Unit =
    &Unit::new("m/s", Some("Velocity"), [0, 1, -1, 0]).with_others(&[("ft/s", FEET)]);
pub(super) const ACCELERATION: &Unit = &Unit::new("m/s2", Some("Acceleration"), [0, 1, -2, 0]);
pub(super) const ANGLE: &Unit =
    &Unit::new("rad", Some("Angle"), [0, 0, 0, 1]).displayed_as("deg", DEGREES);
pub(super) const ANGULAR_RATE: &Unit =
    &Unit::new("rad/s", Some("AngularVelocity"), [0, 0, -1, 1]).displayed_as("deg/s", DEGREES);
pub(super) const ANGULAR_ACCELERATION: &Unit =
    &Unit::new("rad/s2", Some("AngularAcceleration"), [0, 0, -2, 1]);
/// Frequencies share the dimension of an angular rate but are not shown in degrees.
pub(super) const FREQUENCY: &Unit =
    &Unit::new("rad/s", Some("AngularFrequency"), [0, 0, -1, 1]).with_others(&[("Hz", HERTZ)]);
pub(super) const FORCE_PER_WIDTH: &Unit = &Unit::new("N/m", Some("ForcePerWidth"), [1, 0, -2, 0]);
pub(super) const MOMENT_PER_WIDTH: &Unit = &Unit::new("N", Some("MomentPerWidth"), [1, 1, -2, 0]);
pub(super) const INERTIA_PER_WIDTH: &Unit = &Unit::new("kg.m", None, [1, 1, 0, 0]);
pub(super) const MASS_PER_WIDTH: &Unit = &Unit::new("kg/m", Some("MassPerWidth"), [1, -1, 0, 0]);
pub(super) const MASS_FLOW_PER_WIDTH: &Unit =
    &Unit::new("kg/(m.s)", Some("MassFlowPerWidth"), [1, -1, -1, 0]);
pub(super) const PRESSURE: &Unit = &Unit::new("Pa", Some("Pressure"), [1, -1, -2, 0]);

pub(super) const fn dependent(mask: u64) -> Dependencies {
    Dependencies::dependent(mask)
}

/// A mode that a configuration does not have stays at rest: the factor is fixed, not constant.
pub(super) const fn fixed(mask: u64) -> Dependencies {
    Dependencies::fixed(mask)
}

pub(super) const fn constant(mask: u64) -> Dependencies {
    Dependencies::constant(mask)
}

// Bits of the dependency masks: states, then inputs (controls, then gusts).
pub(super) const V: u64 = 1 << vehicle::V;
pub(super) const H: u64 = 1 << vehicle::H;
pub(super) const GAMMA: u64 = 1 << vehicle::GAMMA;
pub(super) const ALPHA: u64 = 1 << vehicle::ALPHA;
pub(super) const Q: u64 = 1 << vehicle::Q;
pub(super) const FUEL: u64 = 1 << vehicle::FUEL;
pub(super) const DELTA_E: u64 = 1 << (STATES + vehicle::DELTA_E);
pub(super) const PHI: u64 = 1 << (STATES + vehicle::PHI);
pub(super) const W_GUST: u64 = 1 << (STATES + CONTROLS + vehicle::W_GUST);
pub(super) const U_GUST: u64 = 1 << (STATES + CONTROLS + vehicle::U_GUST);
pub(super) const GUST: u64 = W_GUST | U_GUST;
pub(super) const ETAS: u64 = 1 << eta(0) | 1 << eta(1) | 1 << eta(2) | 1 << eta(3) | 1 << eta(4);
pub(super) const RATES: u64 = ETAS << 1;
pub(super) const ELASTIC: u64 = ETAS | RATES;
/// Speed and incidence relative to moving air.
pub(super) const STREAM: u64 = V | GAMMA | ALPHA | GUST;
/// What the air at the engine's inlet depends on; on the pitch rate if its terms count.
pub(super) const INLET: u64 = STREAM | H | Q | ELASTIC | FUEL;
/// What the aerodynamic forces depend on; on the fuel ratio through the plume under the aft-body.
pub(super) const AERODYNAMIC: u64 = INLET | DELTA_E | PHI;

/// A row. Its constructors are those of [`Variable`]; the ones below add the nominal value or the range.
pub(super) type Row = Variable<Setup>;

pub(super) const fn output_state(
    number: usize,
    name: &'static str,
    unit: &'static Unit,
    description: &'static str,
) -> Row {
    Variable::output_state(number, name, unit, description).with_nominal(NOMINAL[number])
}

pub(super) const fn local_state(
    number: usize,
    name: &'static str,
    unit: &'static Unit,
    description: &'static str,
) -> Row {
    Variable::local_state(number, name, unit, description).with_nominal(NOMINAL[number])
}

pub(super) const fn parameter(
    name: &'static str,
    kind: Kind,
    range: Option<[f64; 2]>,
    description: &'static str,
    get: fn(&Setup) -> f64,
    set: fn(&mut Setup, f64),
) -> Row {
    Variable { range, ..Variable::parameter(name, kind, description, get, set) }
}

pub(super) const CONFIGURATION: Kind = Kind::Enumeration(
    "Configuration",
    &[
        ("Rigid", 1, "Rigid body, 5 states"),
        ("EvenMassBeam", 2, "Flexible beam, mass spread evenly, 11 states"),
        ("SloshBeam", 3, "Flexible beam with sloshing propellant, 15 states"),
    ],
);
pub(super) const AERO_SETS: Items = &[
    (
        "xu2015",
        1,
        "parker2007 moved as little as possible towards Tables 2 and 3 of Xu, Huang, Cai 2015",
    ),
    ("parker2007", 2, "Published rigid-body fits, derived elastic terms"),
    ("shock_expansion", 3, "Fits of the first-principles air and engine model"),
    ("own", 4, "Coefficients of the user, in the resources of this FMU"),
];
pub(super) const AERO: Kind = Kind::Enumeration("Aero", AERO_SETS);

/// The last one only where there is one.
pub(super) fn aero_sets(setup: &Setup) -> Items {
    &AERO_SETS[..AERO_SETS.len() - usize::from(setup.data().own.is_none())]
}

pub(super) const INPUT_MODE: Kind = Kind::Enumeration(
    "InputMode",
    &[
        ("DeviationFromTrim", 1, "Inputs are added to the trim controls"),
        ("Absolute", 2, "Inputs are the controls themselves"),
    ],
);
