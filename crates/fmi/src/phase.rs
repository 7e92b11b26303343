//! States of an instance, and which calls are legal in them.
//!
//! The tables themselves are in `v2::calls` and `v3::calls`. Conditions of the standards that concern single
//! variables are checked where values are read and set; in the tables they count as allowed.

use crate::instance::Interface;
use crate::standard::Standard;

/// State of an instance. The numbers are part of the FMU state's bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
    /// New, or reset.
    Instantiated = 0,
    /// Initialization mode.
    InitializationMode = 1,
    /// Ready for the next step.
    StepComplete = 2,
    /// During an asynchronous step of FMI 2.0: never here.
    StepInProgress = 3,
    /// A step ended early, and the simulation can only end.
    StepFailed = 4,
    /// An asynchronous step of FMI 2.0 was cancelled: never here.
    StepCanceled = 5,
    /// Terminated by the master.
    Terminated = 6,
    /// The run cannot go on; reset, or restore an FMU state.
    Error = 7,
    /// The instance cannot be trusted any more; free it.
    Fatal = 8,
    /// Model Exchange: at an event.
    EventMode = 9,
    /// Model Exchange: between events.
    ContinuousTimeMode = 10,
    /// Within a step of FMI 3.0, while the master's callback runs.
    IntermediateUpdateMode = 11,
}

/// All states, by number.
pub const PHASES: [Phase; 12] = [
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
    Phase::IntermediateUpdateMode,
];

impl Phase {
    /// The bit of this state in the mask of a [`Call`].
    pub const fn bit(self) -> u16 {
        1 << self as u8
    }

    /// Its name in the words of a standard.
    pub const fn name(self, standard: Standard) -> &'static str {
        match (standard, self) {
            (_, Self::Instantiated) => "instantiated",
            (_, Self::InitializationMode) => "initialization mode",
            (Standard::Fmi2, Self::StepComplete) => "step complete",
            (Standard::Fmi3, Self::StepComplete) => "step mode",
            (_, Self::StepInProgress) => "step in progress",
            (Standard::Fmi2, Self::StepFailed) => "step failed",
            (Standard::Fmi3, Self::StepFailed) => "step mode after terminateSimulation",
            (_, Self::StepCanceled) => "step canceled",
            (_, Self::Terminated) => "terminated",
            (Standard::Fmi2, Self::Error) => "error",
            (Standard::Fmi3, Self::Error) => "terminated by an error",
            (_, Self::Fatal) => "fatal",
            (_, Self::EventMode) => "event mode",
            (_, Self::ContinuousTimeMode) => "continuous-time mode",
            (_, Self::IntermediateUpdateMode) => "intermediate update mode",
        }
    }
}

/// A function of a standard that works on an instance.
#[derive(Debug, PartialEq, Eq)]
pub struct Call {
    /// Its name.
    pub name: &'static str,
    /// Its standard.
    pub standard: Standard,
    /// Bits of the states in which it may be called.
    pub allowed: u16,
    /// The only interface that has it.
    pub interface: Option<Interface>,
}

impl Call {
    /// Whether it may be called in this state.
    pub const fn allowed_in(&self, phase: Phase) -> bool {
        self.allowed & phase.bit() != 0
    }

    /// Names of the states in which it may be called.
    pub(crate) fn allowed_names(&self) -> String {
        if self.allowed == 0 {
            return "no state, as the model has nothing for it".to_string();
        }
        let allowed = PHASES.iter().filter(|&&phase| self.allowed_in(phase));
        allowed.map(|phase| phase.name(self.standard)).collect::<Vec<_>>().join(", ")
    }
}

/// A table: one constant per function, and all of them in `CALLS`.
macro_rules! calls {
    ($standard:ident: $($call:ident $name:literal $allowed:expr $(, only $interface:ident)?;)*) => {
        $(
            #[doc = concat!("`", $name, "`.")]
            pub const $call: Call = Call {
                name: $name,
                standard: Standard::$standard,
                allowed: $allowed,
                interface: calls!(@ $($interface)?),
            };
        )*
        /// All functions that work on an instance, but the one that frees it: that one always frees,
        /// also in the state fatal, as a refusal would only leak.
        pub const CALLS: &[Call] = &[$($call),*];
    };
    (@) => { None };
    (@ $interface:ident) => { Some(Interface::$interface) };
}
pub(crate) use calls;
