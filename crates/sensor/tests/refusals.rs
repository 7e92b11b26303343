//! What a sensor refuses, and how it says so.

#[path = "../../fmi/tests/flight/mod.rs"]
mod flight;

use ahv_sensor::Sensor;
use flight::{heard, set, start, started, step_to};
use fmi_model::instance::{Instance, Interface};

#[test]
fn bad_values_are_refused_by_name_value_and_limit() {
    let mut sensor: Instance<Sensor> = Instance::new(Interface::CoSimulation, false).unwrap();
    for (name, value, said) in [
        ("lag", -1.0, "lag = -1 is refused: the range is [0, 1000000]"),
        ("lag", f64::NAN, "lag = NaN is refused: a finite number is needed"),
        ("scale", f64::INFINITY, "scale = inf is refused: a finite number is needed"),
        ("bias", f64::NAN, "bias = NaN is refused: a finite number is needed"),
        ("noise", -0.1, "noise = -0.1 is refused: the range is [0, 1e9]"),
        ("period", -0.01, "period = -0.01 is refused: the range is [0, 1000000]"),
        ("quantum", -1e-3, "quantum = -0.001 is refused: the range is [0, 1e9]"),
        ("failure_time", f64::NAN, "failure_time = NaN is refused: a finite number is needed"),
        ("failure_value", 2e9, "failure_value = 2e9 is refused: the range is [-1e9, 1e9]"),
        ("failure", 7.0, "failure = 7 is refused: choose one of 1 None, 2 Stuck"),
        ("u", f64::NAN, "u = NaN is refused: a finite number is needed"),
        ("y", 1.0, "y = 1 is refused: only inputs and parameters can be set"),
    ] {
        let refused = set(&mut sensor, &[(name, value)]).unwrap_err().to_string();
        assert!(refused.starts_with(said), "{refused}");
    }
}

#[test]
fn noise_without_a_sampling_period_is_refused() {
    let refused = start::<Sensor>(&[("noise", 0.1)], 0.0).unwrap_err().to_string();
    assert_eq!(
        refused,
        "noise = 0.1 with period = 0 is refused: noise is drawn for each sample; set period to the \
         sampling period, or noise to 0"
    );
}

#[test]
fn a_period_that_no_clock_resolves_is_refused() {
    let refused = start::<Sensor>(&[("period", 1e-12)], 0.0).unwrap_err().to_string();
    assert!(refused.starts_with("period = 0.000000000001 s is refused: 0 "), "{refused}");
    let mut sensor = started::<Sensor>(&[("period", 1e-9)]);
    let refused = sensor.do_step(0.0, 1e7).unwrap_err().to_string();
    assert!(refused.starts_with("the step to 10000000 s is refused: more than 1e15 "), "{refused}");
}

#[test]
fn what_has_no_effect_and_a_failure_are_said_once() {
    let values = [("seed", 3.0), ("failure_time", 1.0), ("failure_value", 1.0)];
    let said = heard(&mut started::<Sensor>(&values));
    for name in ["seed", "failure_time", "failure_value"] {
        assert!(
            said.iter().any(|text| text.contains(&format!("{name} has no effect"))),
            "{name}: {said:?}"
        );
    }
    let mut sensor = started::<Sensor>(&[("failure", 3.0), ("failure_time", 0.5)]);
    for i in 1..=9 {
        step_to(&mut sensor, 0.1 * f64::from(i));
    }
    let said = heard(&mut sensor);
    let failures = said.iter().filter(|text| text.contains("the sensor fails from 0.5 s on: Zero"));
    assert_eq!(failures.count(), 1, "{said:?}");
}
