//! Sampling in time: by hand, whatever the communication step, and through a saved state.
#![allow(missing_docs)]

use ahv_autopilot::Autopilot;
use ahv_autopilot::law::Law;
use fmi_model::instance::{Instance, Interface};
use fmi_model::{Model, table};
use proptest::prelude::*;

const PERIOD_S: f64 = 0.01;
const OUTPUTS: [&str; 4] = ["delta_e", "phi", "missed", "saturated"];

fn reference(name: &str) -> u32 {
    Autopilot::VARIABLES.iter().position(|variable| variable.name == name).unwrap() as u32
}

fn set(pilot: &mut Instance<Autopilot>, values: &[(&str, f64)]) {
    for &(name, value) in values {
        pilot.set_real(&[reference(name)], &[value]).unwrap();
    }
}

fn outputs(pilot: &mut Instance<Autopilot>) -> [f64; 4] {
    let mut found = [0.0; 4];
    pilot.get_real(&OUTPUTS.map(reference), |i, value| found[i] = value).unwrap();
    found
}

/// A running autopilot with these parameters.
fn running(model: Autopilot, parameters: &[(&str, f64)]) -> Instance<Autopilot> {
    let mut pilot = Instance::of(model, Interface::CoSimulation, false).unwrap();
    set(&mut pilot, parameters);
    pilot.setup_experiment(None, 0.0, None).unwrap();
    pilot.enter_initialization_mode().unwrap();
    pilot.exit_initialization_mode().unwrap();
    pilot
}

fn built_in(parameters: &[(&str, f64)]) -> Instance<Autopilot> {
    running(Autopilot::new().unwrap(), parameters)
}

/// A law without memory: the estimate is what was measured, the command is -(0.01 dV, 2 dgamma) less 0.5 of
/// the integral of the error of gamma.
fn by_hand() -> Autopilot {
    let text = r#"{"designs": [{
        "period_s": 0.01, "fuel_fraction": 1.0, "fuel_mass_kg_per_m": 1000.0,
        "A": [[1.0, 0.0], [0.0, 1.0]], "B": [[0.0, 0.0], [0.0, 0.0]],
        "C": [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]],
        "K": [[0.01, 0.0], [0.0, 2.0]], "Ki": [[0.0, 0.0], [0.0, 0.5]],
        "L": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        "level": [2000.0, 0.0, 0.0], "trim": [0.0, 0.3],
        "lowest": [-0.25, 0.0], "highest": [0.25, 0.6], "speed_error_m_per_s": 10.0
    }]}"#;
    Autopilot::with(Law::parse(text).unwrap())
}

const ROUNDING: f64 = 1e-15;

fn assert_close(found: [f64; 4], expected: [f64; 4]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= ROUNDING, "{found} for {expected}");
    }
}

#[test]
fn verif_a_command_acts_one_period_after_its_measurement() {
    let mut pilot = running(by_hand(), &[]);
    set(&mut pilot, &[("V", 2005.0), ("gamma", 0.01)]);
    assert_close(outputs(&mut pilot), [0.0; 4]);
    pilot.do_step(0.0, PERIOD_S).unwrap();
    let after_one = [-0.05, -0.02 - 0.5 * PERIOD_S * 0.01, 0.0, 0.0];
    assert_close(outputs(&mut pilot), after_one);
    set(&mut pilot, &[("V", 2000.0), ("gamma", 0.0)]);
    // Half a period later the command of the first sample is still in force.
    pilot.do_step(PERIOD_S, 0.5 * PERIOD_S).unwrap();
    assert_close(outputs(&mut pilot), after_one);
    pilot.do_step(1.5 * PERIOD_S, 0.5 * PERIOD_S).unwrap();
    assert_close(outputs(&mut pilot), [0.0, -0.5 * PERIOD_S * 0.01, 0.0, 0.0]);
}

