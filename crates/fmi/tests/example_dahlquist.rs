//! The library of a model with every capability but inputs that move within a step.
//!
//! One program for each example: they export functions of the same names.

#![allow(unsafe_code)]

mod master;

use dahlquist::Dahlquist;
use fmi_model::phase::Phase;
use fmi_model::status::Status;
use master::order::{Order, compare_tables, follow};
use master::{Slave, fuzz};

type Fmi2 = master::v2::Api<Dahlquist>;
type Fmi3 = master::v3::Api<Dahlquist>;

/// No start and no step of it fails.
const REACHABLE: [Phase; 6] = [
    Phase::Instantiated,
    Phase::InitializationMode,
    Phase::StepComplete,
    Phase::Terminated,
    Phase::EventMode,
    Phase::ContinuousTimeMode,
];

fn bring<A: Order>(slave: &Slave<A>, phase: Phase) {
    if phase == Phase::Instantiated {
        return;
    }
    assert_eq!(slave.begin(), Status::Ok);
    if phase == Phase::InitializationMode {
        return;
    }
    assert_eq!(slave.exit(), Status::Ok);
    let status = match phase {
        Phase::Terminated => slave.terminate(),
        Phase::ContinuousTimeMode => slave.api.enter_continuous_time_mode(slave.c),
        _ => Status::Ok,
    };
    assert_eq!(status, Status::Ok);
}

#[test]
fn the_table_of_legal_calls_is_the_one_of_the_standard() {
    compare_tables::<Fmi2>();
    compare_tables::<Fmi3>();
}

#[test]
fn every_function_of_an_example_is_allowed_or_refused_as_the_standard_says() {
    follow::<Fmi2>(&REACHABLE, bring);
    follow::<Fmi3>(&REACHABLE, bring);
}

#[test]
fn random_calls_never_crash_a_model_with_capabilities() {
    fuzz::play::<Fmi2>(REACHABLE.len());
    // An error is a state in reach of any call.
    fuzz::play::<Fmi3>(REACHABLE.len() + 1);
}
