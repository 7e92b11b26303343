//! What a master may do within a step.

use crate::common::fmi3::{Api, Slave};
use crate::common::{configurations, fmi2, reference};
use crate::master::order::Order;
use crate::master::{Api as _, Random};
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::status::Status;

const STEP: f64 = 0.25;
/// Values at the ends of internal steps of a longer one, against a run with communication points there: of the
/// default tolerance 1e-8, in relation to the size.
const ACCURACY: f64 = 1e-8;

/// An instance into whose steps the master looks, with some elevator.
fn open(api: &Api, configuration: i32, early_return_allowed: bool) -> Slave<'_> {
    let outputs = ["V", "alpha", "lift"].map(reference);
    let slave = Slave::open(api, early_return_allowed, &outputs);
    slave.start_as(configuration);
    assert_eq!(slave.set("delta_e", 0.005), Status::Ok);
    slave
}

#[test]
fn moments_ascend_to_the_end_of_the_step_and_have_the_values_of_a_run_with_points_there() {
    let api = Api::load();
    for configuration in configurations() {
        let slave = open(&api, configuration, false);
        let mut seen = Vec::new();
        let answers = slave.step_with(0.0, STEP, |moment| {
            assert!(moment.set_requested && moment.get_allowed && moment.step_finished);
            assert!(!moment.can_return_early, "it was not allowed");
            assert_eq!(moment.time, slave.time(), "the variable of that name");
            let rate = slave.output_derivative("alpha", 1);
            assert_eq!(rate.0, Status::Ok);
            seen.push((moment.time, ["V", "alpha", "lift"].map(|name| slave.get(name)), rate.1));
            None
        });
        assert!(answers.status == Status::Ok && answers.time == STEP && !answers.early);
        assert!(seen.len() > 2, "{}", seen.len());
        assert!(seen[0].0 > 0.0 && seen.is_sorted_by(|one, next| one.0 < next.0));
        assert_eq!(seen.last().unwrap().0, STEP);

        let other = Slave::flying_as(&api, configuration);
        assert_eq!(other.set("delta_e", 0.005), Status::Ok);
        let mut point = 0.0;
        for (time, values, rate) in seen {
            assert_eq!(other.step(point, time - point), Status::Ok, "{:?}", other.log());
            point = other.time();
            for (name, value) in ["V", "alpha", "lift"].into_iter().zip(values) {
                let expected = other.get(name);
                assert!((value - expected).abs() <= ACCURACY * (1.0 + expected.abs()), "{name}");
            }
            let expected = other.output_derivative("alpha", 1).1;
            assert!((rate - expected).abs() < 1e2 * ACCURACY, "{rate} {expected}");
        }
    }
}

#[test]
fn a_master_that_only_looks_changes_no_bit() {
    let api = Api::load();
    for configuration in configurations() {
        let (looked_at, left_alone) =
            (open(&api, configuration, true), Slave::flying_as(&api, configuration));
        assert_eq!(left_alone.set("delta_e", 0.005), Status::Ok);
        for i in 0..4 {
            let point = f64::from(i) * STEP;
            let answers = looked_at.step_with(point, STEP, |_| {
                looked_at.bits();
                None
            });
            assert_eq!((answers.status, answers.early), (Status::Ok, false));
            assert_eq!(left_alone.step(point, STEP), Status::Ok);
            assert_eq!(looked_at.bits(), left_alone.bits());
        }
    }
}

/// Seconds after the first moment, and where the step then ends.
type Wish = (f64, fn(f64) -> f64);

#[test]
fn an_early_return_lands_where_it_is_asked_for() {
    let api = Api::load();
    for configuration in configurations() {
        let wishes: [Wish; 5] = [
            (0.0, |now| now),
            (0.03, |now| now + 0.03),
            (-0.1, |now| now),
            (f64::NAN, |now| now),
            (1e9, |_| STEP),
        ];
        for (after, lands) in wishes {
            let slave = open(&api, configuration, true);
            let (mut first, mut last) = (None, 0.0);
            let answers = slave.step_with(0.0, STEP, |moment| {
                assert_eq!(moment.can_return_early, moment.time < STEP);
                last = moment.time;
                let wish = first.is_none().then_some(moment.time + after);
                first.get_or_insert(moment.time);
                wish
            });
            let expected = lands(first.unwrap());
            assert_eq!((answers.status, answers.time), (Status::Ok, expected), "{after}");
            assert_eq!(answers.early, expected < STEP, "{after}");
            assert_eq!((slave.time(), last), (expected, expected), "the last moment is the end");
            assert_eq!(slave.step(expected, 0.1), Status::Ok, "and goes on from there");
        }
    }
}

#[test]
fn an_early_return_that_was_not_allowed_is_not_made() {
    let api = Api::load();
    let slave = open(&api, 3, false);
    let answers = slave.step_with(0.0, STEP, |moment| Some(moment.time));
    assert_eq!((answers.status, answers.early, answers.time), (Status::Ok, false, STEP));
}

