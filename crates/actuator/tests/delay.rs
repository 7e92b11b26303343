//! The delay, saved states and refusals.

#[path = "../../fmi/tests/flight/mod.rs"]
mod flight;

use ahv_actuator::Actuator;
use flight::{begin, forged, get, heard, input, moved, set, start, started, step_to, y};
use fmi_model::instance::{Instance, Interface};
use proptest::prelude::*;

const DELAY: f64 = 0.03;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// What is commanded happens later, and nothing else is different; nor if the flight goes on in another instance.
    #[test]
    fn verif_a_delayed_actuator_does_the_same_later(
        commands in prop::collection::vec((-1.5..1.5_f64, prop_oneof![Just(0.0), -5.0..5.0]), 1..20),
        first in any::<bool>(),
        steps in prop::collection::vec(1_u32..30, 20),
    ) {
        let kind = ("kind", if first { 2.0 } else { 1.0 });
        let mut prompt: Instance<Actuator> = started(&[kind]);
        let mut late: Instance<Actuator> = started(&[kind, ("delay", DELAY)]);
        let mut end = 0;
        for (&(value, slope), &step) in commands.iter().zip(&steps) {
            end += step;
            for instance in [&mut prompt, &mut late] {
                input(instance, value, slope);
                step_to(instance, 1e-3 * f64::from(end));
            }
            let mut other = moved(&late);
            prop_assert_eq!(y(&mut other).to_bits(), y(&mut late).to_bits());
            late = moved(&other);
        }
        step_to(&mut late, 1e-3 * f64::from(end) + DELAY);
        prop_assert!((y(&mut late) - y(&mut prompt)).abs() < 1e-13);
        let rates = get(&mut late, "rate") - get(&mut prompt, "rate");
        prop_assert!(rates.abs() < 1e-11, "{rates:e}");
    }
}

#[test]
fn nothing_moves_before_the_delay_is_over() {
    let mut late: Instance<Actuator> = started(&[("delay", 0.1), ("y0", 0.2), ("u", 0.5)]);
    step_to(&mut late, 0.1);
    assert_eq!((y(&mut late), get(&mut late, "rate")), (0.2, 0.0));
    step_to(&mut late, 0.11);
    assert!(y(&mut late) > 0.2);
}

#[test]
fn more_changes_than_are_kept_are_refused_with_the_step_that_fits() {
    let fly = |step: f64| {
        let mut late: Instance<Actuator> = started(&[("delay", 1.0)]);
        for i in 0..3000 {
            set(&mut late, &[("u", 1e-3 * f64::from(i % 7))])?;
            late.do_step(late.time(), step)?;
        }
        Ok::<_, fmi_model::failure::Failure>(())
    };
    let refused = fly(1e-4).unwrap_err().to_string();
    assert_eq!(
        refused,
        "delay = 1 s is too long for steps of 0.0001 s: at most 256 changes of u are kept on their \
         way; take steps of 0.003937008 s and longer, or a shorter delay"
    );
    fly(0.003_937_008).unwrap();
}

#[test]
fn a_held_command_takes_no_room_however_short_the_steps() {
    let mut late: Instance<Actuator> = started(&[("delay", 1.0), ("u", 0.5)]);
    for i in 1..=3000 {
        step_to(&mut late, 1e-4 * f64::from(i));
    }
}

#[test]
fn no_number_of_a_state_may_be_made_up() {
    // Time, input, slope, position, rate, number of changes; time, value and slope of each.
    let mut late: Instance<Actuator> = started(&[("delay", 1.0)]);
    for i in 1..=3 {
        set(&mut late, &[("u", 0.1 * f64::from(i))]).unwrap();
        step_to(&mut late, 0.1 * f64::from(i));
    }
    let bytes = late.state().unwrap().encode().unwrap();
    let taken = |number, value| late.deserialize(&forged(&bytes, number, value)).is_ok();
    assert!((0..18).all(|number| !taken(number, f64::NAN) && !taken(number, f64::INFINITY)));
    for (number, value) in [
        (0, 0.1),
        (1, 1e91),
        (7, -1e91),
        (11, 1e91),
        (2, 1e31),
        (3, 2e9),
        (4, -2e9),
        (5, 0.0),
        (5, 3.0),
        (5, 4.5),
        (5, 257.0),
        (9, 0.25),
        (15, 0.35),
        (18, 1.0),
        (6 + 3 * 256 - 1, 1.0),
    ] {
        assert!(!taken(number, value), "{number} {value}");
    }
    assert!(taken(1, 1e60) && taken(3, 0.5) && taken(10, 0.5));
}

