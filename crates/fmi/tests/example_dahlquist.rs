//! The library of a model with every capability but inputs that move within a step.
//!
//! One program for each example: they export functions of the same names.

#![allow(unsafe_code)]

mod master;

use dahlquist::Dahlquist;
use fmi_model::phase::{PHASES, Phase};
use fmi_model::v2::calls::CALLS;
use fmi_model::v2::sys::Status;
use master::fuzz;
use master::order::{STANDARD, allows, follow};

type Slave<'a> = master::Slave<'a, Dahlquist>;

/// No start and no step of it fails.
const REACHABLE: [Phase; 6] = [
    Phase::Instantiated,
    Phase::InitializationMode,
    Phase::StepComplete,
    Phase::Terminated,
    Phase::EventMode,
    Phase::ContinuousTimeMode,
];

fn bring_to(slave: &Slave, phase: Phase) {
    assert_eq!(slave.setup(), Status::Ok);
    if phase == Phase::Instantiated {
        return;
    }
    assert_eq!(slave.enter(), Status::Ok);
    if phase == Phase::InitializationMode {
        return;
    }
    assert_eq!(slave.exit(), Status::Ok);
    let status = match phase {
        Phase::Terminated => slave.terminate(),
        // SAFETY: a live instance.
        Phase::ContinuousTimeMode => unsafe { (slave.api.enter_continuous_time_mode)(slave.c) },
        _ => Status::Ok,
    };
    assert_eq!(status, Status::Ok);
}

#[test]
fn the_table_of_legal_calls_is_the_one_of_the_standard() {
    assert_eq!(CALLS.len(), STANDARD.len());
    for call in CALLS {
        for phase in PHASES.into_iter().filter(|&phase| phase != Phase::IntermediateUpdateMode) {
            let allowed = allows(call.name, phase);
            assert_eq!(call.allowed_in(phase), allowed, "{} {phase:?}", call.name);
        }
    }
}

#[test]
fn every_function_of_an_example_is_allowed_or_refused_as_the_standard_says() {
    follow(&REACHABLE, bring_to);
}

#[test]
fn random_calls_never_crash_a_model_with_capabilities() {
    fuzz::play::<Dahlquist>(REACHABLE.len());
}
