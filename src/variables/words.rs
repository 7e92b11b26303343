//! The words in which the rows of the table are said: units, dependencies, constructors, enumerations.

use super::{Dependencies, Kind, Role, Unit, Variable};
use crate::data::OWN;
use crate::flight::Flight;
use crate::vehicle::STATES;

pub(super) const fn unit(name: &'static str, base: [i32; 4]) -> Unit {
    Unit { name, base, display: None }
}

/// Degrees per radian.
pub(super) const DEGREES: f64 = 180.0 / core::f64::consts::PI;

pub(super) const ONE: Unit = unit("1", [0, 0, 0, 0]);
pub(super) const METRE: Unit = unit("m", [0, 1, 0, 0]);
/// Slope per deflection: an angle over a length.
pub(super) const SLOPE: Unit = unit("rad/m", [0, -1, 0, 1]);
pub(super) const SPEED: Unit = unit("m/s", [0, 1, -1, 0]);
pub(super) const ACCELERATION: Unit = unit("m/s2", [0, 1, -2, 0]);
pub(super) const ANGLE: Unit =
    Unit { name: "rad", base: [0, 0, 0, 1], display: Some(("deg", DEGREES)) };
pub(super) const ANGULAR_RATE: Unit =
    Unit { name: "rad/s", base: [0, 0, -1, 1], display: Some(("deg/s", DEGREES)) };
pub(super) const ANGULAR_ACCELERATION: Unit = unit("rad/s2", [0, 0, -2, 1]);
/// Frequencies share the dimension of an angular rate but are not shown in degrees.
pub(super) const FREQUENCY: Unit = unit("rad/s", [0, 0, -1, 1]);
pub(super) const FORCE_PER_WIDTH: Unit = unit("N/m", [1, 0, -2, 0]);
pub(super) const MOMENT_PER_WIDTH: Unit = unit("N", [1, 1, -2, 0]);
pub(super) const INERTIA_PER_WIDTH: Unit = unit("kg.m", [1, 1, 0, 0]);
pub(super) const MASS_PER_WIDTH: Unit = unit("kg/m", [1, -1, 0, 0]);
pub(super) const MASS_FLOW_PER_WIDTH: Unit = unit("kg/(m.s)", [1, -1, -1, 0]);
pub(super) const PRESSURE: Unit = unit("Pa", [1, -1, -2, 0]);

pub(super) const NONE: Dependencies = Dependencies { dependent: 0, fixed: 0, constant: 0 };

pub(super) const fn dependent(mask: u32) -> Dependencies {
    Dependencies { dependent: mask, ..NONE }
}

/// A mode that a configuration does not have stays at rest: the factor is fixed, not constant.
pub(super) const fn fixed(mask: u32) -> Dependencies {
    Dependencies { fixed: mask, ..NONE }
}

pub(super) const fn constant(mask: u32) -> Dependencies {
    Dependencies { constant: mask, ..NONE }
}

pub(super) const V: u32 = 1 << 0;
pub(super) const H: u32 = 1 << 1;
pub(super) const GAMMA: u32 = 1 << 2;
pub(super) const ALPHA: u32 = 1 << 3;
pub(super) const Q: u32 = 1 << 4;
pub(super) const FUEL: u32 = 1 << 15;
pub(super) const DELTA_E: u32 = 1 << STATES;
pub(super) const PHI: u32 = 1 << (STATES + 1);
pub(super) const W_GUST: u32 = 1 << (STATES + 2);
pub(super) const U_GUST: u32 = 1 << (STATES + 3);
pub(super) const GUST: u32 = W_GUST | U_GUST;
pub(super) const ETAS: u32 = 1 << 5 | 1 << 7 | 1 << 9 | 1 << 11 | 1 << 13;
pub(super) const RATES: u32 = ETAS << 1;
pub(super) const ELASTIC: u32 = ETAS | RATES;
/// Speed and incidence relative to moving air.
pub(super) const STREAM: u32 = V | GAMMA | ALPHA | GUST;
/// What the air at the engine's inlet depends on; on the pitch rate if its terms count.
pub(super) const INLET: u32 = STREAM | H | Q | ELASTIC | FUEL;
/// What the aerodynamic forces depend on; on the fuel ratio through the plume under the aft-body.
pub(super) const AERODYNAMIC: u32 = INLET | DELTA_E | PHI;

