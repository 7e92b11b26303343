//! Legal order of calls of FMI 3.0, and each function with harmless arguments.

use super::{Order, call_on_states, first, nominals};
use crate::master::Slave;
use crate::master::v3::{Api, UNKNOWN};
use fmi_model::phase::Phase;
use fmi_model::v3::sys::{Boolean, Status};
use fmi_model::{Kind, Model, Role};
use std::ptr::{null, null_mut};

/// The lists of FMI 3.0.2, sections 2.3, 3.2 and 4.2, typed from the standard: columns instantiated,
/// initialization mode, event mode, continuous-time mode, step mode, the same after the FMU asked to end,
/// intermediate update mode, terminated, the same because of an error. Event mode is that of model exchange:
/// in co-simulation, as all of configuration, it needs a capability that no model here has. M: what importers
/// do and the standard does not list, of model exchange; it harms nobody.
#[rustfmt::skip]
const TABLE: [(&str, &str); 70] = [
    ("fmi3SetDebugLogging", "xxxxxx xx"),
    ("fmi3EnterInitializationMode", "x        "),
    ("fmi3ExitInitializationMode", " x       "),
    ("fmi3EnterEventMode", "   x     "),
    ("fmi3Terminate", "  xxxx   "),
    ("fmi3Reset", "xxxxxx xx"),
    ("fmi3GetFloat32", "xxxxxxxxx"),
    ("fmi3GetFloat64", "xxxxxxxxx"),
    ("fmi3GetInt8", "xxxxxxxxx"),
    ("fmi3GetUInt8", "xxxxxxxxx"),
    ("fmi3GetInt16", "xxxxxxxxx"),
    ("fmi3GetUInt16", "xxxxxxxxx"),
    ("fmi3GetInt32", "xxxxxxxxx"),
    ("fmi3GetUInt32", "xxxxxxxxx"),
    ("fmi3GetInt64", "xxxxxxxxx"),
    ("fmi3GetUInt64", "xxxxxxxxx"),
    ("fmi3GetBoolean", "xxxxxxxxx"),
    ("fmi3GetString", "xxxxxxxxx"),
    ("fmi3GetBinary", "xxxxxxxxx"),
    ("fmi3GetClock", "  x      "),
    ("fmi3SetFloat32", "xxxxxxx  "),
    ("fmi3SetFloat64", "xxxxxxx  "),
    ("fmi3SetInt8", "xxx xx   "),
    ("fmi3SetUInt8", "xxx xx   "),
    ("fmi3SetInt16", "xxx xx   "),
    ("fmi3SetUInt16", "xxx xx   "),
    ("fmi3SetInt32", "xxx xx   "),
    ("fmi3SetUInt32", "xxx xx   "),
    ("fmi3SetInt64", "xxx xx   "),
    ("fmi3SetUInt64", "xxx xx   "),
    ("fmi3SetBoolean", "xxx xx   "),
    ("fmi3SetString", "xxx xx   "),
    ("fmi3SetBinary", "xxx xx   "),
    ("fmi3SetClock", "  x      "),
    ("fmi3GetNumberOfVariableDependencies", "xxxxxxxxx"),
    ("fmi3GetVariableDependencies", "xxxxxxxxx"),
    ("fmi3GetFMUState", "xxxxxx xx"),
    ("fmi3SetFMUState", "xxxxxx xx"),
    ("fmi3FreeFMUState", "xxxxxx xx"),
    ("fmi3SerializedFMUStateSize", "xxxxxx xx"),
    ("fmi3SerializeFMUState", "xxxxxx xx"),
    ("fmi3DeserializeFMUState", "xxxxxx xx"),
    ("fmi3GetDirectionalDerivative", " xxxxx xx"),
    ("fmi3GetAdjointDerivative", " xxxxx xx"),
    ("fmi3EnterConfigurationMode", "         "),
    ("fmi3ExitConfigurationMode", "         "),
    ("fmi3GetIntervalDecimal", " xx      "),
    ("fmi3GetIntervalFraction", " xx      "),
    ("fmi3GetShiftDecimal", " x       "),
    ("fmi3GetShiftFraction", " x       "),
    ("fmi3SetIntervalDecimal", " xx      "),
    ("fmi3SetIntervalFraction", " xx      "),
    ("fmi3SetShiftDecimal", " x       "),
    ("fmi3SetShiftFraction", " x       "),
    ("fmi3EvaluateDiscreteStates", "  x      "),
    ("fmi3UpdateDiscreteStates", "  x      "),
    ("fmi3EnterContinuousTimeMode", "  m      "),
    ("fmi3CompletedIntegratorStep", "   m     "),
    ("fmi3SetTime", "  Mm     "),
    ("fmi3SetContinuousStates", "   m     "),
    ("fmi3GetContinuousStateDerivatives", " mmm   mm"),
    ("fmi3GetEventIndicators", " mmm   mm"),
    ("fmi3GetContinuousStates", " mmm   mm"),
    ("fmi3GetNominalsOfContinuousStates", " mmm   mm"),
    ("fmi3GetNumberOfEventIndicators", "mMmM   MM"),
    ("fmi3GetNumberOfContinuousStates", "mMmM   MM"),
    ("fmi3EnterStepMode", "  c      "),
    ("fmi3GetOutputDerivatives", "    xxxcc"),
    ("fmi3DoStep", "    x    "),
    ("fmi3ActivateModelPartition", "         "),
];

