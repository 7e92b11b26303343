//! C types of FMI 2.0 (`fmi2TypesPlatform.h`, `fmi2FunctionTypes.h`), written by hand and proved
//! against the official headers by `tests/headers.rs`.

pub use crate::status::Status;
use core::ffi::{c_char, c_double, c_int, c_uint, c_void};

/// `fmi2Component`.
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`.
pub type ComponentEnvironment = *mut c_void;
/// `fmi2FMUstate`.
pub type FmuState = *mut c_void;
/// `fmi2ValueReference`.
pub type ValueReference = c_uint;
/// `fmi2Real`.
pub type Real = c_double;
/// `fmi2Integer`.
pub type Integer = c_int;
/// `fmi2Boolean`: [`TRUE`] or [`FALSE`].
pub type Boolean = c_int;
/// `fmi2String`.
pub type FmiString = *const c_char;
/// `fmi2Byte`.
pub type Byte = c_char;

/// `fmi2True`.
pub const TRUE: Boolean = 1;
/// `fmi2False`.
pub const FALSE: Boolean = 0;

/// `fmi2Type`. A master may pass any number, so this is no Rust enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(transparent)]
pub struct Type(pub c_uint);

impl Type {
    /// `fmi2ModelExchange`.
    pub const MODEL_EXCHANGE: Self = Self(0);
    /// `fmi2CoSimulation`.
    pub const CO_SIMULATION: Self = Self(1);
}

/// `fmi2StatusKind`. A master may pass any number, so this is no Rust enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(transparent)]
pub struct StatusKind(pub c_uint);

impl StatusKind {
    /// `fmi2DoStepStatus`.
    pub const DO_STEP_STATUS: Self = Self(0);
    /// `fmi2PendingStatus`.
    pub const PENDING_STATUS: Self = Self(1);
    /// `fmi2LastSuccessfulTime`.
    pub const LAST_SUCCESSFUL_TIME: Self = Self(2);
    /// `fmi2Terminated`.
    pub const TERMINATED: Self = Self(3);
}

/// `fmi2CallbackLogger`.
pub type CallbackLogger = unsafe extern "C" fn(
    environment: ComponentEnvironment,
    instance_name: FmiString,
    status: Status,
    category: FmiString,
    message: FmiString,
    ...
);
/// `fmi2CallbackAllocateMemory`.
pub type CallbackAllocateMemory = unsafe extern "C" fn(count: usize, size: usize) -> *mut c_void;
/// `fmi2CallbackFreeMemory`.
pub type CallbackFreeMemory = unsafe extern "C" fn(object: *mut c_void);
/// `fmi2StepFinished`.
pub type StepFinished = unsafe extern "C" fn(environment: ComponentEnvironment, status: Status);

/// `fmi2CallbackFunctions`. Any of the functions may be NULL.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct CallbackFunctions {
    /// Takes messages.
    pub logger: Option<CallbackLogger>,
    /// Not used, as `canNotUseMemoryManagementFunctions` is true.
    pub allocate_memory: Option<CallbackAllocateMemory>,
    /// Not used, as `canNotUseMemoryManagementFunctions` is true.
    pub free_memory: Option<CallbackFreeMemory>,
    /// Not used, as steps are synchronous.
    pub step_finished: Option<StepFinished>,
    /// Passed back to the callbacks.
    pub environment: ComponentEnvironment,
}

/// `fmi2EventInfo`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C)]
pub struct EventInfo {
    /// Whether the event iteration has to go on.
    pub new_discrete_states_needed: Boolean,
    /// Whether the simulation should end.
    pub terminate_simulation: Boolean,
    /// Whether a nominal value changed.
    pub nominals_of_continuous_states_changed: Boolean,
    /// Whether a continuous state jumped.
    pub values_of_continuous_states_changed: Boolean,
    /// Whether the next value is defined.
    pub next_event_time_defined: Boolean,
    /// Time of the next event, s.
    pub next_event_time: Real,
}

/// Types of the exported functions: `fmi2GetVersionTYPE` is `GetVersion` here.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_types {
    ([] $($function:ident $c:ident ($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        $(
            #[doc = concat!("`", stringify!($c), "TYPE`.")]
            pub type $function = unsafe extern "C" fn($($type),*) $(-> $result)?;
        )*
        /// The standard's name of each function and the Rust type that stands for it.
        pub fn signatures() -> Vec<(&'static str, &'static str)> {
            vec![$((stringify!($c), core::any::type_name::<$function>())),*]
        }
    };
}

crate::__fmi2_functions!(__fmi2_types);
