//! Legal order of calls, as data: sections 2.3, 3.2 and 4.2 of FMI 3.0.2.
//!
//! There is no configuration mode (no structural parameters), no reconfiguration and no clock activation mode;
//! step mode is left for event mode only by a master that says `eventModeUsed`, which is refused.
//!
//! Wider than the standard, as importers do it and it harms nobody: the numbers of states and event indicators in
//! all states, as fmi-rs asks for them between events, and the time in event mode, as in FMI 2.0.

use crate::instance::Interface;
use crate::phase::{Call, Phase, calls};
use crate::standard::Standard;

const INSTANTIATED: u16 = Phase::Instantiated.bit();
const INITIALIZATION: u16 = Phase::InitializationMode.bit();
const STEP: u16 = Phase::StepComplete.bit();
const ENDED: u16 = Phase::StepFailed.bit();
const TERMINATED: u16 = Phase::Terminated.bit() | Phase::Error.bit();
const EVENT: u16 = Phase::EventMode.bit();
const CONTINUOUS: u16 = Phase::ContinuousTimeMode.bit();
const INTERMEDIATE: u16 = Phase::IntermediateUpdateMode.bit();
const NEVER: u16 = 0;

const INITIALIZED: u16 = STEP | ENDED | EVENT | CONTINUOUS;
const SETTABLE: u16 = INSTANTIATED | INITIALIZATION | INITIALIZED | TERMINATED;
const READ: u16 = SETTABLE | INTERMEDIATE;
const WRITE: u16 = INSTANTIATED | INITIALIZATION | STEP | ENDED | EVENT;
const WRITE_CONTINUOUS: u16 = WRITE | CONTINUOUS | INTERMEDIATE;
const EXCHANGE: u16 = INITIALIZATION | EVENT | CONTINUOUS | TERMINATED;
const INTERVALS: u16 = INITIALIZATION | EVENT;

