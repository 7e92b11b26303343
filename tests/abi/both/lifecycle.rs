//! Legal order of calls, steps and resets, through the shared library.

use super::{Api, Slave};
use crate::common::{configurations, reference};
use crate::master::Api as _;
use crate::master::order::follow;
use fmi_model::phase::Phase;
use fmi_model::status::Status;

/// The states that synchronous steps can reach without an internal error.
const REACHABLE: [Phase; 8] = [
    Phase::Instantiated,
    Phase::InitializationMode,
    Phase::StepComplete,
    Phase::StepFailed,
    Phase::Terminated,
    Phase::Error,
    Phase::EventMode,
    Phase::ContinuousTimeMode,
];

fn bring_to(slave: &Slave, phase: Phase) {
    match phase {
        Phase::Instantiated => {
            assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
        }
        Phase::InitializationMode => {
            bring_to(slave, Phase::Instantiated);
            assert_eq!(slave.begin(), Status::Ok);
        }
        Phase::StepComplete => slave.start(),
        Phase::StepFailed => {
            slave.start();
            slave.leave_envelope();
        }
        Phase::Terminated => {
            slave.start();
            assert_eq!(slave.terminate(), Status::Ok);
        }
        Phase::Error => {
            bring_to(slave, Phase::InitializationMode);
            assert_eq!(slave.set("mach0", 2.0), Status::Ok);
            assert_eq!(slave.exit(), Status::Error);
        }
        Phase::EventMode => slave.start(),
        Phase::ContinuousTimeMode => {
            slave.start();
            assert_eq!(slave.api.enter_continuous_time_mode(slave.c), Status::Ok);
        }
        Phase::StepInProgress
        | Phase::StepCanceled
        | Phase::Fatal
        | Phase::IntermediateUpdateMode => unreachable!(),
    }
    slave.log();
}

#[test]
fn every_function_in_every_state_is_allowed_or_refused_as_the_standard_says() {
    follow(&REACHABLE, bring_to);
}

#[test]
fn an_impossible_trim_is_an_error_with_its_reason_and_the_instance_can_be_reset() {
    let api = Api::load();
    let slave = Slave::new(&api);
    bring_to(&slave, Phase::InitializationMode);
    assert_eq!(slave.set("mach0", 2.0), Status::Ok);
    slave.refuses(Status::Error, &["mach0 = 2"], |slave| {
        let (status, values) = slave.reals(&[reference("V")]);
        assert!(values[0].is_nan(), "an output of an impossible trim");
        status
    });
    assert_eq!(slave.exit(), Status::Error);
    let record = slave.message();
    assert_eq!(record.category, "logStatusError");
    assert!(record.message.contains("mach0 = 2"), "{}", record.message);
    assert_eq!(slave.get("mach0"), 2.0);
    assert_eq!(slave.step(0.0, 0.01), Status::Error);
    assert_eq!(slave.reset(), Status::Ok);
    slave.start();
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
}

fn flight(slave: &Slave, configuration: i32) -> Vec<Vec<u64>> {
    assert_eq!(slave.set("altitude0", 26500.0), Status::Ok);
    assert_eq!(slave.set_enumeration("configuration", configuration), Status::Ok);
    assert_eq!(slave.begin_with(Some(1e-7), 3.0, Some(4.0)), Status::Ok);
    assert_eq!(slave.exit(), Status::Ok);
    (0..10)
        .map(|i| {
            assert_eq!(slave.set("delta_e", 0.002 * f64::from(i)), Status::Ok);
            assert_eq!(slave.step(3.0 + f64::from(i) * 0.1, 0.1), Status::Ok);
            slave.bits()
        })
        .collect()
}

#[test]
fn a_reset_restores_everything_so_the_second_run_has_the_same_bits() {
    let api = Api::load();
    let (slave, fresh) = (Slave::new(&api), Slave::new(&api));
    slave.start();
    assert_eq!(slave.set("phi", 0.05), Status::Ok);
    assert_eq!(slave.step(0.0, 0.3), Status::Ok);
    assert_eq!(slave.reset(), Status::Ok);
    let (reset, new) = (slave.save(), fresh.save());
    assert_eq!(slave.bytes(reset), fresh.bytes(new), "a reset instance is like a new one");
    slave.free(reset);
    fresh.free(new);
    for configuration in configurations() {
        assert_eq!((slave.reset(), fresh.reset()), (Status::Ok, Status::Ok));
        let first = flight(&slave, configuration);
        assert_eq!(slave.reset(), Status::Ok);
        assert_eq!(first, flight(&slave, configuration));
        assert_eq!(first, flight(&fresh, configuration));
    }
}

#[test]
fn two_instances_do_not_disturb_each_other() {
    let api = Api::load();
    let (one, two, alone) = (Slave::flying(&api), Slave::flying(&api), Slave::flying(&api));
    for i in 0..10 {
        let point = f64::from(i) * 0.05;
        for (slave, delta_e) in [(&one, 0.01), (&two, -0.01)] {
            assert_eq!(slave.set("delta_e", delta_e), Status::Ok);
            assert_eq!(slave.step(point, 0.05), Status::Ok);
        }
    }
    for i in 0..10 {
        assert_eq!(alone.set("delta_e", 0.01), Status::Ok);
        assert_eq!(alone.step(f64::from(i) * 0.05, 0.05), Status::Ok);
    }
    assert_eq!(one.bits(), alone.bits());
    assert_ne!(two.bits(), alone.bits());
}
