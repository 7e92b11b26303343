//! Lag, samples and failures: closed forms, whatever the communication step, and through a saved state.

#[path = "../../fmi/tests/flight/mod.rs"]
mod flight;

use ahv_sensor::Sensor;
use ahv_sensor::noise::normal;
use flight::{begin, forged, input, moved, set, start, step_to, y};
use fmi_model::instance::Instance;
use proptest::prelude::*;

fn started(values: &[(&str, f64)]) -> Instance<Sensor> {
    flight::started(values)
}

const SEED: f64 = 5.0;

#[test]
fn a_sensor_with_defaults_reads_its_input_at_once() {
    let mut sensor = started(&[("u", 3.0)]);
    assert_eq!(y(&mut sensor), 3.0);
    step_to(&mut sensor, 0.1);
    set(&mut sensor, &[("u", -1.0)]).unwrap();
    assert_eq!(y(&mut sensor), -1.0);
    input(&mut sensor, -1.0, 10.0);
    step_to(&mut sensor, 0.2);
    assert!((y(&mut sensor) - 0.0).abs() < 1e-15);
}

#[test]
fn verif_scale_and_bias_act_after_the_lag() {
    let mut sensor = started(&[("u", 3.0), ("scale", -2.0), ("bias", 0.5), ("lag", 1.0)]);
    assert_eq!(y(&mut sensor), -5.5, "the lag has settled at the start");
    step_to(&mut sensor, 1.0);
    assert_eq!(y(&mut sensor), -5.5);
    set(&mut sensor, &[("u", 4.0)]).unwrap();
    step_to(&mut sensor, 2.0);
    let lagged = 4.0 - (-1.0_f64).exp();
    assert!((y(&mut sensor) - (0.5 - 2.0 * lagged)).abs() < 1e-15 * 8.0);
}

/// x = u - slope tau + (x0 - u0 + slope tau) exp(-t / tau).
#[test]
fn verif_lag_is_exact_for_inputs_that_move() {
    for (lag, step) in [(0.1, 0.01), (0.1, 3.0), (1e-3, 1.0), (100.0, 0.1), (1e-300, 1.0)] {
        let mut sensor = started(&[("u", 1.0), ("lag", lag)]);
        for (value, slope) in [(1.0, 2.0), (-0.5, 0.0), (0.25, -1.0)] {
            let (before, time) = (y(&mut sensor), sensor.time());
            input(&mut sensor, value, slope);
            step_to(&mut sensor, time + step);
            let h = sensor.time() - time;
            let decay = (-h / lag).exp();
            let exact = value + slope * (h - lag) + (before - value + slope * lag) * decay;
            // The closed form itself loses digits where the lag is long.
            let error = (y(&mut sensor) - exact).abs();
            assert!(error < 1e-15 * (4.0 + 8.0 * lag), "{lag} {step}: {error}");
        }
    }
}

/// A sensor with all there is, but for failures.
const NOISY: [(&str, f64); 8] = [
    ("u", 0.3),
    ("lag", 0.05),
    ("scale", 1.5),
    ("bias", -0.2),
    ("period", 0.01),
    ("noise", 0.02),
    ("seed", SEED),
    ("quantum", 1e-3),
];

#[test]
fn verif_samples_are_taken_at_multiples_of_the_period_and_held() {
    let (period, noise) = (0.01, 0.5);
    for step in [0.001, 0.0025, 0.01, 0.03, 0.1, 0.0037] {
        let parameters = [("period", period), ("noise", noise), ("seed", SEED)];
        let mut sensor: Instance<Sensor> = start(&parameters, 2.0).unwrap();
        // u is the time since the start.
        for i in 1..=300 {
            let (from, to) = (step * f64::from(i - 1), step * f64::from(i));
            input(&mut sensor, from, 1.0);
            step_to(&mut sensor, 2.0 + to);
            let sample = (to / period + 1e-9).floor();
            let expected = sample * period + noise * normal(5, sample as u64);
            assert!((y(&mut sensor) - expected).abs() < 1e-12, "{step} {i}");
        }
    }
}

