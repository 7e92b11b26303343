//! What `fmi2DoStep` accepts, refuses and discards.

use super::{Api, Slave};
use crate::master::Api as _;
use fmi_model::status::Status;

#[test]
fn senseless_steps_are_refused_and_change_nothing() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
    let before = slave.bits();
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    let refused = [
        (0.01, 0.0, "communicationStepSize = 0"),
        (0.01, -0.01, "communicationStepSize = -0.01"),
        (0.01, nan, "communicationStepSize = NaN"),
        (0.01, infinity, "communicationStepSize = inf"),
        (nan, 0.01, "currentCommunicationPoint = NaN"),
        (infinity, 0.01, "currentCommunicationPoint = inf"),
        (0.0, 0.01, "currentCommunicationPoint = 0"),
        (0.02, 0.01, "currentCommunicationPoint = 0.02"),
        (f64::MAX, 0.01, "currentCommunicationPoint = 1.7976931348623157e308 s"),
        (0.02, 5e-324, "communicationStepSize = 5e-324 s do not continue"),
        (0.01, f64::MAX, "a positive number up to 1e30"),
    ];
    for (point, step, reason) in refused {
        slave.refuses(Status::Error, &[reason], |slave| slave.step(point, step));
        assert_eq!(slave.time(), 0.01);
        assert_eq!(slave.bits(), before);
    }
    assert_eq!(slave.step(0.01, 0.01), Status::Ok);
}

#[test]
fn rounding_in_the_communication_point_is_accepted_and_the_step_ends_exactly_at_its_end() {
    let api = Api::load();
    let (added, multiplied) = (Slave::flying(&api), Slave::flying(&api));
    let step = 0.001;
    let mut point = 0.0;
    for i in 0..1000 {
        assert_eq!(added.step(point, step), Status::Ok);
        point += step;
        assert_eq!(added.time(), point);
        let point = f64::from(i) * step;
        assert_eq!(multiplied.step(point, step), Status::Ok);
        assert_eq!(multiplied.time(), point + step);
    }
}

/// `round(t, 9)` in Python.
fn rounded(t: f64) -> f64 {
    format!("{t:.9}").parse().unwrap()
}

#[test]
fn points_rounded_by_the_master_are_the_same_instant_and_nothing_drifts_for_it() {
    let api = Api::load();
    for (rate, steps) in [(60_i32, 60), (60_000, 100_000)] {
        let step = 1.0 / f64::from(rate);
        let (round, exact) = (Slave::flying(&api), Slave::flying(&api));
        for i in 0..steps {
            let point = rounded(f64::from(i) * step);
            assert_eq!(round.step(point, step), Status::Ok, "{:?}", round.log());
            assert_eq!(round.time(), point + step);
            assert!((round.time() - f64::from(i + 1) * step).abs() < 1e-9);
        }
        let end = round.time();
        assert_eq!(exact.step(0.0, end), Status::Ok);
        for name in ["V", "alpha", "q", "h"] {
            let (a, b) = (round.get(name), exact.get(name));
            assert!((a - b).abs() < 1e-9 * (1e-3 + b.abs()), "{rate} Hz: {name} {a} {b}");
        }
    }
}

#[test]
fn a_point_a_millionth_of_the_step_off_is_accepted_early_or_late_and_a_thousandth_is_not() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let mut time = 0.0;
    for (off, step) in [(3e-12, 1e-3), (-3e-12, 1e-3), (1e-6, 1.0), (-1e-6, 1.0), (1e-9, 1e-5)] {
        let point = time + 0.99 * off;
        assert_eq!(slave.step(point, step), Status::Ok, "{off} {:?}", slave.log());
        assert_eq!(slave.time(), point + step);
        time = point + step;
        for point in [time + 1e-3 * step + 2e-9, time - 1e-3 * step - 2e-9] {
            slave.refuses(Status::Error, &["do not continue"], |slave| slave.step(point, step));
        }
    }
    // A whole step is no rounding.
    slave.refuses(Status::Error, &["do not continue"], |slave| slave.step(time - 1e-10, 1e-10));
}