pub(super) const ROW: Variable = Variable {
    name: "",
    description: "",
    kind: Kind::Real(ONE),
    role: Role::Output,
    range: None,
    dependencies: NONE,
    get: |_| 0.0,
    set: None,
};

pub(super) const fn input(
    index: usize,
    name: &'static str,
    unit: Unit,
    description: &'static str,
    get: fn(&Flight) -> f64,
    set: fn(&mut Flight, f64),
) -> Variable {
    Variable {
        name,
        description,
        kind: Kind::Real(unit),
        role: Role::Input(index),
        get,
        set: Some(set),
        ..ROW
    }
}

pub(super) const fn output(
    name: &'static str,
    unit: Unit,
    description: &'static str,
    dependencies: Dependencies,
    get: fn(&Flight) -> f64,
) -> Variable {
    Variable { name, description, kind: Kind::Real(unit), dependencies, get, ..ROW }
}

pub(super) const fn output_state(
    index: usize,
    name: &'static str,
    unit: Unit,
    description: &'static str,
    get: fn(&Flight) -> f64,
) -> Variable {
    let dependencies = constant(1 << index);
    let kind = Kind::Real(unit);
    Variable { name, description, kind, role: Role::OutputState(index), dependencies, get, ..ROW }
}

pub(super) const fn local_state(
    index: usize,
    name: &'static str,
    unit: Unit,
    description: &'static str,
    get: fn(&Flight) -> f64,
) -> Variable {
    let kind = Kind::Real(unit);
    Variable { name, description, kind, role: Role::LocalState(index), get, ..ROW }
}

pub(super) const fn derivative(
    index: usize,
    name: &'static str,
    unit: Unit,
    dependencies: Dependencies,
    get: fn(&Flight) -> f64,
) -> Variable {
    Variable {
        name,
        description: "Time derivative of the state",
        kind: Kind::Real(unit),
        role: Role::Derivative(index),
        dependencies,
        get,
        ..ROW
    }
}

pub(super) const fn parameter(
    name: &'static str,
    kind: Kind,
    range: Option<[f64; 2]>,
    description: &'static str,
    get: fn(&Flight) -> f64,
    set: fn(&mut Flight, f64),
) -> Variable {
    Variable { name, description, kind, role: Role::Parameter, range, get, set: Some(set), ..ROW }
}

pub(super) const fn calculated(
    name: &'static str,
    unit: Unit,
    description: &'static str,
    get: fn(&Flight) -> f64,
) -> Variable {
    Variable { name, description, kind: Kind::Real(unit), role: Role::Calculated, get, ..ROW }
}

pub(super) const CONFIGURATION: Kind = Kind::Enumeration(
    "Configuration",
    &[
        ("Rigid", 1, "Rigid body, 5 states"),
        ("EvenMassBeam", 2, "Flexible beam, mass spread evenly, 11 states"),
        ("SloshBeam", 3, "Flexible beam with sloshing propellant, 15 states"),
    ],
);
pub(super) const AERO_SETS: &[(&str, i32, &str)] = &[
    (
        "xu2015",
        1,
        "parker2007 moved as little as possible towards Tables 2 and 3 of Xu, Huang, Cai 2015",
    ),
    ("parker2007", 2, "Published rigid-body fits, derived elastic terms"),
    ("shock_expansion", 3, "Fits of the first-principles air and engine model"),
    ("own", 4, "Coefficients that this FMU was built with"),
];
/// The last one only where there is one.
pub(super) const AERO: Kind =
    Kind::Enumeration("Aero", AERO_SETS.split_at(AERO_SETS.len() - OWN.is_none() as usize).0);
pub(super) const INPUT_MODE: Kind = Kind::Enumeration(
    "InputMode",
    &[
        ("DeviationFromTrim", 1, "Inputs are added to the trim controls"),
        ("Absolute", 2, "Inputs are the controls themselves"),
    ],
);
