//! Legal order of calls, steps and resets, through the shared library.

use crate::common::{Api, Slave, configurations, reference};
use ahv::vehicle::{STATES, State};
use fmi_model::v2::calls::{CALLS, PHASES, Phase};
use fmi_model::v2::sys::{EventInfo, Status, StatusKind};
use std::ptr::{null, null_mut};

/// The tables of FMI 2.0.5, sections 4.2.4 and 3.2.3, typed from the standard: columns instantiated,
/// initialization mode, step complete, step in progress, step failed, step canceled, terminated,
/// error, fatal, event mode, continuous-time mode. Numbered conditions count as x.
#[rustfmt::skip]
const STANDARD: [(&str, &str); 40] = [
    ("fmi2SetDebugLogging",          "xxxxxxxx xx"),
    ("fmi2SetupExperiment",          "x          "),
    ("fmi2EnterInitializationMode",  "x          "),
    ("fmi2ExitInitializationMode",   " x         "),
    ("fmi2Terminate",                "  x x    xx"),
    ("fmi2Reset",                    "xxx xxxx xx"),
    ("fmi2GetReal",                  " xx xxxx xx"),
    ("fmi2GetInteger",               " xx xxxx xx"),
    ("fmi2GetBoolean",               " xx xxxx xx"),
    ("fmi2GetString",                " xx xxxx xx"),
    ("fmi2SetReal",                  "xxx      xx"),
    ("fmi2SetInteger",               "xxx      x "),
    ("fmi2SetBoolean",               "xxx      x "),
    ("fmi2SetString",                "xxx      x "),
    ("fmi2GetFMUstate",              "xxx xxxx xx"),
    ("fmi2SetFMUstate",              "xxx xxxx xx"),
    ("fmi2FreeFMUstate",             "xxx xxxx xx"),
    ("fmi2SerializedFMUstateSize",   "xxx xxxx xx"),
    ("fmi2SerializeFMUstate",        "xxx xxxx xx"),
    ("fmi2DeSerializeFMUstate",      "xxx xxxx xx"),
    ("fmi2GetDirectionalDerivative", " xx xxxx xx"),
    ("fmi2EnterEventMode", "         xx"),
    ("fmi2NewDiscreteStates", "         x "),
    ("fmi2EnterContinuousTimeMode", "         x "),
    ("fmi2CompletedIntegratorStep", "          x"),
    ("fmi2SetTime", "         xx"),
    ("fmi2SetContinuousStates", "          x"),
    ("fmi2GetDerivatives", "      xx xx"),
    ("fmi2GetEventIndicators", " x    xx xx"),
    ("fmi2GetContinuousStates", " x    xx xx"),
    ("fmi2GetNominalsOfContinuousStates", "x     xx xx"),
    ("fmi2SetRealInputDerivatives",  "xxx        "),
    ("fmi2GetRealOutputDerivatives", "  x xxxx   "),
    ("fmi2DoStep",                   "  x        "),
    ("fmi2CancelStep",               "   x       "),
    ("fmi2GetStatus",                "  xxx x    "),
    ("fmi2GetRealStatus",            "  xxx x    "),
    ("fmi2GetIntegerStatus",         "  xxx x    "),
    ("fmi2GetBooleanStatus",         "  xxx x    "),
    ("fmi2GetStringStatus",          "  xxx x    "),
];

fn standard_allows(name: &str, phase: Phase) -> bool {
    let (_, row) = STANDARD.iter().find(|(row, _)| *row == name).expect(name);
    row.as_bytes()[phase as usize] == b'x'
}

#[test]
fn the_table_of_legal_calls_is_the_one_of_the_standard() {
    assert_eq!(CALLS.len(), STANDARD.len());
    for call in CALLS {
        for phase in PHASES {
            assert_eq!(
                call.allowed_in(phase),
                standard_allows(call.name, phase),
                "{} {phase}",
                call.name
            );
        }
    }
}

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
            assert_eq!(slave.set_integer("configuration", 1), Status::Ok);
            assert_eq!(slave.setup(), Status::Ok);
        }
        Phase::InitializationMode => {
            bring_to(slave, Phase::Instantiated);
            assert_eq!(slave.enter(), Status::Ok);
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
            // SAFETY: a live instance.
            assert_eq!(unsafe { (slave.api.enter_continuous_time_mode)(slave.c) }, Status::Ok);
        }
        Phase::StepInProgress | Phase::StepCanceled | Phase::Fatal => unreachable!(),
    }
    slave.log();
}

