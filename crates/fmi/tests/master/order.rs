//! Legal order of calls, as the standard has it.

use super::{Api, Slave};
use fmi_model::phase::Phase;
use fmi_model::standard::Standard;
use fmi_model::v2::sys::{EventInfo, Status, StatusKind};
use fmi_model::{Kind, Model, Role, Simulation, Variable, table};
use std::ptr::{null, null_mut};

/// The tables of FMI 2.0.5, sections 4.2.4 and 3.2.3, typed from the standard: columns instantiated,
/// initialization mode, step complete, step in progress, step failed, step canceled, terminated,
/// error, fatal, event mode, continuous-time mode. Numbered conditions count as x.
#[rustfmt::skip]
pub const STANDARD: [(&str, &str); 40] = [
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

/// Whether the standard allows a call in a state.
pub fn allows(name: &str, phase: Phase) -> bool {
    let (_, row) = STANDARD.iter().find(|(row, _)| *row == name).expect(name);
    row.as_bytes()[phase as usize] == b'x'
}

/// Value reference of the first variable that fits, or of none.
fn first<M: Model>(fits: fn(&Variable<M>) -> bool) -> Vec<u32> {
    (0..).zip(M::VARIABLES).filter(|(_, variable)| fits(variable)).map(|(i, _)| i).take(1).collect()
}

/// Calls a function with harmless arguments; `other` has a state that can be restored.
fn call<M: Model>(slave: &Slave<M>, other: &Slave<M>, name: &str) -> Status {
    let (api, c) = (slave.api, slave.c);
    let mut state = null_mut();
    let (mut real, mut integer, mut text, mut status) = (0.0, 0, null(), Status::Ok);
    let (mut size, mut flag, one) = (0, 0, [0.0]);
    let nominal = |i| table::state::<M>(i).nominal.unwrap_or(1.0);
    let mut numbers: Vec<_> = (0..table::states::<M>()).map(nominal).collect();
    let input = first::<M>(|variable| matches!(variable.role, Role::Input(_)));
    let enumeration = first::<M>(|variable| matches!(variable.kind, Kind::Enumeration(..)));
    let boolean = first::<M>(|variable| matches!(variable.kind, Kind::Boolean));
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
            "fmi2GetReal" => (api.get_real)(c, input.as_ptr(), input.len(), &mut real),
            "fmi2GetInteger" => {
                (api.get_integer)(c, enumeration.as_ptr(), enumeration.len(), &mut integer)
            }
            "fmi2GetBoolean" => (api.get_boolean)(c, boolean.as_ptr(), boolean.len(), &mut integer),
            "fmi2GetString" => (api.get_string)(c, null(), 0, null_mut()),
            "fmi2SetReal" => (api.set_real)(c, input.as_ptr(), input.len(), one.as_ptr()),
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
                (api.set_continuous_states)(c, numbers.as_ptr(), numbers.len())
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

/// What a legal call with those arguments returns. The state error is that of a start that failed.
fn legal_result<M: Model>(name: &str, phase: Phase) -> Status {
    let without = |capability: bool| if capability { Status::Ok } else { Status::Error };
    match name {
        "fmi2GetDerivatives" | "fmi2GetContinuousStates" if phase == Phase::Error => Status::Error,
        // Section 4.2.3: status that cannot be retrieved is discarded.
        "fmi2GetStatus" | "fmi2GetIntegerStatus" | "fmi2GetStringStatus" => Status::Discard,
        "fmi2SetRealInputDerivatives" => without(M::Simulation::INPUT_DERIVATIVES.is_some()),
        _ => Status::Ok,
    }
}

/// Every function in every state, of a model that can be saved: done or refused, and then nothing changes.
/// `bring` takes a new instance to a state.
pub fn follow<M: Model>(phases: &[Phase], bring: impl Fn(&Slave<M>, Phase)) {
    let api = Api::load();
    for &phase in phases {
        for (name, _) in STANDARD {
            let slave = match phase {
                Phase::EventMode | Phase::ContinuousTimeMode => Slave::exchange(&api),
                _ => Slave::new(&api),
            };
            bring(&slave, phase);
            slave.log();
            let other = Slave::new(&api);
            bring(&other, Phase::Terminated);
            let before = slave.save();
            let status = call(&slave, &other, name);
            if allows(name, phase) {
                let log = slave.log();
                assert_eq!(status, legal_result::<M>(name, phase), "{name} {phase:?} {log:?}");
            } else {
                assert_eq!(status, Status::Error, "{name} in {phase:?}");
                let (message, state) = (slave.message().message, phase.name(Standard::Fmi2));
                assert!(message.starts_with(&format!("{name}: not allowed in state {state}")));
                let after = slave.save();
                assert_eq!(slave.bytes(before), slave.bytes(after), "{name} changed {phase:?}");
                slave.free(after);
            }
            slave.free(before);
        }
    }
}