#[test]
fn a_sample_is_taken_with_the_input_of_its_instant() {
    let mut sensor = started(&[("u", 1.0), ("period", 0.01)]);
    step_to(&mut sensor, 0.01);
    assert_eq!(y(&mut sensor), 1.0);
    set(&mut sensor, &[("u", 2.0)]).unwrap();
    assert_eq!(y(&mut sensor), 2.0, "the time is that of the sample");
    step_to(&mut sensor, 0.015);
    set(&mut sensor, &[("u", 3.0)]).unwrap();
    assert_eq!(y(&mut sensor), 2.0, "held");
    step_to(&mut sensor, 0.02);
    assert_eq!(y(&mut sensor), 3.0);
}

#[test]
fn communication_points_that_a_master_rounded_are_the_instants_of_samples() {
    let parameters = [("period", 0.1), ("noise", 1.0), ("seed", SEED)];
    for rounded in [
        |i: u32| (0..i).fold(0.0, |sum, _| sum + 0.1),
        |i: u32| f64::from(i) * 0.1,
        |i: u32| f64::from(i) * 0.1 + 4e-10,
        |i: u32| f64::from(i) * 0.1 - 4e-10,
    ] {
        let mut sensor = started(&parameters);
        for i in 1..=1000 {
            step_to(&mut sensor, rounded(i));
            // The input of this instant, not the one that led there.
            set(&mut sensor, &[("u", f64::from(i))]).unwrap();
            assert_eq!(y(&mut sensor), f64::from(i) + normal(5, i.into()));
        }
    }
}

#[test]
fn noise_does_not_depend_on_the_length_of_a_step_however_long() {
    let mut sensor = started(&NOISY);
    step_to(&mut sensor, 1e6);
    let held = 1.5 * 0.3 - 0.2 + 0.02 * normal(5, 100_000_000);
    assert!((y(&mut sensor) - held).abs() <= 0.5001e-3);
}

#[test]
fn verif_the_output_is_the_nearest_multiple_of_the_quantum() {
    let mut sensor = started(&[("quantum", 0.25)]);
    for (u, expected) in [(0.12, 0.0), (0.13, 0.25), (-0.13, -0.25), (-0.01, 0.0)] {
        set(&mut sensor, &[("u", u)]).unwrap();
        assert_eq!(y(&mut sensor).to_bits(), f64::to_bits(expected), "{u}");
    }
    // Finer than the digits of a number: nothing to round.
    let mut sensor = started(&[("quantum", 1e-300), ("u", 0.1)]);
    assert_eq!(y(&mut sensor), 0.1);
}

#[test]
fn failures_act_from_their_time_on() {
    // number, value before, at 0.5 s, after
    for (failure, at, after) in
        [(1.0, 0.5, 0.7), (2.0, 0.5, 0.5), (3.0, 0.0, 0.0), (4.0, 2.5, 2.7), (5.0, 2.0, 2.0)]
    {
        let parameters = [("failure", failure), ("failure_time", 0.5), ("failure_value", 2.0)];
        let mut sensor = started(&parameters);
        // u is the time.
        for (end, expected) in [(0.3, 0.3), (0.5, at), (0.6, after - 0.1), (0.7, after)] {
            let time = sensor.time();
            input(&mut sensor, time, 1.0);
            step_to(&mut sensor, end);
            let moves = matches!(failure, 1.0 | 4.0);
            let expected = if end == 0.6 && !moves { after } else { expected };
            assert!((y(&mut sensor) - expected).abs() < 1e-12, "{failure} {end}");
        }
    }
}

#[test]
fn only_the_failure_asked_for_gives_a_nan() {
    let mut sensor = started(&[("u", 1.0), ("failure", 6.0), ("failure_time", 0.1)]);
    assert_eq!(y(&mut sensor), 1.0);
    step_to(&mut sensor, 0.1);
    assert!(y(&mut sensor).is_nan());
    step_to(&mut sensor, 0.2);
    assert!(y(&mut sensor).is_nan());
}

