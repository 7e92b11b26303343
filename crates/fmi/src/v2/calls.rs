//! Legal order of calls, as data: the tables of FMI 2.0.5, sections 3.2.3 and 4.2.4.
//!
//! The numbered conditions of that table concern single variables and are checked where values are
//! read and set; here they count as allowed.

use core::fmt;

/// State of an instance, in the words of the standard. The numbers are part of the FMU state's
/// bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated = 0,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    InitializationMode = 1,
    /// Ready for the next step.
    StepComplete = 2,
    /// During an asynchronous step: never here.
    StepInProgress = 3,
    /// A step ended early.
    StepFailed = 4,
    /// An asynchronous step was cancelled: never here.
    StepCanceled = 5,
    /// After `fmi2Terminate`.
    Terminated = 6,
    /// The run cannot go on; reset, or restore an FMU state.
    Error = 7,
    /// The instance cannot be trusted any more; free it.
    Fatal = 8,
    /// Model exchange: at an event.
    EventMode = 9,
    /// Model exchange: between events.
    ContinuousTimeMode = 10,
}

/// All states, by number.
pub const PHASES: [Phase; 11] = [
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

impl Phase {
    /// The bit of this state in the mask of a [`Call`].
    pub const fn bit(self) -> u16 {
        1 << self as u8
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Instantiated => "instantiated",
            Self::InitializationMode => "initialization mode",
            Self::StepComplete => "step complete",
            Self::StepInProgress => "step in progress",
            Self::StepFailed => "step failed",
            Self::StepCanceled => "step canceled",
            Self::Terminated => "terminated",
            Self::Error => "error",
            Self::Fatal => "fatal",
            Self::EventMode => "event mode",
            Self::ContinuousTimeMode => "continuous-time mode",
        })
    }
}

/// A function of the standard that works on an instance.
#[derive(Debug, PartialEq, Eq)]
pub struct Call {
    /// Its name.
    pub name: &'static str,
    /// Bits of the states in which it may be called.
    pub allowed: u16,
}

impl Call {
    /// Whether it may be called in this state.
    pub const fn allowed_in(&self, phase: Phase) -> bool {
        self.allowed & phase.bit() != 0
    }
}

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

/// The table: one constant per function, and all of them in `CALLS`.
macro_rules! calls {
    ($($call:ident $name:literal $allowed:expr;)*) => {
        $(
            #[doc = concat!("`", $name, "`.")]
            pub const $call: Call = Call { name: $name, allowed: $allowed };
        )*
        /// All functions that work on an instance, but `fmi2FreeInstance`: that one always frees,
        /// also in the state fatal, as a refusal would only leak.
        pub const CALLS: &[Call] = &[$($call),*];
    };
}

calls! {
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