/// States of level flight: V, h, then zeros.
const LEVEL: State = {
    let mut state = [0.0; STATES];
    (state[0], state[1]) = (2400.0, 26e3);
    state
};

/// Calls a function with harmless arguments.
fn call(slave: &Slave, name: &str) -> Status {
    let (api, c) = (slave.api, slave.c);
    let mut state = null_mut();
    let (mut real, mut integer, mut text, mut status) = (0.0, 0, null(), Status::Ok);
    let (mut size, mut flag, mut numbers) = (0, 0, LEVEL);
    let mut event = EventInfo::default();
    // SAFETY: the arguments are valid.
    unsafe {
        match name {
            "fmi2SetDebugLogging" => (api.set_debug_logging)(c, 0, 0, null()),
            "fmi2SetupExperiment" => slave.setup(),
            "fmi2EnterInitializationMode" => slave.enter(),
            "fmi2ExitInitializationMode" => slave.exit(),
            "fmi2Terminate" => slave.terminate(),
            "fmi2Reset" => slave.reset(),
            "fmi2GetReal" => (api.get_real)(c, &reference("delta_e"), 1, &mut real),
            "fmi2GetInteger" => (api.get_integer)(c, &reference("input_mode"), 1, &mut integer),
            "fmi2GetBoolean" => (api.get_boolean)(c, &reference("trim"), 1, &mut integer),
            "fmi2GetString" => (api.get_string)(c, null(), 0, null_mut()),
            "fmi2SetReal" => (api.set_real)(c, &reference("delta_e"), 1, &0.0),
            "fmi2SetInteger" => (api.set_integer)(c, null(), 0, null()),
            "fmi2SetBoolean" => (api.set_boolean)(c, null(), 0, null()),
            "fmi2SetString" => (api.set_string)(c, null(), 0, null()),
            "fmi2GetFMUstate" => {
                let status = (api.get_state)(c, &mut state);
                if status == Status::Ok {
                    slave.free(state);
                }
                status
            }
            "fmi2FreeFMUstate" => (api.free_state)(c, &mut state),
            "fmi2SetFMUstate"
            | "fmi2SerializedFMUstateSize"
            | "fmi2SerializeFMUstate"
            | "fmi2DeSerializeFMUstate" => {
                let other = Slave::new(api);
                bring_to(&other, Phase::Terminated);
                let saved = other.save();
                let mut bytes = other.bytes(saved);
                let (buffer, length) = (bytes.as_mut_ptr().cast(), bytes.len());
                let status = match name {
                    "fmi2SetFMUstate" => slave.load(saved),
                    "fmi2SerializedFMUstateSize" => (api.state_size)(c, saved, &mut size),
                    "fmi2SerializeFMUstate" => (api.serialize)(c, saved, buffer, length),
                    _ => (api.deserialize)(c, buffer, length, &mut state),
                };
                other.free(saved);
                if !state.is_null() {
                    other.free(state);
                }
                status
            }
            "fmi2GetDirectionalDerivative" => {
                (api.directional_derivative)(c, null(), 0, null(), 0, null(), null_mut())
            }
            "fmi2EnterEventMode" => (api.enter_event_mode)(c),
            "fmi2NewDiscreteStates" => (api.new_discrete_states)(c, &mut event),
            "fmi2EnterContinuousTimeMode" => (api.enter_continuous_time_mode)(c),
            "fmi2CompletedIntegratorStep" => {
                (api.completed_integrator_step)(c, 1, &mut integer, &mut flag)
            }
            "fmi2SetTime" => (api.set_time)(c, 0.0),
            "fmi2SetContinuousStates" => {
                (api.set_continuous_states)(c, LEVEL.as_ptr(), LEVEL.len())
            }
            "fmi2GetDerivatives" => (api.get_derivatives)(c, numbers.as_mut_ptr(), numbers.len()),
            "fmi2GetEventIndicators" => (api.get_event_indicators)(c, null_mut(), 0),
            "fmi2GetContinuousStates" => {
                (api.get_continuous_states)(c, numbers.as_mut_ptr(), numbers.len())
            }
            "fmi2GetNominalsOfContinuousStates" => {
                (api.get_nominals_of_continuous_states)(c, numbers.as_mut_ptr(), numbers.len())
            }
            "fmi2SetRealInputDerivatives" => {
                (api.set_input_derivatives)(c, null(), 0, null(), null())
            }
            "fmi2GetRealOutputDerivatives" => {
                (api.get_output_derivatives)(c, null(), 0, null(), null_mut())
            }
            "fmi2DoStep" => slave.step(0.0, 0.01),
            "fmi2CancelStep" => (api.cancel_step)(c),
            "fmi2GetStatus" => (api.get_status)(c, StatusKind::DO_STEP_STATUS, &mut status),
            "fmi2GetRealStatus" => {
                (api.get_real_status)(c, StatusKind::LAST_SUCCESSFUL_TIME, &mut real)
            }
            "fmi2GetIntegerStatus" => {
                (api.get_integer_status)(c, StatusKind::TERMINATED, &mut integer)
            }
            "fmi2GetBooleanStatus" => {
                (api.get_boolean_status)(c, StatusKind::TERMINATED, &mut integer)
            }
            "fmi2GetStringStatus" => {
                (api.get_string_status)(c, StatusKind::PENDING_STATUS, &mut text)
            }
            other => panic!("{other} has no arguments here"),
        }
    }
}