#[test]
fn a_sensor_gets_stuck_at_the_reading_of_that_instant_within_any_step() {
    let stuck = |ends: &[f64]| {
        let failing = [("failure", 2.0), ("failure_time", 0.153)];
        let mut sensor = started(&[&NOISY[..], &failing].concat());
        for &end in ends {
            step_to(&mut sensor, end);
        }
        y(&mut sensor)
    };
    let mut sound = started(&NOISY);
    step_to(&mut sound, 0.153);
    let expected = y(&mut sound);
    step_to(&mut sound, 0.5);
    assert_ne!(expected, y(&mut sound));
    assert_eq!(stuck(&[0.5]), expected);
    assert_eq!(stuck(&[0.15, 0.5]), expected);
    assert_eq!(stuck(&[0.153, 0.3, 0.5]), expected);
}

#[test]
fn a_sensor_that_failed_before_the_start_is_stuck_at_its_first_reading() {
    let mut sensor: Instance<Sensor> = start(&[("u", 1.0), ("failure", 2.0)], 3.0).unwrap();
    assert_eq!(y(&mut sensor), 1.0);
    step_to(&mut sensor, 4.0);
    set(&mut sensor, &[("u", 2.0)]).unwrap();
    step_to(&mut sensor, 5.0);
    assert_eq!(y(&mut sensor), 1.0);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// However a flight is cut into steps, and if it goes on in another instance, samples are the same.
    #[test]
    fn verif_steps_and_saved_states_change_rounding_alone(
        inputs in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 1..6),
        cuts in prop::collection::vec(1_u32..20, 1..10),
        failure in 1..=5_i32,
    ) {
        let failing = [("failure", failure.into()), ("failure_time", 0.37), ("failure_value", 1.0)];
        let parameters = [&NOISY[..7], &failing].concat();
        let (mut whole, mut cut) = (started(&parameters), started(&parameters));
        for (i, &(value, slope)) in inputs.iter().enumerate() {
            let (from, to) = (0.2 * i as f64, 0.2 * (i + 1) as f64);
            input(&mut whole, value, slope);
            step_to(&mut whole, to);
            let sum: u32 = cuts.iter().sum();
            let mut ends: Vec<f64> = cuts.iter().scan(0, |done, part| {
                *done += part;
                Some(from + 0.2 * f64::from(*done) / f64::from(sum))
            }).collect();
            *ends.last_mut().unwrap() = to;
            for end in ends {
                let time = cut.time();
                input(&mut cut, value + slope * (time - from), slope);
                step_to(&mut cut, end);
                let mut other = moved(&cut);
                prop_assert_eq!(y(&mut other).to_bits(), y(&mut cut).to_bits());
                cut = other;
            }
            prop_assert!((y(&mut whole) - y(&mut cut)).abs() < 1e-14);
        }
    }
}

#[test]
fn a_reset_sensor_flies_again_with_the_same_bits() {
    let mut sensor = started(&NOISY);
    let mut flights = Vec::new();
    for _ in 0..2 {
        for i in 1..=20 {
            step_to(&mut sensor, 0.007 * f64::from(i));
        }
        flights.push(y(&mut sensor).to_bits());
        sensor.reset().unwrap();
        assert_eq!(sensor.time(), 0.0);
        begin(&mut sensor, &NOISY, 0.0).unwrap();
    }
    assert_eq!(flights[0], flights[1]);
}

#[test]
fn no_number_of_a_state_may_be_made_up() {
    // Start, time, input, slope, last sample, its value, lagged input and stuck reading with a flag before each.
    let sensor = {
        let mut sensor = started(&NOISY);
        step_to(&mut sensor, 0.1);
        sensor
    };
    let bytes = sensor.state().unwrap().encode().unwrap();
    let taken = |number, value| sensor.deserialize(&forged(&bytes, number, value)).is_ok();
    assert!((0..10).all(|number| !taken(number, f64::NAN) && !taken(number, f64::INFINITY)));
    assert!([2, 5, 7, 9].iter().all(|&number| taken(number, 1e60) && !taken(number, 1e91)));
    for (number, value) in [(0, 0.2), (3, 1e31), (4, -2.0), (4, 0.5), (4, 1e16), (6, 2.0), (8, 0.5)]
    {
        assert!(!taken(number, value), "{number} {value}");
    }
    assert!(taken(2, 5.0) && taken(4, 3.0) && taken(8, 1.0));
}
