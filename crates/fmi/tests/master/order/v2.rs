//! Legal order of calls of FMI 2.0, and each function with harmless arguments.

use super::{Order, call_on_states, first, nominals};
use crate::master::Slave;
use crate::master::v2::Api;
use fmi_model::phase::Phase;
use fmi_model::v2::sys::{EventInfo, Status, StatusKind};
use fmi_model::{Kind, Model, Role, Simulation};
use std::ptr::{null, null_mut};

/// The tables of FMI 2.0.5, sections 4.2.4 and 3.2.3, typed from the standard: columns instantiated,
/// initialization mode, step complete, step in progress, step failed, step canceled, terminated,
/// error, fatal, event mode, continuous-time mode. Numbered conditions count as x.
#[rustfmt::skip]
const TABLE: [(&str, &str); 40] = [
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

impl<M: Model> Order for Api<M> {
    const TABLE: &'static [(&'static str, &'static str)] = &TABLE;
    const COLUMNS: &'static [Phase] = &[
        Phase::Instantiated,
        Phase::InitializationMode,
        Phase::StepComplete,
        Phase::StepInProgress,
        Phase::StepFailed,
        Phase::StepCanceled,
        Phase::Terminated,
        Phase::Error,
        Phase::Fatal,
        Phase::EventMode,
        Phase::ContinuousTimeMode,
    ];

    fn prepare(slave: &Slave<Self>) {
        assert_eq!(slave.setup(), Status::Ok);
    }
    fn call(slave: &Slave<Self>, other: &Slave<Self>, name: &str) -> Status {
        call(slave, other, name)
    }
    fn legal_result(name: &str, phase: Phase) -> Status {
        legal_result::<M>(name, phase)
    }
}

fn call<M: Model>(slave: &Slave<Api<M>>, other: &Slave<Api<M>>, name: &str) -> Status {
    let (api, c) = (slave.api, slave.c);
    let (mut real, mut integer, mut text, mut status) = (0.0, 0, null(), Status::Ok);
    let (mut flag, one, mut numbers) = (0, [0.0], nominals::<M>());
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
            "fmi2DoStep" => (api.do_step)(c, 0.0, 0.01, 0),
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
            _ => call_on_states(slave, other, name),
        }
    }
}

/// The state error is that of a start that failed.
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