#[test]
fn verif_limits_hold_and_integrals_stop_there() {
    let mut pilot = running(by_hand(), &[]);
    // 100 m/s too fast, of which 10 are acted on; gamma asks for more than the fuel there is.
    set(&mut pilot, &[("V", 2100.0), ("gamma", -0.5)]);
    for step in 0..100 {
        pilot.do_step(f64::from(step) * PERIOD_S, PERIOD_S).unwrap();
        assert_close(outputs(&mut pilot), [-0.1, 0.3, 0.0, f64::from(step + 1)]);
    }
    set(&mut pilot, &[("V", 2000.0), ("gamma", 0.0)]);
    pilot.do_step(1.0, PERIOD_S).unwrap();
    assert_close(outputs(&mut pilot), [0.0, 0.0, 0.0, 100.0]);
}

#[test]
fn verif_the_manoeuvre_and_the_inputs_are_added() {
    let parameters = [("command1_gamma", 0.0), ("command2_time", 0.02), ("command2_gamma", 0.02)];
    let mut pilot = running(by_hand(), &parameters);
    set(&mut pilot, &[("V", 2000.0), ("V_change", 5.0), ("gamma_wanted", 0.01)]);
    let mut integral = 0.0;
    for (step, wanted) in [0.01, 0.02, 0.03, 0.03].into_iter().enumerate() {
        pilot.do_step(step as f64 * PERIOD_S, PERIOD_S).unwrap();
        integral -= PERIOD_S * wanted;
        assert_close(outputs(&mut pilot), [0.05, 2.0 * wanted - 0.5 * integral, 0.0, 0.0]);
    }
}

#[test]
fn a_measurement_that_is_none_is_survived_counted_and_told_once() {
    let mut pilot = Instance::<Autopilot>::new(Interface::CoSimulation, true).unwrap();
    pilot.setup_experiment(None, 0.0, None).unwrap();
    pilot.enter_initialization_mode().unwrap();
    pilot.exit_initialization_mode().unwrap();
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e300];
    for (step, value) in bad.into_iter().enumerate() {
        set(&mut pilot, &[("V", value)]);
        pilot.do_step(step as f64 * PERIOD_S, PERIOD_S).unwrap();
    }
    set(&mut pilot, &[("q", f64::NAN), ("fuel_mass", f64::NAN)]);
    pilot.do_step(bad.len() as f64 * PERIOD_S, PERIOD_S).unwrap();
    assert_eq!(outputs(&mut pilot), [0.0, 0.0, 1.0 + bad.len() as f64, 0.0]);
    let told: Vec<_> = pilot.log.take().into_iter().map(|message| message.text).collect();
    let believed: Vec<_> = told.iter().filter(|text| text.contains("not believed")).collect();
    assert_eq!(believed.len(), 1, "{told:?}");
    assert!(believed[0].contains("first at t = 0 s"), "{believed:?}");
    // Commands are no measurements.
    let refused = pilot.set_real(&[reference("gamma_wanted")], &[f64::NAN]).unwrap_err();
    assert!(refused.to_string().contains("gamma_wanted = NaN is refused"), "{refused}");
}

/// Without measurements the model alone carries an estimate on that no command can stop.
#[test]
fn a_glitch_before_measurements_end_is_forgotten_once_they_are_back() {
    let mut pilot = built_in(&[("V_level", 2390.0)]);
    set(&mut pilot, &[("V", 2390.0), ("gamma", 1e9)]);
    pilot.do_step(0.0, PERIOD_S).unwrap();
    set(&mut pilot, &[("V", f64::NAN), ("gamma", f64::NAN), ("q", f64::NAN)]);
    pilot.do_step(PERIOD_S, 1e3).unwrap();
    let bytes = pilot.state().unwrap().encode().unwrap();
    pilot.deserialize(&bytes).expect("a state that was saved");
    set(&mut pilot, &[("V", 2390.0), ("gamma", 0.0), ("q", 0.0)]);
    pilot.do_step(1e3 + PERIOD_S, 1e3).unwrap();
    let [_, _, _, before] = outputs(&mut pilot);
    pilot.do_step(2e3 + PERIOD_S, 100.0).unwrap();
    let [_, _, missed, after] = outputs(&mut pilot);
    assert_eq!((missed, after), (1e5, before), "no command is at its limit any more");
}

