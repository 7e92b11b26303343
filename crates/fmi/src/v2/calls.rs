//! Legal order of calls, as data: the tables of FMI 2.0.5, sections 3.2.3 and 4.2.4.

use crate::phase::{Call, Phase, calls};
use crate::standard::Standard;

const INSTANTIATED: u16 = Phase::Instantiated.bit();
const INITIALIZATION: u16 = Phase::InitializationMode.bit();
const COMPLETE: u16 = Phase::StepComplete.bit();
const IN_PROGRESS: u16 = Phase::StepInProgress.bit();
const FAILED: u16 = Phase::StepFailed.bit();
const CANCELED: u16 = Phase::StepCanceled.bit();
const TERMINATED: u16 = Phase::Terminated.bit();
const ERROR: u16 = Phase::Error.bit();
const EVENT: u16 = Phase::EventMode.bit();
const CONTINUOUS: u16 = Phase::ContinuousTimeMode.bit();

const AFTER_STEP: u16 = COMPLETE | FAILED | CANCELED | TERMINATED | ERROR;
const EXCHANGE: u16 = EVENT | CONTINUOUS;
const READ: u16 = INITIALIZATION | AFTER_STEP | EXCHANGE;
const AT_REST: u16 = INSTANTIATED | READ;
const WRITE: u16 = INSTANTIATED | INITIALIZATION | COMPLETE | EVENT;
const READ_EXCHANGE: u16 = EXCHANGE | TERMINATED | ERROR;
const STATUS: u16 = COMPLETE | IN_PROGRESS | FAILED | TERMINATED;

calls! { Fmi2:
    SET_DEBUG_LOGGING "fmi2SetDebugLogging" AT_REST | IN_PROGRESS;
    SETUP_EXPERIMENT "fmi2SetupExperiment" INSTANTIATED;
    ENTER_INITIALIZATION_MODE "fmi2EnterInitializationMode" INSTANTIATED;
    EXIT_INITIALIZATION_MODE "fmi2ExitInitializationMode" INITIALIZATION;
    TERMINATE "fmi2Terminate" COMPLETE | FAILED | EXCHANGE;
    RESET "fmi2Reset" AT_REST;
    GET_REAL "fmi2GetReal" READ;
    GET_INTEGER "fmi2GetInteger" READ;
    GET_BOOLEAN "fmi2GetBoolean" READ;
    GET_STRING "fmi2GetString" READ;
    SET_REAL "fmi2SetReal" WRITE | CONTINUOUS;
    SET_INTEGER "fmi2SetInteger" WRITE;
    SET_BOOLEAN "fmi2SetBoolean" WRITE;
    SET_STRING "fmi2SetString" WRITE;
    GET_FMU_STATE "fmi2GetFMUstate" AT_REST;
    SET_FMU_STATE "fmi2SetFMUstate" AT_REST;
    FREE_FMU_STATE "fmi2FreeFMUstate" AT_REST;
    SERIALIZED_FMU_STATE_SIZE "fmi2SerializedFMUstateSize" AT_REST;
    SERIALIZE_FMU_STATE "fmi2SerializeFMUstate" AT_REST;
    DESERIALIZE_FMU_STATE "fmi2DeSerializeFMUstate" AT_REST;
    GET_DIRECTIONAL_DERIVATIVE "fmi2GetDirectionalDerivative" READ;
    ENTER_EVENT_MODE "fmi2EnterEventMode" EXCHANGE;
    NEW_DISCRETE_STATES "fmi2NewDiscreteStates" EVENT;
    ENTER_CONTINUOUS_TIME_MODE "fmi2EnterContinuousTimeMode" EVENT;
    COMPLETED_INTEGRATOR_STEP "fmi2CompletedIntegratorStep" CONTINUOUS;
    SET_TIME "fmi2SetTime" EXCHANGE;
    SET_CONTINUOUS_STATES "fmi2SetContinuousStates" CONTINUOUS;
    GET_DERIVATIVES "fmi2GetDerivatives" READ_EXCHANGE;
    GET_EVENT_INDICATORS "fmi2GetEventIndicators" READ_EXCHANGE | INITIALIZATION;
    GET_CONTINUOUS_STATES "fmi2GetContinuousStates" READ_EXCHANGE | INITIALIZATION;
    GET_NOMINALS_OF_CONTINUOUS_STATES "fmi2GetNominalsOfContinuousStates" READ_EXCHANGE | INSTANTIATED;
    SET_REAL_INPUT_DERIVATIVES "fmi2SetRealInputDerivatives" INSTANTIATED | INITIALIZATION | COMPLETE;
    GET_REAL_OUTPUT_DERIVATIVES "fmi2GetRealOutputDerivatives" AFTER_STEP;
    DO_STEP "fmi2DoStep" COMPLETE;
    CANCEL_STEP "fmi2CancelStep" IN_PROGRESS;
    GET_STATUS "fmi2GetStatus" STATUS;
    GET_REAL_STATUS "fmi2GetRealStatus" STATUS;
    GET_INTEGER_STATUS "fmi2GetIntegerStatus" STATUS;
    GET_BOOLEAN_STATUS "fmi2GetBooleanStatus" STATUS;
    GET_STRING_STATUS "fmi2GetStringStatus" STATUS;
}
