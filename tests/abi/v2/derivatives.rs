//! Inputs that move within a step, and time derivatives of outputs.

use crate::common::fmi2::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use fmi_model::v2::sys::Status;

/// A flexible, sloshing vehicle.
const SLOSH_BEAM: i32 = 3;
/// Elevator of the manoeuvre after `t` seconds, rad, and its derivatives.
const COURSE: [f64; 4] = [0.001, 0.02, 0.1, 1.0];
const DURATION: f64 = 0.2;
/// Of an input of 0.01 rad.
const ROUNDING: f64 = 1e-15;

fn course(t: f64) -> [f64; 4] {
    let [value, first, second, third] = COURSE;
    [
        value + t * (first + t / 2.0 * (second + t / 3.0 * third)),
        first + t * (second + t / 2.0 * third),
        second + t * third,
        third,
    ]
}

fn set_derivatives(slave: &Slave, orders: &[i32], values: &[f64]) -> Status {
    let inputs = vec![reference("delta_e"); orders.len()];
    let (n, orders, values) = (orders.len(), orders.as_ptr(), values.as_ptr());
    // SAFETY: arrays of the length given.
    unsafe { (slave.api.set_input_derivatives)(slave.c, inputs.as_ptr(), n, orders, values) }
}

fn output_derivative(slave: &Slave, name: &str, order: i32) -> (Status, f64) {
    slave.output_derivative(name, order)
}

/// Pitch rate after the manoeuvre, flown in equal steps whose inputs follow the course by
/// derivatives up to an order.
fn flown(api: &Api, steps: u32, order: usize) -> f64 {
    let slave = Slave::flying_as(api, SLOSH_BEAM);
    let step = DURATION / f64::from(steps);
    for i in 0..steps {
        let point = f64::from(i) * step;
        let now = course(point);
        assert_eq!(slave.set("delta_e", now[0]), Status::Ok);
        let orders: Vec<i32> = (1..).take(order).collect();
        assert_eq!(set_derivatives(&slave, &orders, &now[1..=order]), Status::Ok);
        assert_eq!(slave.step(point, step), Status::Ok);
    }
    slave.get("q")
}

/// Default tolerance 1e-8 of a pitch rate of nominal size 0.01, amplified over the manoeuvre.
const ACCURACY: f64 = 1e-8;

#[test]
fn verif_each_derivative_raises_the_order_of_the_interpolation_by_one() {
    let api = Api::load();
    let exact = flown(&api, 1, 3);
    assert!(exact.abs() > 1e-3, "the manoeuvre moves the vehicle: q = {exact}");
    assert!((flown(&api, 7, 3) - exact).abs() < ACCURACY, "a cubic is followed exactly");
    for order in 0..3 {
        let error = |steps| (flown(&api, steps, order) - exact).abs();
        let (coarse, fine) = (error(8), error(16));
        let observed = (coarse / fine).log2();
        let expected = order as f64 + 1.0;
        assert!((observed - expected).abs() < 0.2, "{order}: {observed}, {coarse:e}, {fine:e}");
    }
}

#[test]
fn verif_an_input_and_its_slope_after_a_step_are_those_of_its_polynomial() {
    let api = Api::load();
    let t = DURATION;
    for order in 1..=3 {
        let slave = Slave::flying_as(&api, SLOSH_BEAM);
        let [mut value, mut slope] = [COURSE[0], 0.0];
        // t^k / k! and its derivative.
        let (mut term, mut factorial) = (1.0, 1.0);
        for (k, derivative) in (1..).zip(&COURSE[1..=order]) {
            slope += derivative * term / factorial;
            (term, factorial) = (term * t, factorial * f64::from(k));
            value += derivative * term / factorial;
        }
        assert_eq!(slave.set("delta_e", COURSE[0]), Status::Ok);
        let orders: Vec<i32> = (1..).take(order).collect();
        assert_eq!(set_derivatives(&slave, &orders, &COURSE[1..=order]), Status::Ok);
        assert_eq!(slave.step(0.0, t), Status::Ok);
        let found = slave.get("delta_e");
        assert!((found - value).abs() < ROUNDING, "order {order}: {found}, not {value}");
        let (status, found) = output_derivative(&slave, "delta_e_effective", 1);
        assert_eq!(status, Status::Ok);
        assert!((found - slope).abs() < ROUNDING, "order {order}: {found}, not {slope}");
    }
}