impl<M: Model> Order for Api<M> {
    const TABLE: &'static [(&'static str, &'static str)] = &TABLE;
    const COLUMNS: &'static [Phase] = &[
        Phase::Instantiated,
        Phase::InitializationMode,
        Phase::EventMode,
        Phase::ContinuousTimeMode,
        Phase::StepComplete,
        Phase::StepFailed,
        Phase::IntermediateUpdateMode,
        Phase::Terminated,
        Phase::Error,
    ];

    fn call(slave: &Slave<Self>, other: &Slave<Self>, name: &str) -> Status {
        if name.ends_with("FMUState") || name.ends_with("FMUStateSize") {
            return call_on_states(slave, other, name);
        }
        if name.contains("Interval") || name.contains("Shift") || name.contains("Clock") {
            return clocks(slave, name);
        }
        values(slave, name).unwrap_or_else(|| call(slave, name))
    }

    /// The state of an error is that of a start that failed.
    fn legal_result(name: &str, phase: Phase) -> Status {
        match name {
            "fmi3GetContinuousStateDerivatives" | "fmi3GetContinuousStates"
                if phase == Phase::Error =>
            {
                Status::Error
            }
            "fmi3GetNumberOfVariableDependencies"
            | "fmi3GetVariableDependencies"
            | "fmi3EvaluateDiscreteStates" => Status::Error,
            _ => Status::Ok,
        }
    }
}

/// A getter or setter of a type.
fn values<M: Model>(slave: &Slave<Api<M>>, name: &str) -> Option<Status> {
    let (api, c) = (slave.api, slave.c);
    let (mut real, mut integer, mut flag, one) = (0.0, 0, UNKNOWN, [0.0]);
    let input = first::<M>(|variable| matches!(variable.role, Role::Input(_)));
    let enumeration = first::<M>(|variable| matches!(variable.kind, Kind::Enumeration(..)));
    let boolean = first::<M>(|variable| matches!(variable.kind, Kind::Boolean));
    let of = |references: &[u32]| (references.as_ptr(), references.len());
    let (u, e, b) = (of(&input), of(&enumeration), of(&boolean));
    // SAFETY: the arguments are valid.
    Some(unsafe {
        match name {
            "fmi3GetFloat64" => (api.get_float64)(c, u.0, u.1, &mut real, u.1),
            "fmi3SetFloat64" => (api.set_float64)(c, u.0, u.1, one.as_ptr(), u.1),
            "fmi3GetInt64" => (api.get_int64)(c, e.0, e.1, &mut integer, e.1),
            "fmi3GetBoolean" => (api.get_boolean)(c, b.0, b.1, &mut flag, b.1),
            "fmi3GetFloat32" => (api.get_float32)(c, null(), 0, null_mut(), 0),
            "fmi3GetInt8" => (api.get_int8)(c, null(), 0, null_mut(), 0),
            "fmi3GetUInt8" => (api.get_uint8)(c, null(), 0, null_mut(), 0),
            "fmi3GetInt16" => (api.get_int16)(c, null(), 0, null_mut(), 0),
            "fmi3GetUInt16" => (api.get_uint16)(c, null(), 0, null_mut(), 0),
            "fmi3GetInt32" => (api.get_int32)(c, null(), 0, null_mut(), 0),
            "fmi3GetUInt32" => (api.get_uint32)(c, null(), 0, null_mut(), 0),
            "fmi3GetUInt64" => (api.get_uint64)(c, null(), 0, null_mut(), 0),
            "fmi3GetString" => (api.get_string)(c, null(), 0, null_mut(), 0),
            "fmi3SetFloat32" => (api.set_float32)(c, null(), 0, null(), 0),
            "fmi3SetInt8" => (api.set_int8)(c, null(), 0, null(), 0),
            "fmi3SetUInt8" => (api.set_uint8)(c, null(), 0, null(), 0),
            "fmi3SetInt16" => (api.set_int16)(c, null(), 0, null(), 0),
            "fmi3SetUInt16" => (api.set_uint16)(c, null(), 0, null(), 0),
            "fmi3SetInt32" => (api.set_int32)(c, null(), 0, null(), 0),
            "fmi3SetUInt32" => (api.set_uint32)(c, null(), 0, null(), 0),
            "fmi3SetInt64" => (api.set_int64)(c, null(), 0, null(), 0),
            "fmi3SetUInt64" => (api.set_uint64)(c, null(), 0, null(), 0),
            "fmi3SetBoolean" => (api.set_boolean)(c, null(), 0, null(), 0),
            "fmi3SetString" => (api.set_string)(c, null(), 0, null(), 0),
            "fmi3GetBinary" => (api.get_binary)(c, null(), 0, null_mut(), null_mut(), 0),
            "fmi3SetBinary" => (api.set_binary)(c, null(), 0, null(), null(), 0),
            _ => return None,
        }
    })
}