#[test]
fn whatever_is_wanted_a_state_that_was_saved_can_be_restored() {
    for wanted in [1e31, 1e300, f64::MAX] {
        let mut pilot = built_in(&[]);
        set(&mut pilot, &[("V", 2390.0), ("V_change", -wanted), ("gamma_wanted", wanted)]);
        pilot.set_input_derivatives(&[reference("V_change")], &[1], &[1e30]).unwrap();
        pilot.do_step(0.0, 1e3).unwrap();
        let bytes = pilot.state().unwrap().encode().unwrap();
        let state = pilot.deserialize(&bytes).expect("a state that was saved");
        pilot.set_state(&state).unwrap();
        assert_eq!(pilot.state().unwrap().encode().unwrap(), bytes);
    }
}

#[test]
fn gains_follow_the_measured_fuel_and_meet_those_of_the_fuel_fraction() {
    let level = |pilot: &mut Instance<Autopilot>| {
        set(pilot, &[("V", 2380.0), ("gamma", 0.01), ("q", 0.002)]);
    };
    let flown = |parameters: &[(&str, f64)], fuel_mass: f64| {
        let mut pilot = built_in(parameters);
        level(&mut pilot);
        set(&mut pilot, &[("fuel_mass", fuel_mass)]);
        pilot.do_step(0.0, PERIOD_S).unwrap();
        outputs(&mut pilot)
    };
    let full = Law::parse(ahv_autopilot::law::BUILT_IN).unwrap();
    let designs = full.designs(0.0).unwrap();
    for design in designs.iter().filter(|design| design.fuel_mass_kg_per_m > 0.0) {
        // Level flight and limits stay those of the start: fuel does not change what commands are added to.
        let parameters = [("V_level", design.level[0]), ("delta_e_trim", 0.25), ("phi_trim", 0.3)];
        let measured = flown(&parameters, design.fuel_mass_kg_per_m);
        let mut all = parameters.to_vec();
        all.push(("fuel_fraction", design.fuel_fraction));
        assert_eq!(flown(&all, 0.0), measured, "fuel fraction {}", design.fuel_fraction);
        if design.fuel_fraction < 1.0 {
            assert_ne!(flown(&[], 0.0), measured);
        }
    }
}

#[test]
fn parameters_that_no_law_can_have_are_refused_with_the_reason() {
    for (parameters, said) in [
        (
            [("period", 0.02)].as_slice(),
            "period = 0.02 s is refused: law.json has designs for 0.01 s",
        ),
        (
            &[("delta_e_trim", 0.5)],
            "delta_e_trim = 0.5 is refused: the commands are limited to [-0.349",
        ),
        (&[("phi_trim", 0.7)], "phi_trim = 0.7 is refused: the commands are limited to [0, 0.65]"),
        (
            &[("command2_time", 5.0), ("command3_time", 4.0)],
            "command3_time = 4 s is refused: it must not be before the time of the breakpoint before, 5 s",
        ),
    ] {
        let mut pilot = Instance::<Autopilot>::new(Interface::CoSimulation, false).unwrap();
        set(&mut pilot, parameters);
        pilot.setup_experiment(None, 0.0, None).unwrap();
        pilot.enter_initialization_mode().unwrap();
        let refused = pilot.exit_initialization_mode().unwrap_err().to_string();
        assert!(refused.contains(said), "{refused}");
    }
    let mut pilot = Instance::<Autopilot>::new(Interface::CoSimulation, false).unwrap();
    for (name, value) in [("period", -1.0), ("period", f64::NAN), ("fuel_fraction", 1.1)] {
        let refused = pilot.set_real(&[reference(name)], &[value]).unwrap_err().to_string();
        assert!(refused.contains(&format!("{name} = {value} is refused")), "{refused}");
    }
}

#[test]
fn a_step_with_too_many_samples_is_refused_and_changes_nothing() {
    let mut pilot = built_in(&[]);
    set(&mut pilot, &[("V", 2380.0)]);
    for step_s in [1e5, 1e18, 1e30] {
        let refused = pilot.do_step(0.0, step_s).unwrap_err().to_string();
        assert!(refused.contains("make the step shorter"), "{refused}");
        assert_eq!(pilot.time(), 0.0);
        pilot.reset().unwrap();
        pilot = built_in(&[]);
    }
    pilot.do_step(0.0, 9e3).unwrap();
}