#[test]
fn derivatives_serve_one_step_and_may_come_before_or_after_the_value() {
    let api = Api::load();
    let (before, after) = (Slave::flying(&api), Slave::flying(&api));
    assert_eq!(set_derivatives(&before, &[1], &[0.1]), Status::Ok);
    assert_eq!(before.set("delta_e", 0.01), Status::Ok);
    assert_eq!(after.set("delta_e", 0.01), Status::Ok);
    assert_eq!(set_derivatives(&after, &[1], &[0.1]), Status::Ok);
    for slave in [&before, &after] {
        assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    }
    assert_eq!(before.bits(), after.bits());
    let reached = before.get("delta_e");
    assert!((reached - 0.02).abs() < 1e-16);
    assert_eq!(before.step(0.1, 0.1), Status::Ok);
    assert_eq!(before.get("delta_e"), reached, "held where the last step ended");
    assert_eq!(after.set("delta_e", reached), Status::Ok);
    assert_eq!(after.step(0.1, 0.1), Status::Ok);
    assert_eq!(before.bits(), after.bits());
}

#[test]
fn a_saved_state_remembers_how_the_inputs_go_on() {
    let api = Api::load();
    let slave = Slave::flying_as(&api, SLOSH_BEAM);
    assert_eq!(set_derivatives(&slave, &[2, 1], &[0.5, 0.1]), Status::Ok);
    let saved = slave.save();
    let bytes = slave.bytes(saved);
    slave.free(saved);
    assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    let other = Slave::new(&api);
    let (status, state) = other.state_of(&bytes);
    assert_eq!((status, other.load(state)), (Status::Ok, Status::Ok));
    other.free(state);
    assert_eq!(other.step(0.0, 0.1), Status::Ok);
    assert_eq!(slave.bits(), other.bits());
    assert_eq!(output_derivative(&slave, "lift", 1), output_derivative(&other, "lift", 1));
}

#[test]
fn verif_output_derivatives_are_the_slopes_at_the_end_of_the_step() {
    let api = Api::load();
    let ramp = 0.05;
    // Two instants this far apart, s: the slope between them errs by its square.
    let apart = 1e-4;
    let at = |end: f64| {
        let slave = Slave::flying_as(&api, SLOSH_BEAM);
        assert_eq!(set_derivatives(&slave, &[1], &[ramp]), Status::Ok);
        assert_eq!(slave.step(0.0, end), Status::Ok);
        slave
    };
    let (early, middle, late) = (at(0.1 - apart), at(0.1), at(0.1 + apart));
    for name in ["V", "gamma", "eta1", "q", "slosh1", "lift", "moment", "n_z"] {
        let slope = (late.get(name) - early.get(name)) / (2.0 * apart);
        let (status, exact) = output_derivative(&middle, name, 1);
        assert_eq!(status, Status::Ok);
        let rounding = 1e-10 * middle.get(name).abs() / apart;
        assert!((slope - exact).abs() <= 1e-4 * exact.abs() + rounding, "{name} {slope} {exact}");
    }
    let (_, elevator) = output_derivative(&middle, "delta_e_effective", 1);
    assert!((elevator - ramp).abs() < 1e-15);
}

#[test]
fn what_has_no_derivative_is_refused_by_name_and_nothing_changes() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let before = slave.bits();
    let refused = [
        (set_derivatives(&slave, &[0], &[0.1]), "delta_e"),
        (set_derivatives(&slave, &[1, 4], &[0.1, 0.1]), "orders are 1 to 3"),
        (set_derivatives(&slave, &[1], &[f64::NAN]), "NaN"),
        (set_derivatives(&slave, &[1], &[1e300]), "up to 1e30"),
        (output_derivative(&slave, "V", 2).0, "orders are 1 to 1"),
        (output_derivative(&slave, "mach0", 1).0, "mach0"),
    ];
    let log = slave.log();
    for ((status, named), record) in refused.into_iter().zip(&log) {
        assert_eq!(status, Status::Error, "{named}");
        assert!(record.message.contains(named), "{record:?}");
    }
    assert_eq!(log.len(), refused.len());
    assert_eq!(slave.bits(), before);
    assert_eq!(set_derivatives(&slave, &[1], &[1e30]), Status::Ok);
    assert_eq!(slave.step(0.0, 1e-3), Status::Ok, "a control is cut to its limit");
    assert!(slave.get("delta_e") > 1e26 && slave.get("delta_e_effective") < 0.4);
}