/// A function of clocks, of none.
fn clocks<M: Model>(slave: &Slave<Api<M>>, name: &str) -> Status {
    let (api, c) = (slave.api, slave.c);
    let (none, no) = (null(), null_mut());
    // SAFETY: the arguments are valid.
    unsafe {
        match name {
            "fmi3GetClock" => (api.get_clock)(c, none, 0, null_mut()),
            "fmi3SetClock" => (api.set_clock)(c, none, 0, null()),
            "fmi3GetIntervalDecimal" => (api.get_interval_decimal)(c, none, 0, null_mut(), no),
            "fmi3GetIntervalFraction" => {
                (api.get_interval_fraction)(c, none, 0, null_mut(), null_mut(), no)
            }
            "fmi3GetShiftDecimal" => (api.get_shift_decimal)(c, none, 0, null_mut()),
            "fmi3GetShiftFraction" => (api.get_shift_fraction)(c, none, 0, null_mut(), null_mut()),
            "fmi3SetIntervalDecimal" => (api.set_interval_decimal)(c, none, 0, null()),
            "fmi3SetIntervalFraction" => (api.set_interval_fraction)(c, none, 0, null(), null()),
            "fmi3SetShiftDecimal" => (api.set_shift_decimal)(c, none, 0, null()),
            "fmi3SetShiftFraction" => (api.set_shift_fraction)(c, none, 0, null(), null()),
            other => panic!("{other} has no arguments here"),
        }
    }
}

fn call<M: Model>(slave: &Slave<Api<M>>, name: &str) -> Status {
    let (api, c, no) = (slave.api, slave.c, Boolean::FALSE);
    let (mut real, mut size, mut numbers) = (0.0, 0, nominals::<M>());
    let (x, n) = (numbers.as_mut_ptr(), numbers.len());
    let [mut one, mut two, mut three, mut four, mut five] = [UNKNOWN; 5];
    // SAFETY: the arguments are valid.
    unsafe {
        match name {
            "fmi3SetDebugLogging" => (api.set_debug_logging)(c, no, 0, null()),
            "fmi3EnterInitializationMode" => slave.begin(),
            "fmi3ExitInitializationMode" => slave.exit(),
            "fmi3EnterEventMode" => (api.enter_event_mode)(c),
            "fmi3Terminate" => slave.terminate(),
            "fmi3Reset" => slave.reset(),
            "fmi3GetNumberOfVariableDependencies" => {
                (api.get_number_of_variable_dependencies)(c, 0, &mut size)
            }
            "fmi3GetVariableDependencies" => {
                let (indices, kinds) = (null_mut(), null_mut());
                (api.get_variable_dependencies)(c, 0, indices, null_mut(), indices, kinds, 0)
            }
            "fmi3GetDirectionalDerivative" | "fmi3GetAdjointDerivative" => {
                let function = match name {
                    "fmi3GetAdjointDerivative" => api.adjoint_derivative,
                    _ => api.directional_derivative,
                };
                function(c, null(), 0, null(), 0, null(), 0, null_mut(), 0)
            }
            "fmi3EnterConfigurationMode" => (api.enter_configuration_mode)(c),
            "fmi3ExitConfigurationMode" => (api.exit_configuration_mode)(c),
            "fmi3EvaluateDiscreteStates" => (api.evaluate_discrete_states)(c),
            "fmi3UpdateDiscreteStates" => {
                let update = api.update_discrete_states;
                update(c, &mut one, &mut two, &mut three, &mut four, &mut five, &mut real)
            }
            "fmi3EnterContinuousTimeMode" => (api.enter_continuous_time_mode)(c),
            "fmi3CompletedIntegratorStep" => {
                (api.completed_integrator_step)(c, no, &mut one, &mut two)
            }
            "fmi3SetTime" => (api.set_time)(c, 0.0),
            "fmi3SetContinuousStates" => (api.set_continuous_states)(c, x, n),
            "fmi3GetContinuousStateDerivatives" => (api.get_derivatives)(c, x, n),
            "fmi3GetEventIndicators" => (api.get_event_indicators)(c, null_mut(), 0),
            "fmi3GetContinuousStates" => (api.get_continuous_states)(c, x, n),
            "fmi3GetNominalsOfContinuousStates" => (api.get_nominals_of_continuous_states)(c, x, n),
            "fmi3GetNumberOfEventIndicators" => (api.get_number_of_event_indicators)(c, &mut size),
            "fmi3GetNumberOfContinuousStates" => {
                (api.get_number_of_continuous_states)(c, &mut size)
            }
            "fmi3EnterStepMode" => (api.enter_step_mode)(c),
            "fmi3GetOutputDerivatives" => {
                (api.get_output_derivatives)(c, null(), 0, null(), null_mut(), 0)
            }
            "fmi3DoStep" => {
                let step = api.do_step;
                step(c, 0.0, 0.01, no, &mut one, &mut two, &mut three, &mut real)
            }
            "fmi3ActivateModelPartition" => (api.activate_model_partition)(c, 0, 0.0),
            other => panic!("{other} has no arguments here"),
        }
    }
}