#[test]
fn inputs_set_within_a_step_act_from_there_on() {
    let api = Api::load();
    let slave = open(&api, 3, false);
    let (mut point, other) = (0.0, open(&api, 3, false));
    let mut course = Vec::new();
    let answers = slave.step_with(0.0, STEP, |moment| {
        let elevator = 0.01 * moment.time;
        assert_eq!(slave.set("delta_e", elevator), Status::Ok);
        course.push((moment.time, elevator));
        None
    });
    assert_eq!(answers.status, Status::Ok);
    for (time, elevator) in course {
        assert_eq!(other.step(point, time - point), Status::Ok);
        point = other.time();
        assert_eq!(other.set("delta_e", elevator), Status::Ok);
    }
    for name in ["V", "alpha", "q", "eta1", "delta_e"] {
        let (one, two) = (slave.get(name), other.get(name));
        assert!((one - two).abs() <= ACCURACY * (1.0 + two.abs()), "{name} {one} {two}");
    }
    let held = open(&api, 3, false);
    assert_eq!(held.step(0.0, STEP), Status::Ok);
    assert!((held.get("q") - slave.get("q")).abs() > 1e-4, "the inputs act");
}

#[test]
fn a_master_that_sets_inputs_is_first_asked_for_those_at_the_end_and_they_move_there() {
    let api = Api::load();
    let (start, end) = (0.005, 0.012);
    let slave = Slave::open(&api, true, &[reference("delta_e")]);
    slave.start_as(3);
    assert_eq!(slave.set("delta_e", start), Status::Ok);
    let mut seen = Vec::new();
    let answers = slave.step_with(0.0, STEP, |moment| {
        if seen.is_empty() {
            assert!(moment.set_requested && moment.time == STEP);
            assert!(!moment.get_allowed && !moment.step_finished && !moment.can_return_early);
            assert_eq!(slave.set("delta_e", end), Status::Ok);
            seen.push((0.0, start));
            // Refused: the flag says so.
            return Some(0.1);
        }
        assert!(moment.get_allowed && moment.step_finished);
        seen.push((moment.time, slave.get("delta_e")));
        None
    });
    assert_eq!((answers.status, answers.time), (Status::Ok, STEP));
    for (time, elevator) in seen {
        let expected = start + (end - start) * time / STEP;
        assert!((elevator - expected).abs() < 1e-15, "{time}: {elevator}, not {expected}");
    }
    // The same as by FMI 2.0, where the master gives the slope.
    let api = fmi2::Api::load();
    let twin = fmi2::Slave::flying_as(&api, 3);
    assert_eq!(twin.set("delta_e", start), Status::Ok);
    assert_eq!(twin.set_input_derivative("delta_e", 1, (end - start) / STEP), Status::Ok);
    assert_eq!(twin.step(0.0, STEP), Status::Ok);
    for name in ["V", "alpha", "q", "eta1", "slosh1"] {
        let (one, two) = (slave.get(name), twin.get(name));
        assert!((one - two).abs() <= ACCURACY * (1.0 + two.abs()), "{name} {one} {two}");
    }
}

#[test]
fn a_flight_that_ends_within_a_step_says_so_at_the_last_valid_instant() {
    let api = Api::load();
    for early_return_allowed in [false, true] {
        let slave = open(&api, 1, early_return_allowed);
        assert_eq!(slave.set("delta_e", 0.2), Status::Ok);
        let mut last = 0.0;
        let answers = slave.step_with(0.0, 20.0, |moment| {
            last = moment.time;
            None
        });
        assert!(answers.status == Status::Ok && answers.end && !answers.event);
        assert_eq!(answers.early, early_return_allowed);
        assert!(last <= answers.time && answers.time < 20.0);
        assert_eq!(slave.time(), answers.time);
        let record = slave.message();
        assert_eq!(
            (record.status, record.category.as_str()),
            (Status::Discard, "logStatusDiscard")
        );
        assert!(record.message.contains("reached the edge of its valid range"), "{record:?}");
    }
}

#[test]
fn every_function_within_a_step_is_allowed_or_refused_as_the_standard_says() {
    let api = Api::load();
    let phase = Phase::IntermediateUpdateMode;
    for (name, _) in Api::TABLE {
        let (slave, other) = (open(&api, 1, true), Slave::flying(&api));
        let (mut within, before) = (None, slave.bits());
        let answers = slave.step_with(0.0, 0.01, |_| {
            if within.is_none() {
                let bits = slave.bits();
                within = Some((Api::call(&slave, &other, name), slave.log()));
                assert!(bits == slave.bits() || name.contains("Set"), "{name}");
            }
            None
        });
        let (status, log) = within.expect("a moment");
        if Api::allows(name, phase, Interface::CoSimulation) {
            assert_eq!(status, Api::legal_result(name, phase), "{name} {log:?}");
        } else {
            assert!(status == Status::Error && log.len() == 1, "{name}: {log:?}");
            assert!(log[0].message.starts_with(name), "{name}: {log:?}");
        }
        assert_eq!(answers.status, status, "{name}: an error within a step is one of the step");
        if status == Status::Error {
            let message = slave.message().message;
            assert!(message.starts_with("fmi3DoStep: not allowed in state terminated by an error"));
            assert!(slave.bits() != before && slave.reset() == Status::Ok);
        }
    }
}

#[test]
fn a_master_that_resets_or_restores_within_a_step_ends_it() {
    let api = Api::load();
    for restores in [false, true] {
        let slave = open(&api, 1, true);
        let saved = slave.save();
        let mut random = Random(1);
        let answers = slave.step_with(0.0, STEP, |_| {
            // An error, after which both are legal.
            assert_eq!(slave.set("V", random.below(9) as f64), Status::Error);
            let status = if restores { slave.load(saved) } else { slave.reset() };
            assert_eq!(status, Status::Ok);
            None
        });
        assert_eq!(answers.status, Status::Error);
        assert_eq!(slave.load(saved), Status::Ok);
        assert_eq!(slave.step(0.0, STEP), Status::Ok);
        slave.free(saved);
    }
}
