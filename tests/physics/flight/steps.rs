//! A flight does not depend on the communication step, nor on when it starts.

use crate::model::{CONFIGURATIONS, distance, flight, setup};
use ahv::error::Error;
use ahv::flight::Flight;
use ahv::vehicle::{Configuration, DELTA_E, PHI, State};

/// Flies the default doublet-like input over the given communication points up to 0.5 s.
fn fly(mut flight: Flight, points: impl Iterator<Item = f64>) -> State {
    flight.set_input(DELTA_E, 2e-3);
    for t in points {
        flight.advance(t).expect("a small elevator step stays in the envelope");
        assert_eq!(flight.time(), t);
    }
    *flight.state()
}

#[test]
fn verif_the_communication_step_changes_nothing_beyond_the_tolerance() {
    for configuration in CONFIGURATIONS {
        let one = fly(flight(configuration), [0.5].into_iter());
        for steps in [7, 50, 100, 1000] {
            let many = (1..=steps).map(|i| 0.5 * f64::from(i) / f64::from(steps));
            let other = fly(flight(configuration), many);
            assert!(
                distance(&one, &other) < 1e-7,
                "{configuration:?}, {steps} steps: {:e}",
                distance(&one, &other)
            );
        }
    }
}

#[test]
fn verif_a_million_steps_do_not_drift() {
    // Level flight in trim: nothing may happen, and the clock may not slip. The rigid phugoid is
    // neutral and the unstable short period grows from rounding, so the steps are short: 1 s in all.
    let mut flight = flight(Configuration::Rigid);
    let start = *flight.state();
    for step in 1..=1_000_000_u32 {
        flight.advance(f64::from(step) * 1e-6).unwrap();
    }
    assert_eq!(flight.time(), 1.0);
    assert!(distance(flight.state(), &start) < 1e-10, "{:e}", distance(flight.state(), &start));
}

#[test]
fn verif_a_late_start_costs_no_digits() {
    let fly = |start: f64| {
        let mut flight = setup(&[]).start(start, 1e-8).unwrap();
        flight.set_input(DELTA_E, 2e-3);
        flight.advance(start + 0.5).unwrap();
        *flight.state()
    };
    let now = fly(0.0);
    for start in [1e6, 1e9, 1e12] {
        // Half a second is exact in all of these.
        assert_eq!(fly(start), now, "from {start} s");
    }
}

#[test]
fn verif_a_long_interval_that_leaves_the_envelope_says_so() {
    for length in [1e2, 1e4, 1e8] {
        let mut flight = flight(Configuration::SloshBeam);
        flight.set_input(DELTA_E, 2e-3);
        let error = flight.advance(length).unwrap_err();
        assert!(matches!(error, Error::Envelope { .. }), "{length} s: {error}");
        assert!(flight.time() < 20.0);
    }
}

#[test]
fn verif_an_input_that_meets_a_limit_within_a_step_acts_at_it_from_then_on() {
    const STEP_S: f64 = 0.05;
    for percent in [1, 10, 30, 50, 70, 90, 95, 98, 99] {
        let at = STEP_S * f64::from(percent) / 100.0;
        let start = || {
            let mut flight = flight(Configuration::SloshBeam);
            let least = -flight.trim().control[PHI];
            flight.set_input_derivative(PHI, 1, least / at);
            (flight, least)
        };
        let (mut one, _) = start();
        one.advance(STEP_S).unwrap();
        let (mut two, least) = start();
        two.advance(at).unwrap();
        two.set_input(PHI, least);
        two.advance(STEP_S).unwrap();
        let off = distance(one.state(), two.state());
        assert!(off < 1e-7, "at {percent} %: {off:e}");
    }
}