/// Measurements near level flight at communication points, and parts of a period between them.
fn flights() -> impl Strategy<Value = (Vec<[f64; 3]>, Vec<f64>)> {
    let measured = [2370.0..2400.0_f64, -0.02..0.02_f64, -0.05..0.05_f64];
    (prop::collection::vec(measured, 1..30), prop::collection::vec(0.01..0.99_f64, 30))
}

proptest! {
    #[test]
    fn steps_can_be_split_anywhere((measured, parts) in flights()) {
        let (mut whole, mut split) = (built_in(&[]), built_in(&[]));
        for (step, ([v, gamma, q], part)) in measured.into_iter().zip(parts).enumerate() {
            let time_s = step as f64 * PERIOD_S;
            for pilot in [&mut whole, &mut split] {
                set(pilot, &[("V", v), ("gamma", gamma), ("q", q)]);
            }
            whole.do_step(time_s, PERIOD_S).unwrap();
            let middle_s = part * PERIOD_S;
            split.do_step(time_s, middle_s).unwrap();
            split.do_step(time_s + middle_s, PERIOD_S - middle_s).unwrap();
            prop_assert_eq!(outputs(&mut whole), outputs(&mut split));
        }
    }

    #[test]
    fn inputs_that_move_are_read_where_they_are((measured, _) in flights()) {
        // Two samples in one step with a rate, or in two steps with the values there.
        let (mut moving, mut held) = (built_in(&[]), built_in(&[]));
        let inputs = ["V", "gamma", "q"].map(reference);
        for (step, pair) in measured.windows(2).enumerate() {
            let (now, next) = (pair[0], pair[1]);
            let time_s = 2.0 * step as f64 * PERIOD_S;
            let rates: [f64; 3] = std::array::from_fn(|i| (next[i] - now[i]) / (2.0 * PERIOD_S));
            moving.set_real(&inputs, &now).unwrap();
            moving.set_input_derivatives(&inputs, &[1; 3], &rates).unwrap();
            moving.do_step(time_s, 2.0 * PERIOD_S).unwrap();
            held.set_real(&inputs, &now).unwrap();
            held.do_step(time_s, PERIOD_S).unwrap();
            let middle: [f64; 3] = std::array::from_fn(|i| now[i] + rates[i] * PERIOD_S);
            held.set_real(&inputs, &middle).unwrap();
            held.do_step(time_s + PERIOD_S, PERIOD_S).unwrap();
            let (a, b) = (outputs(&mut moving), outputs(&mut held));
            for (a, b) in a.into_iter().zip(b) {
                prop_assert!((a - b).abs() <= 1e-9, "{} for {}", a, b);
            }
        }
    }

    #[test]
    fn a_saved_state_goes_on_with_the_same_bits((measured, parts) in flights()) {
        let mut pilot = built_in(&[("fuel_fraction", 0.33)]);
        let mut time_s = 0.0;
        for ([v, gamma, q], part) in measured.into_iter().zip(parts) {
            set(&mut pilot, &[("V", v), ("gamma", gamma), ("q", q), ("fuel_mass", 4000.0 * part)]);
            let bytes = pilot.state().unwrap().encode().unwrap();
            let mut other = built_in(&[]);
            let state = other.deserialize(&bytes).unwrap();
            other.set_state(&state).unwrap();
            prop_assert_eq!(other.state().unwrap().encode().unwrap(), bytes);
            pilot.do_step(time_s, 1.7 * PERIOD_S).unwrap();
            other.do_step(time_s, 1.7 * PERIOD_S).unwrap();
            prop_assert_eq!(outputs(&mut pilot), outputs(&mut other));
            time_s = pilot.time();
        }
    }
}

#[test]
fn a_state_of_another_law_is_refused() {
    let bytes = running(by_hand(), &[]).state().unwrap().encode().unwrap();
    let refused = built_in(&[]).deserialize(&bytes).unwrap_err().to_string();
    assert!(refused.contains("they belong to another model"), "{refused}");
}

#[test]
fn rows_stay_where_they_are() {
    for (row, name) in [(0, "V"), (6, "delta_e"), (10, "period"), (15, "command1_time")] {
        assert_eq!(reference(name), row, "{name}");
    }
    assert_eq!(reference("sampling_period") as usize, Autopilot::VARIABLES.len() - 1);
    assert_eq!(table::inputs::<Autopilot>(), 6);
}