/// What a legal call with those arguments returns. The state error is that of an impossible trim.
fn legal_result(name: &str, phase: Phase) -> Status {
    match name {
        "fmi2GetDerivatives" | "fmi2GetContinuousStates" if phase == Phase::Error => Status::Error,
        // Section 4.2.3: status that cannot be retrieved is discarded.
        "fmi2GetStatus" | "fmi2GetIntegerStatus" | "fmi2GetStringStatus" => Status::Discard,
        _ => Status::Ok,
    }
}

#[test]
fn every_function_in_every_state_is_allowed_or_refused_as_the_standard_says() {
    let api = Api::load();
    for phase in REACHABLE {
        for (name, _) in STANDARD {
            let slave = match phase {
                Phase::EventMode | Phase::ContinuousTimeMode => Slave::exchange(&api),
                _ => Slave::new(&api),
            };
            bring_to(&slave, phase);
            let before = slave.save();
            let status = call(&slave, name);
            if standard_allows(name, phase) {
                assert_eq!(status, legal_result(name, phase), "{name} {phase} {:?}", slave.log());
            } else {
                assert_eq!(status, Status::Error, "{name} in {phase}");
                let message = slave.message().message;
                assert!(message.starts_with(&format!("{name}: not allowed in state {phase}")));
                let after = slave.save();
                assert_eq!(slave.bytes(before), slave.bytes(after), "{name} changed {phase}");
                slave.free(after);
            }
            slave.free(before);
        }
    }
}

#[test]
fn initialisation_needs_an_experiment() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(slave.enter(), Status::Error);
    assert!(slave.message().message.contains("fmi2SetupExperiment"));
    assert_eq!(slave.setup(), Status::Ok);
    assert_eq!(slave.enter(), Status::Ok);
}

#[test]
fn an_impossible_trim_is_an_error_with_its_reason_and_the_instance_can_be_reset() {
    let api = Api::load();
    let slave = Slave::new(&api);
    bring_to(&slave, Phase::InitializationMode);
    assert_eq!(slave.set("mach0", 2.0), Status::Ok);
    let (status, values) = slave.reals(&[reference("V")]);
    assert!(status == Status::Error && values[0].is_nan(), "an output of an impossible trim");
    slave.log();
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
    assert_eq!(slave.set_integer("configuration", configuration), Status::Ok);
    assert_eq!(slave.setup_with(Some(1e-7), 3.0, Some(4.0)), Status::Ok);
    assert_eq!(slave.enter(), Status::Ok);
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