calls! { Fmi3:
    SET_DEBUG_LOGGING "fmi3SetDebugLogging" SETTABLE;
    ENTER_INITIALIZATION_MODE "fmi3EnterInitializationMode" INSTANTIATED;
    EXIT_INITIALIZATION_MODE "fmi3ExitInitializationMode" INITIALIZATION;
    ENTER_EVENT_MODE "fmi3EnterEventMode" CONTINUOUS;
    TERMINATE "fmi3Terminate" INITIALIZED;
    RESET "fmi3Reset" SETTABLE;
    GET_FLOAT32 "fmi3GetFloat32" READ;
    GET_FLOAT64 "fmi3GetFloat64" READ;
    GET_INT8 "fmi3GetInt8" READ;
    GET_UINT8 "fmi3GetUInt8" READ;
    GET_INT16 "fmi3GetInt16" READ;
    GET_UINT16 "fmi3GetUInt16" READ;
    GET_INT32 "fmi3GetInt32" READ;
    GET_UINT32 "fmi3GetUInt32" READ;
    GET_INT64 "fmi3GetInt64" READ;
    GET_UINT64 "fmi3GetUInt64" READ;
    GET_BOOLEAN "fmi3GetBoolean" READ;
    GET_STRING "fmi3GetString" READ;
    GET_BINARY "fmi3GetBinary" READ;
    GET_CLOCK "fmi3GetClock" EVENT;
    SET_FLOAT32 "fmi3SetFloat32" WRITE_CONTINUOUS;
    SET_FLOAT64 "fmi3SetFloat64" WRITE_CONTINUOUS;
    SET_INT8 "fmi3SetInt8" WRITE;
    SET_UINT8 "fmi3SetUInt8" WRITE;
    SET_INT16 "fmi3SetInt16" WRITE;
    SET_UINT16 "fmi3SetUInt16" WRITE;
    SET_INT32 "fmi3SetInt32" WRITE;
    SET_UINT32 "fmi3SetUInt32" WRITE;
    SET_INT64 "fmi3SetInt64" WRITE;
    SET_UINT64 "fmi3SetUInt64" WRITE;
    SET_BOOLEAN "fmi3SetBoolean" WRITE;
    SET_STRING "fmi3SetString" WRITE;
    SET_BINARY "fmi3SetBinary" WRITE;
    SET_CLOCK "fmi3SetClock" EVENT;
    GET_NUMBER_OF_VARIABLE_DEPENDENCIES "fmi3GetNumberOfVariableDependencies" READ;
    GET_VARIABLE_DEPENDENCIES "fmi3GetVariableDependencies" READ;
    GET_FMU_STATE "fmi3GetFMUState" SETTABLE;
    SET_FMU_STATE "fmi3SetFMUState" SETTABLE;
    FREE_FMU_STATE "fmi3FreeFMUState" SETTABLE;
    SERIALIZED_FMU_STATE_SIZE "fmi3SerializedFMUStateSize" SETTABLE;
    SERIALIZE_FMU_STATE "fmi3SerializeFMUState" SETTABLE;
    DESERIALIZE_FMU_STATE "fmi3DeserializeFMUState" SETTABLE;
    GET_DIRECTIONAL_DERIVATIVE "fmi3GetDirectionalDerivative" INITIALIZATION | INITIALIZED | TERMINATED;
    GET_ADJOINT_DERIVATIVE "fmi3GetAdjointDerivative" INITIALIZATION | INITIALIZED | TERMINATED;
    ENTER_CONFIGURATION_MODE "fmi3EnterConfigurationMode" NEVER;
    EXIT_CONFIGURATION_MODE "fmi3ExitConfigurationMode" NEVER;
    GET_INTERVAL_DECIMAL "fmi3GetIntervalDecimal" INTERVALS;
    GET_INTERVAL_FRACTION "fmi3GetIntervalFraction" INTERVALS;
    GET_SHIFT_DECIMAL "fmi3GetShiftDecimal" INITIALIZATION;
    GET_SHIFT_FRACTION "fmi3GetShiftFraction" INITIALIZATION;
    SET_INTERVAL_DECIMAL "fmi3SetIntervalDecimal" INTERVALS;
    SET_INTERVAL_FRACTION "fmi3SetIntervalFraction" INTERVALS;
    SET_SHIFT_DECIMAL "fmi3SetShiftDecimal" INITIALIZATION;
    SET_SHIFT_FRACTION "fmi3SetShiftFraction" INITIALIZATION;
    EVALUATE_DISCRETE_STATES "fmi3EvaluateDiscreteStates" EVENT;
    UPDATE_DISCRETE_STATES "fmi3UpdateDiscreteStates" EVENT;
    ENTER_CONTINUOUS_TIME_MODE "fmi3EnterContinuousTimeMode" EVENT, only ModelExchange;
    COMPLETED_INTEGRATOR_STEP "fmi3CompletedIntegratorStep" CONTINUOUS, only ModelExchange;
    SET_TIME "fmi3SetTime" EVENT | CONTINUOUS, only ModelExchange;
    SET_CONTINUOUS_STATES "fmi3SetContinuousStates" CONTINUOUS, only ModelExchange;
    GET_CONTINUOUS_STATE_DERIVATIVES "fmi3GetContinuousStateDerivatives" EXCHANGE, only ModelExchange;
    GET_EVENT_INDICATORS "fmi3GetEventIndicators" EXCHANGE, only ModelExchange;
    GET_CONTINUOUS_STATES "fmi3GetContinuousStates" EXCHANGE, only ModelExchange;
    GET_NOMINALS_OF_CONTINUOUS_STATES "fmi3GetNominalsOfContinuousStates" EXCHANGE, only ModelExchange;
    GET_NUMBER_OF_EVENT_INDICATORS "fmi3GetNumberOfEventIndicators" INSTANTIATED | EXCHANGE, only ModelExchange;
    GET_NUMBER_OF_CONTINUOUS_STATES "fmi3GetNumberOfContinuousStates" INSTANTIATED | EXCHANGE, only ModelExchange;
    ENTER_STEP_MODE "fmi3EnterStepMode" EVENT, only CoSimulation;
    GET_OUTPUT_DERIVATIVES "fmi3GetOutputDerivatives" STEP | ENDED | TERMINATED | INTERMEDIATE, only CoSimulation;
    DO_STEP "fmi3DoStep" STEP, only CoSimulation;
    ACTIVATE_MODEL_PARTITION "fmi3ActivateModelPartition" NEVER;
}

/// The legs of `fmi3DoStep` after the first: the master's callback has returned.
pub(crate) const RESUME_STEP: Call = Call { allowed: INTERMEDIATE, ..DO_STEP };
