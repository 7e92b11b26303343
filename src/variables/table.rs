//! The rows.

use super::words::*;
use super::{Dependencies, Kind, Variable};
use crate::data::AeroSet;
use crate::flight::{Flight, Sample};
use crate::parameters::InputMode;
use crate::vehicle::{Configuration, FASTEST_GUST, RIGID};

fn shown(flight: &Flight, read: impl FnOnce(&Sample) -> f64) -> f64 {
    flight.sample().map_or(0.0, read)
}

fn at_imu(flight: &Flight, row: usize, mode: usize) -> f64 {
    flight.vehicle().map_or(0.0, |vehicle| vehicle.airframe.imu[row][mode])
}

fn omega(flight: &Flight, mode: usize) -> f64 {
    flight.vehicle().map_or(0.0, |vehicle| vehicle.omega[mode])
}

/// All variables.
#[rustfmt::skip]
pub static TABLE: [Variable; 114] = [
    input(0, "delta_e", ANGLE, "Elevator deflection, trailing edge down positive; deviation from trim or absolute, see input_mode; acts up to its limits, see delta_e_effective", |f| f.inputs().values[0], |f, v| f.set_input(0, v)),
    input(1, "phi", ONE, "Fuel equivalence ratio; deviation from trim or absolute, see input_mode; acts up to its limits, see phi_effective", |f| f.inputs().values[1], |f, v| f.set_input(1, v)),
    output_state(0, "V", SPEED, "Airspeed; in a gust the speed against the air around it", |f| f.state()[0]),
    output_state(2, "gamma", ANGLE, "Flight-path angle", |f| f.state()[2]),
    output_state(5, "eta1", METRE, "First flexible mode, as nose deflection, up positive", |f| f.state()[5]),
    output_state(7, "eta2", METRE, "Second flexible mode, as nose deflection, up positive", |f| f.state()[7]),
    output_state(9, "eta3", METRE, "Third flexible mode, as nose deflection, up positive", |f| f.state()[9]),
    output_state(1, "h", METRE, "Altitude", |f| f.state()[1]),
    output_state(3, "alpha", ANGLE, "Angle of attack; in a gust against the flight path", |f| f.state()[3]),
    output_state(4, "q", ANGULAR_RATE, "Pitch rate", |f| f.state()[4]),
    output("theta", ANGLE, "Pitch attitude", constant(GAMMA | ALPHA), |f| shown(f, |s| s.outputs.theta)),
    output("slosh1", METRE, "Displacement of the sloshing mass in the fore tank, up positive", dependent(ETAS | FUEL), |f| shown(f, |s| s.outputs.slosh[0])),
    output("slosh2", METRE, "Displacement of the sloshing mass in the aft tank, up positive", dependent(ETAS | FUEL), |f| shown(f, |s| s.outputs.slosh[1])),
    output("lift", FORCE_PER_WIDTH, "Lift per metre of width", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.loads.lift)),
    output("drag", FORCE_PER_WIDTH, "Drag per metre of width", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.loads.drag)),
    output("thrust", FORCE_PER_WIDTH, "Thrust per metre of width", dependent(INLET | PHI), |f| shown(f, |s| s.outputs.loads.thrust)),
    output("moment", MOMENT_PER_WIDTH, "Pitching moment about the mass centre per metre of width, nose up positive", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.loads.moment)),
    output("mach", ONE, "Mach number", dependent(V | GAMMA | H | GUST), |f| shown(f, |s| s.outputs.loads.mach)),
    output("qbar", PRESSURE, "Dynamic pressure", dependent(V | GAMMA | H | GUST), |f| shown(f, |s| s.outputs.loads.qbar)),
    output("n_z", ONE, "Normal load factor at the mass centre, in g", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.n_z)),
    output("delta_e_effective", ANGLE, "Elevator deflection in effect, absolute, after saturation", dependent(DELTA_E), |f| shown(f, |s| s.control[0])),
    output("phi_effective", ONE, "Fuel equivalence ratio in effect, absolute, after saturation", dependent(PHI), |f| shown(f, |s| s.control[1])),
    parameter("configuration", CONFIGURATION, None, "Which parts of the vehicle can move", |f| f.parameters().build.configuration as i32 as f64, |f, v| f.change(|p| p.build.configuration = match v as i32 { 1 => Configuration::Rigid, 2 => Configuration::EvenMassBeam, _ => Configuration::SloshBeam })),
    parameter("aero", AERO, None, "Coefficient set", |f| f.parameters().build.aero as i32 as f64, |f, v| f.change(|p| p.build.aero = match v as i32 { 2 => AeroSet::Parker2007, 3 => AeroSet::ShockExpansion, 4 => AeroSet::Own, _ => AeroSet::Xu2015 })),
    parameter("fuel_fraction", Kind::Real(ONE), Some([0.0, 1.0]), "Propellant left", |f| f.parameters().build.fuel_fraction, |f, v| f.change(|p| p.build.fuel_fraction = v)),
    parameter("slosh_damping", Kind::Real(ONE), Some([0.0, 1.0]), "Damping ratio of the sloshing masses", |f| f.parameters().build.slosh_damping, |f, v| f.change(|p| p.build.slosh_damping = v)),
    parameter("slosh_frequency", Kind::Real(FREQUENCY), Some([0.0, 100.0]), "Frequency of the sloshing masses on their springs, 0.1 rad/s and more; 0 takes it from the geometry of the tanks", |f| f.parameters().build.slosh_frequency, |f, v| f.change(|p| p.build.slosh_frequency = v)),
    parameter("mach0", Kind::Real(ONE), Some([0.1, 30.0]), "Initial Mach number", |f| f.parameters().build.condition.mach, |f, v| f.change(|p| p.build.condition.mach = v)),
    parameter("altitude0", Kind::Real(METRE), Some([0.0, 85000.0]), "Initial altitude", |f| f.parameters().build.condition.altitude, |f, v| f.change(|p| p.build.condition.altitude = v)),
    parameter("gamma0", Kind::Real(ANGLE), Some([-1.5, 1.5]), "Initial flight-path angle", |f| f.parameters().build.condition.gamma, |f, v| f.change(|p| p.build.condition.gamma = v)),
    parameter("trim", Kind::Boolean, None, "Start in trimmed flight; false starts from alpha0, q0, eta10, eta20, eta30 with absolute inputs", |f| f64::from(f.parameters().trim), |f, v| f.change(|p| p.trim = v != 0.0)),
    parameter("alpha0", Kind::Real(ANGLE), Some([-1.5, 1.5]), "Initial angle of attack, used if trim is false", |f| f.parameters().alpha0, |f, v| f.change(|p| p.alpha0 = v)),
    parameter("q0", Kind::Real(ANGULAR_RATE), Some([-10.0, 10.0]), "Initial pitch rate, used if trim is false", |f| f.parameters().q0, |f, v| f.change(|p| p.q0 = v)),
    parameter("eta10", Kind::Real(METRE), Some([-5.0, 5.0]), "Initial eta1, used if trim is false", |f| f.parameters().eta0[0], |f, v| f.change(|p| p.eta0[0] = v)),
    parameter("eta20", Kind::Real(METRE), Some([-5.0, 5.0]), "Initial eta2, used if trim is false", |f| f.parameters().eta0[1], |f, v| f.change(|p| p.eta0[1] = v)),
    parameter("eta30", Kind::Real(METRE), Some([-5.0, 5.0]), "Initial eta3, used if trim is false", |f| f.parameters().eta0[2], |f, v| f.change(|p| p.eta0[2] = v)),
    parameter("input_mode", INPUT_MODE, None, "Meaning of delta_e and phi; always Absolute if trim is false", |f| f.parameters().input_mode as i32 as f64, |f, v| f.change(|p| p.input_mode = if v as i32 == 1 { InputMode::DeviationFromTrim } else { InputMode::Absolute })),
    calculated("alpha_trim", ANGLE, "Angle of attack in trimmed flight", |f| f.trim().map_or(0.0, |t| t.state[3])),
    calculated("delta_e_trim", ANGLE, "Elevator deflection in trimmed flight", |f| f.trim().map_or(0.0, |t| t.control[0])),
    calculated("phi_trim", ONE, "Fuel equivalence ratio in trimmed flight", |f| f.trim().map_or(0.0, |t| t.control[1])),
    calculated("omega1", FREQUENCY, "Frequency of the first flexible mode", |f| omega(f, 0)),
    calculated("omega2", FREQUENCY, "Frequency of the second flexible mode", |f| omega(f, 1)),
    calculated("omega3", FREQUENCY, "Frequency of the third flexible mode", |f| omega(f, 2)),
    calculated("omega_slosh1", FREQUENCY, "Frequency of the first slosh mode", |f| omega(f, 3)),
    calculated("omega_slosh2", FREQUENCY, "Frequency of the second slosh mode", |f| omega(f, 4)),
    local_state(6, "eta1_dot", SPEED, "Rate of the first flexible mode", |f| f.state()[6]),
    local_state(8, "eta2_dot", SPEED, "Rate of the second flexible mode", |f| f.state()[8]),
    local_state(10, "eta3_dot", SPEED, "Rate of the third flexible mode", |f| f.state()[10]),
    local_state(11, "eta_slosh1", METRE, "First slosh mode, as the larger displacement of a sloshing mass", |f| f.state()[11]),
    local_state(12, "eta_slosh1_dot", SPEED, "Rate of the first slosh mode", |f| f.state()[12]),
    local_state(13, "eta_slosh2", METRE, "Second slosh mode, as the larger displacement of a sloshing mass", |f| f.state()[13]),
    local_state(14, "eta_slosh2_dot", SPEED, "Rate of the second slosh mode", |f| f.state()[14]),
    derivative(0, "der(V)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 0)),
    derivative(1, "der(h)", SPEED, dependent(V | GAMMA), |f| rate(f, 1)),
    derivative(2, "der(gamma)", ANGULAR_RATE, dependent(AERODYNAMIC), |f| rate(f, 2)),
    derivative(3, "der(alpha)", ANGULAR_RATE, dependent(AERODYNAMIC), |f| rate(f, 3)),
    derivative(4, "der(q)", ANGULAR_ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 4)),
    derivative(5, "der(eta1)", SPEED, fixed(1 << 6), |f| rate(f, 5)),
    derivative(6, "der(eta1_dot)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 6)),
    derivative(7, "der(eta2)", SPEED, fixed(1 << 8), |f| rate(f, 7)),
    derivative(8, "der(eta2_dot)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 8)),
    derivative(9, "der(eta3)", SPEED, fixed(1 << 10), |f| rate(f, 9)),
    derivative(10, "der(eta3_dot)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 10)),
    derivative(11, "der(eta_slosh1)", SPEED, fixed(1 << 12), |f| rate(f, 11)),
    derivative(12, "der(eta_slosh1_dot)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 12)),
    derivative(13, "der(eta_slosh2)", SPEED, fixed(1 << 14), |f| rate(f, 13)),
    derivative(14, "der(eta_slosh2_dot)", ACCELERATION, dependent(AERODYNAMIC), |f| rate(f, 14)),
    Variable { range: Some([-FASTEST_GUST, FASTEST_GUST]), ..input(2, "w_gust", SPEED, "Vertical velocity of the air, up positive; the same along the vehicle; acts up to its range where derivatives lead beyond", |f| f.inputs().values[2], |f, v| f.set_input(2, v)) },
    output_state(15, "fuel_mass", MASS_PER_WIDTH, "Fuel on board, without what cannot be drained, per metre of width", |f| f.state()[15]),
    derivative(15, "der(fuel_mass)", MASS_FLOW_PER_WIDTH, dependent(INLET | PHI), |f| rate(f, 15)),
    parameter("fuel_burn", Kind::Boolean, None, "Fuel burns in flight; false keeps fuel_mass, and with it mass and modes, as they are at the start", |f| f64::from(f.parameters().build.fuel_burn), |f, v| f.change(|p| p.build.fuel_burn = v != 0.0)),
    parameter("imu_station", Kind::Real(METRE), Some([0.0, 1000.0]), "Station of the inertial measurement unit, aft of the nose; on the body", |f| f.parameters().build.stations.imu, |f, v| f.change(|p| p.build.stations.imu = v)),
    parameter("probe_station", Kind::Real(METRE), Some([0.0, 1000.0]), "Station of the incidence vane, aft of the nose; on the body", |f| f.parameters().build.stations.probe, |f, v| f.change(|p| p.build.stations.probe = v)),
    output("theta_imu", ANGLE, "Pitch attitude of the bent body at the IMU", Dependencies { constant: GAMMA | ALPHA, ..dependent(ETAS | FUEL) }, |f| shown(f, |s| s.outputs.imu.theta)),
    output("q_imu", ANGULAR_RATE, "Pitch rate of the bent body at the IMU", Dependencies { constant: Q, ..dependent(RATES | FUEL) }, |f| shown(f, |s| s.outputs.imu.q)),
    output("gamma_imu", ANGLE, "Flight-path angle of the IMU, which moves with the bent body", Dependencies { constant: GAMMA, ..dependent(V | ALPHA | Q | ELASTIC | FUEL) }, |f| shown(f, |s| s.outputs.imu.gamma)),
    output("n_z_imu", ONE, "Load factor at the IMU across the bent axis, up positive, in g, with the accelerations of pitch and modes", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.imu.n_z)),
    output("n_x_imu", ONE, "Load factor at the IMU along the bent axis, forward positive, in g, with the accelerations of pitch and modes", dependent(AERODYNAMIC), |f| shown(f, |s| s.outputs.imu.n_x)),
    output("alpha_probe", ANGLE, "Incidence that a vane at the probe's station sees: bending, pitch rate and gust included", dependent(STREAM | Q | ELASTIC | FUEL), |f| shown(f, |s| s.outputs.alpha_probe)),
    calculated("shape1_imu", ONE, "Displacement of the first flexible mode at the IMU per nose deflection", |f| at_imu(f, 0, 0)),
    calculated("shape2_imu", ONE, "Displacement of the second flexible mode at the IMU per nose deflection", |f| at_imu(f, 0, 1)),
    calculated("shape3_imu", ONE, "Displacement of the third flexible mode at the IMU per nose deflection", |f| at_imu(f, 0, 2)),
    calculated("slope1_imu", SLOPE, "Slope of the first flexible mode at the IMU per nose deflection, nose-down positive", |f| at_imu(f, 1, 0)),
    calculated("slope2_imu", SLOPE, "Slope of the second flexible mode at the IMU per nose deflection, nose-down positive", |f| at_imu(f, 1, 1)),
    calculated("slope3_imu", SLOPE, "Slope of the third flexible mode at the IMU per nose deflection, nose-down positive", |f| at_imu(f, 1, 2)),
    calculated("mass_centre", METRE, "Station of the mass centre at the start, aft of the nose", |f| f.vehicle().map_or(0.0, |v| v.airframe.mass_centre)),
    calculated("pitch_inertia", INERTIA_PER_WIDTH, "Pitch inertia about the mass centre at the start, per metre of width", |f| f.vehicle().map_or(0.0, |v| v.airframe.inertia)),
    parameter("mass_factor", Kind::Real(ONE), Some([0.5, 2.0]), "Uncertainty: factor on the density of structure and propellant; the pitch inertia stays", |f| f.parameters().build.factors.mass, |f, v| f.change(|p| p.build.factors.mass = v)),
    parameter("inertia_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the pitch inertia", |f| f.parameters().build.factors.inertia, |f, v| f.change(|p| p.build.factors.inertia = v)),
    parameter("density_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the density of the air", |f| f.parameters().build.factors.density, |f, v| f.change(|p| p.build.factors.density = v)),
    parameter("lift_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the lift without the elevator", |f| f.parameters().build.factors.lift, |f, v| f.change(|p| p.build.factors.lift = v)),
    parameter("drag_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the drag without the elevator", |f| f.parameters().build.factors.drag, |f, v| f.change(|p| p.build.factors.drag = v)),
    parameter("moment_alpha_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the pitching moment due to incidence", |f| f.parameters().build.factors.moment_alpha, |f, v| f.change(|p| p.build.factors.moment_alpha = v)),
    parameter("elevator_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the lift, drag and moment due to the elevator", |f| f.parameters().build.factors.elevator, |f, v| f.change(|p| p.build.factors.elevator = v)),
    parameter("thrust_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the thrust", |f| f.parameters().build.factors.thrust, |f, v| f.change(|p| p.build.factors.thrust = v)),
    parameter("elastic_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on what the air answers to bending", |f| f.parameters().build.factors.elastic, |f, v| f.change(|p| p.build.factors.elastic = v)),
    parameter("stiffness_factor", Kind::Real(ONE), Some([0.1, 1000.0]), "Uncertainty: factor on the bending stiffness of the beam", |f| f.parameters().build.factors.stiffness, |f, v| f.change(|p| p.build.factors.stiffness = v)),
    parameter("structural_damping_factor", Kind::Real(ONE), Some([0.1, 10.0]), "Uncertainty: factor on the damping ratios of the structure", |f| f.parameters().build.factors.structural_damping, |f, v| f.change(|p| p.build.factors.structural_damping = v)),
    parameter("mass_centre_shift", Kind::Real(METRE), Some([-3.0, 3.0]), "Uncertainty: added to the station of the mass centre, aft positive", |f| f.parameters().build.factors.mass_centre_shift_m, |f, v| f.change(|p| p.build.factors.mass_centre_shift_m = v)),
    parameter("pitch_rate_factor", Kind::Real(ONE), Some([0.0, 10.0]), "Part of the strip theory's terms in the pitch rate that counts: 0 as printed in eq. (4), 1 all", |f| f.parameters().build.factors.pitch_rate, |f, v| f.change(|p| p.build.factors.pitch_rate = v)),
    parameter("alpha_offset", Kind::Real(ANGLE), Some([-1.5, 1.5]), "Added to the initial angle of attack", |f| f.parameters().offsets.alpha, |f, v| f.change(|p| p.offsets.alpha = v)),
    parameter("q_offset", Kind::Real(ANGULAR_RATE), Some([-10.0, 10.0]), "Added to the initial pitch rate", |f| f.parameters().offsets.q, |f, v| f.change(|p| p.offsets.q = v)),
    parameter("eta1_offset", Kind::Real(METRE), Some([-5.0, 5.0]), "Added to the initial eta1", |f| f.parameters().offsets.displacement[0], |f, v| f.change(|p| p.offsets.displacement[0] = v)),
    parameter("eta2_offset", Kind::Real(METRE), Some([-5.0, 5.0]), "Added to the initial eta2", |f| f.parameters().offsets.displacement[1], |f, v| f.change(|p| p.offsets.displacement[1] = v)),
    parameter("eta3_offset", Kind::Real(METRE), Some([-5.0, 5.0]), "Added to the initial eta3", |f| f.parameters().offsets.displacement[2], |f, v| f.change(|p| p.offsets.displacement[2] = v)),
    parameter("eta1_dot_offset", Kind::Real(SPEED), Some([-500.0, 500.0]), "Added to the initial rate of eta1", |f| f.parameters().offsets.rate[0], |f, v| f.change(|p| p.offsets.rate[0] = v)),
    parameter("eta2_dot_offset", Kind::Real(SPEED), Some([-500.0, 500.0]), "Added to the initial rate of eta2", |f| f.parameters().offsets.rate[1], |f, v| f.change(|p| p.offsets.rate[1] = v)),
    parameter("eta3_dot_offset", Kind::Real(SPEED), Some([-500.0, 500.0]), "Added to the initial rate of eta3", |f| f.parameters().offsets.rate[2], |f, v| f.change(|p| p.offsets.rate[2] = v)),
    parameter("slosh1_offset", Kind::Real(METRE), Some([-5.0, 5.0]), "Added to the initial slosh1; the flexible modes stay", |f| f.parameters().offsets.displacement[3], |f, v| f.change(|p| p.offsets.displacement[3] = v)),
    parameter("slosh2_offset", Kind::Real(METRE), Some([-5.0, 5.0]), "Added to the initial slosh2; the flexible modes stay", |f| f.parameters().offsets.displacement[4], |f, v| f.change(|p| p.offsets.displacement[4] = v)),
    parameter("slosh1_dot_offset", Kind::Real(SPEED), Some([-50.0, 50.0]), "Added to the initial rate of slosh1; the flexible modes stay", |f| f.parameters().offsets.rate[3], |f, v| f.change(|p| p.offsets.rate[3] = v)),
    parameter("slosh2_dot_offset", Kind::Real(SPEED), Some([-50.0, 50.0]), "Added to the initial rate of slosh2; the flexible modes stay", |f| f.parameters().offsets.rate[4], |f, v| f.change(|p| p.offsets.rate[4] = v)),
    Variable { range: Some([-FASTEST_GUST, FASTEST_GUST]), ..input(3, "u_gust", SPEED, "Horizontal velocity of the air along the flight direction, tail wind positive; the same along the vehicle; acts up to its range where derivatives lead beyond", |f| f.inputs().values[3], |f, v| f.set_input(3, v)) },
    output("choking_margin", ONE, "Fuel equivalence ratio that can still be added before the burner chokes; below 0 the thrust is not to be believed", dependent(INLET | PHI), |f| shown(f, |s| s.outputs.choking_margin)),
];

fn rate(flight: &Flight, state: usize) -> f64 {
    shown(flight, |sample| sample.derivatives[state])
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    if a.len() != b.len() {
        return false;
    }
    let mut i = 0;
    while i < a.len() {
        if a[i] != b[i] {
            return false;
        }
        i += 1;
    }
    true
}

const fn names_are_distinct() -> bool {
    let mut i = 0;
    while i < TABLE.len() {
        let mut k = i + 1;
        while k < TABLE.len() {
            if same(TABLE[i].name, TABLE[k].name) {
                return false;
            }
            k += 1;
        }
        i += 1;
    }
    true
}

const _: () = assert!(names_are_distinct(), "two variables have the same name");
const _: () = assert!(RIGID == 5, "the masks above number the states");
