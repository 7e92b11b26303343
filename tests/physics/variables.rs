//! The dependencies that the variable table claims, by perturbing one state or input at a time.

use crate::model::{AERO_SETS, CONFIGURATIONS, flight_with, setup};
use ahv::data::AeroSet;
use ahv::flight::{Flight, INPUTS, Setup};
use ahv::variables::TABLE;
use ahv::vehicle::{CONTROLS, Configuration, NOMINAL, STATES};
use fmi_model::{Role, Variable};

/// Perturbation over the nominal value: large enough to show in every digit, small enough to stay
/// where the curve fits hold.
const STEPS: [f64; 2] = [1e-2, 2e-2];
/// A linear dependency: twice the step, twice the effect, to rounding of the value.
const LINEAR: f64 = 1e-9;

/// Values of all rows with one known moved by `size` of its nominal value.
fn values(base: &Flight, known: usize, size: f64) -> Vec<f64> {
    let mut moved = base.snapshot();
    if known < STATES {
        moved.state[known] += size * NOMINAL[known];
    } else {
        moved.inputs.values[known - STATES] += size;
    }
    let (setup, mut flight) = (setup(&[]), base.clone());
    flight.rewind(&moved);
    TABLE.iter().map(|variable| variable.value(&setup, &mut flight).unwrap()).collect()
}

/// A flight with every state in motion, so that no effect hides at zero.
fn moving(configuration: Configuration, set: AeroSet) -> Flight {
    let mut flight = flight_with(|p| {
        p.options.configuration = configuration;
        p.options.aero = set;
        // The fuel matters only while it burns.
        p.options.fuel_burn = configuration == Configuration::SloshBeam && set == AeroSet::Xu2015;
        // The pitch rate matters to the loads only where its terms count.
        p.options.factors.pitch_rate = if set == AeroSet::Parker2007 { 0.0 } else { 1.0 };
    });
    let states = flight.vehicle().states();
    let mut snapshot = flight.snapshot();
    for (i, value) in snapshot.state.iter_mut().enumerate().take(states) {
        *value += 0.1 * NOMINAL[i] * [1.0, -0.7, 0.9, 0.8, -1.1][i % 5];
    }
    // In still air the flight-path angle would not matter to the loads.
    snapshot.inputs.values[CONTROLS..].copy_from_slice(&[5.0, 3.0]);
    flight.rewind(&snapshot);
    flight
}

fn checked(variable: &Variable<Setup>) -> bool {
    matches!(variable.role, Role::Output(_) | Role::OutputState(_) | Role::Derivative(_))
}

#[test]
fn verif_every_claimed_dependency_exists_and_no_other() {
    for configuration in CONFIGURATIONS {
        let all = configuration == Configuration::SloshBeam;
        let bases = AERO_SETS.map(|set| moving(configuration, set));
        for known in 0..STATES + INPUTS {
            // Value before, and changes after one and two steps, of each coefficient set.
            let sets = bases.each_ref().map(|base| {
                let before = values(base, 0, 0.0);
                (before, STEPS.map(|size| values(base, known, size)))
            });
            let bit = 1 << known;
            for (row, variable) in TABLE.iter().enumerate().filter(|(_, v)| checked(v)) {
                let claims = variable.dependencies;
                let claimed = (claims.dependent | claims.fixed | claims.constant) & bit != 0;
                let what = || format!("{configuration:?}: {} on known {known}", variable.name);
                let mut moved = false;
                for (before, [once, twice]) in &sets {
                    let [first, second] = [once[row] - before[row], twice[row] - before[row]];
                    moved |= first != 0.0;
                    if claimed && claims.dependent & bit == 0 {
                        let bent = (second - 2.0 * first).abs();
                        assert!(bent <= LINEAR * before[row].abs().max(1e-3), "bent: {}", what());
                    }
                }
                // The smaller configurations, and the published set, lack some of the claimed ways.
                assert!(claimed || !moved, "unclaimed: {}", what());
                assert!(moved || !claimed || !all, "claimed in vain: {}", what());
            }
        }
    }
}

#[test]
fn verif_a_constant_factor_is_one_in_every_flight() {
    // `constant` promises a factor that no parameter changes, the configuration included.
    for (known, nominal) in NOMINAL.into_iter().enumerate() {
        let factors = CONFIGURATIONS.map(|configuration| {
            let base = moving(configuration, AeroSet::Parker2007);
            let before = values(&base, known, 0.0);
            let after = values(&base, known, STEPS[0]);
            let step = STEPS[0] * nominal;
            let factor = |row: usize| (after[row] - before[row]) / step;
            (0..TABLE.len()).map(factor).collect::<Vec<_>>()
        });
        for (row, variable) in TABLE.iter().enumerate().filter(|(_, v)| checked(v)) {
            if variable.dependencies.constant & (1 << known) != 0 {
                for factor in [&factors[0], &factors[1], &factors[2]] {
                    assert!((factor[row] - 1.0).abs() < 1e-6, "{}, known {known}", variable.name);
                }
            }
        }
    }
}

#[test]
fn verif_only_outputs_and_derivatives_claim_dependencies() {
    for variable in TABLE.iter().filter(|variable| !checked(variable)) {
        let claims = variable.dependencies;
        assert_eq!(claims.dependent | claims.fixed | claims.constant, 0, "{}", variable.name);
    }
    for variable in TABLE.iter().filter(|variable| checked(variable)) {
        let claims = variable.dependencies;
        assert_eq!(claims.dependent & (claims.fixed | claims.constant), 0, "{}", variable.name);
        assert_eq!(claims.fixed & claims.constant, 0, "{}", variable.name);
    }
}