#[test]
fn a_reset_actuator_flies_again_with_the_same_bits() {
    let values = [("delay", 0.02), ("u", 0.7), ("bandwidth", 30.0)];
    let mut actuator: Instance<Actuator> = started(&values);
    let mut flights = Vec::new();
    for _ in 0..2 {
        for i in 1..=20 {
            step_to(&mut actuator, 0.007 * f64::from(i));
        }
        flights.push(y(&mut actuator).to_bits());
        actuator.reset().unwrap();
        begin(&mut actuator, &values, 0.0).unwrap();
    }
    assert_eq!(flights[0], flights[1]);
}

#[test]
fn bad_values_are_refused_by_name_value_and_limit() {
    let mut actuator: Instance<Actuator> = Instance::new(Interface::CoSimulation, false).unwrap();
    for (name, value, said) in [
        ("bandwidth", 0.0, "bandwidth = 0 is refused: the range is [0.001, 1000000]"),
        ("bandwidth", f64::NAN, "bandwidth = NaN is refused: a finite number is needed"),
        ("damping", 0.0, "damping = 0 is refused: the range is [0.01, 100]"),
        ("rate_limit", 0.0, "rate_limit = 0 is refused: the range is [1e-9, 1e9]"),
        ("rate_limit", f64::INFINITY, "rate_limit = inf is refused: a finite number is needed"),
        ("position_min", f64::NEG_INFINITY, "position_min = -inf is refused: a finite number"),
        ("position_max", 1e10, "position_max = 1e10 is refused: the range is [-1e9, 1e9]"),
        ("delay", -0.1, "delay = -0.1 is refused: the range is [0, 1000]"),
        ("y0", f64::NAN, "y0 = NaN is refused: a finite number is needed"),
        ("kind", 3.0, "kind = 3 is refused: choose one of 1 SecondOrder, 2 FirstOrder"),
        ("u", f64::NAN, "u = NaN is refused: a finite number is needed"),
        ("rate", 1.0, "rate = 1 is refused: only inputs and parameters can be set"),
    ] {
        let refused = set(&mut actuator, &[(name, value)]).unwrap_err().to_string();
        assert!(refused.starts_with(said), "{refused}");
    }
}

#[test]
fn a_start_without_a_position_is_refused_by_both_stops() {
    let refused = |values| start::<Actuator>(values, 0.0).unwrap_err().to_string();
    assert_eq!(
        refused(&[("position_min", 2.0)]),
        "position_min = 2 and position_max = 1 are refused: position_min has to be less than \
         position_max"
    );
    assert_eq!(
        refused(&[("position_min", 0.5)]),
        "y0 = 0 is refused: the actuator starts between its stops position_min = 0.5 and \
         position_max = 1; change y0 or the stop"
    );
}

#[test]
fn what_has_no_effect_and_a_command_beyond_a_stop_are_said_once() {
    let values = [("kind", 2.0), ("damping", 0.3), ("u", 15.0)];
    let mut actuator: Instance<Actuator> = started(&values);
    step_to(&mut actuator, 0.1);
    step_to(&mut actuator, 0.2);
    let said = heard(&mut actuator);
    for text in ["damping has no effect", "u = 15 lies beyond position_max = 1"] {
        assert_eq!(said.iter().filter(|line| line.contains(text)).count(), 1, "{said:?}");
    }
}