#[test]
fn the_stop_time_is_an_end_but_for_rounding() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
    assert_eq!(slave.begin_with(None, 0.0, Some(0.3)), Status::Ok);
    assert_eq!(slave.exit(), Status::Ok);
    assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    slave.refuses(Status::Error, &["stop time 0.3 s"], |slave| slave.step(0.1, 0.25));
    assert_eq!(slave.step(0.1, 0.1), Status::Ok);
    let end = 0.2 + 0.1;
    assert!(end > 0.3, "this addition rounds up");
    assert_eq!(slave.step(0.2, 0.1), Status::Ok);
    assert_eq!(slave.time(), end);
    assert_eq!(slave.step(end, 0.1), Status::Error);
}

#[test]
fn steps_far_below_the_resolution_of_time_do_nothing_and_are_fine() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    assert_eq!(slave.step(0.0, 1.0), Status::Ok);
    let before = slave.bits();
    assert_eq!(slave.step(1.0, 1e-300), Status::Ok);
    assert_eq!(slave.bits(), before);
    assert_eq!(slave.time(), 1.0);
    assert_eq!(slave.step(1.0, f64::EPSILON), Status::Ok);
    assert_eq!(slave.time(), 1.0 + f64::EPSILON);
}

#[test]
fn leaving_the_envelope_ends_the_flight_at_the_last_valid_instant() {
    let api = Api::load();
    let slave = Slave::with_logging(&api, true);
    slave.start();
    slave.log();
    let point = slave.leave_envelope();
    let record = slave.message();
    assert_eq!((record.status, record.category.as_str()), (Status::Discard, "logStatusDiscard"));
    assert!(record.message.contains("reached the edge of its valid range"), "{}", record.message);
    let time = slave.time();
    assert!(time >= point && time < point + 0.0625, "{time}");
    let last = slave.bits();
    slave.refuses(Status::Error, &["not allowed in state step"], |slave| slave.step(time, 0.01));
    assert_eq!(slave.terminate(), Status::Ok);
    assert_eq!(slave.bits(), last, "the last valid values can still be read");
    assert_eq!(slave.time(), time);
}

#[test]
fn a_discarded_step_can_be_repeated_from_a_saved_state_up_to_the_last_valid_instant() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    assert_eq!(slave.set("delta_e", 0.2), Status::Ok);
    let start = slave.save();
    let stepped = slave.stepped(0.0, 20.0);
    assert!(stepped.ended);
    let time = slave.time();
    assert_eq!(stepped.time, time);
    assert_eq!(slave.load(start), Status::Ok);
    assert_eq!(slave.step(0.0, 0.999 * time), Status::Ok);
    slave.free(start);
}

#[test]
fn start_time_and_tolerance_are_honoured_and_senseless_ones_refused() {
    let api = Api::load();
    let run = |tolerance| {
        let slave = Slave::new(&api);
        assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
        assert_eq!(slave.begin_with(tolerance, -5.0, None), Status::Ok);
        assert_eq!(slave.exit(), Status::Ok);
        assert_eq!(slave.set("delta_e", 0.005), Status::Ok);
        // The start time is -5 s.
        slave.refuses(Status::Error, &["do not continue"], |slave| slave.step(0.0, 1.0));
        assert_eq!(slave.step(-5.0, 1.0), Status::Ok);
        slave.get("alpha")
    };
    let reference = run(Some(1e-12));
    let error = |tolerance| (run(tolerance) - reference).abs();
    assert!(error(Some(1e-3)) > error(Some(1e-9)), "a tighter tolerance is more exact");
    assert_eq!(run(None), run(Some(1e-8)), "the default tolerance");
    assert_eq!(run(Some(1e-300)), reference, "the tightest tolerance there is");
    assert_eq!(run(Some(1e300)), run(Some(1e-2)), "the loosest tolerance there is");

    let slave = Slave::new(&api);
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    for (tolerance, start, stop, reason) in [
        (Some(0.0), 0.0, None, "tolerance = 0"),
        (Some(-1e-6), 0.0, None, "tolerance = -0.000001"),
        (Some(nan), 0.0, None, "tolerance = NaN"),
        (Some(infinity), 0.0, None, "tolerance = inf"),
        (None, nan, None, "startTime = NaN"),
        (None, infinity, None, "startTime = inf"),
        (None, 1.0, Some(0.5), "stopTime = 0.5"),
        (None, 1.0, Some(nan), "stopTime = NaN"),
    ] {
        slave.refuses(Status::Error, &[reason], |slave| slave.begin_with(tolerance, start, stop));
    }
}
