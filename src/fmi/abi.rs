//! The exported functions: the only unsafe code, and the only `fmi2` symbols.
//!
//! Each function turns C arguments into Rust ones and makes one call through the guard. What a
//! master has to grant is what the standard demands: an instance that `fmi2Instantiate` returned
//! and `fmi2FreeInstance` has not freed, used by one thread at a time, and arrays of the length it
//! states. NULL is refused, not trusted.

#![allow(unsafe_code)]
// The names are those of the standard.
#![allow(non_snake_case)]

mod common;
mod cosimulation;
mod entry;
mod exchange;
mod state;
mod values;

/// Each exported function is what `sys` says it is.
mod signatures {
    use super::{common::*, cosimulation::*, exchange::*, state::*, values::*};
    use crate::fmi::sys;

    const _: sys::GetTypesPlatform = fmi2GetTypesPlatform;
    const _: sys::GetVersion = fmi2GetVersion;
    const _: sys::SetDebugLogging = fmi2SetDebugLogging;
    const _: sys::Instantiate = fmi2Instantiate;
    const _: sys::FreeInstance = fmi2FreeInstance;
    const _: sys::SetupExperiment = fmi2SetupExperiment;
    const _: sys::EnterInitializationMode = fmi2EnterInitializationMode;
    const _: sys::ExitInitializationMode = fmi2ExitInitializationMode;
    const _: sys::Terminate = fmi2Terminate;
    const _: sys::Reset = fmi2Reset;
    const _: sys::GetReal = fmi2GetReal;
    const _: sys::GetInteger = fmi2GetInteger;
    const _: sys::GetBoolean = fmi2GetBoolean;
    const _: sys::GetString = fmi2GetString;
    const _: sys::SetReal = fmi2SetReal;
    const _: sys::SetInteger = fmi2SetInteger;
    const _: sys::SetBoolean = fmi2SetBoolean;
    const _: sys::SetString = fmi2SetString;
    const _: sys::GetFmuState = fmi2GetFMUstate;
    const _: sys::SetFmuState = fmi2SetFMUstate;
    const _: sys::FreeFmuState = fmi2FreeFMUstate;
    const _: sys::SerializedFmuStateSize = fmi2SerializedFMUstateSize;
    const _: sys::SerializeFmuState = fmi2SerializeFMUstate;
    const _: sys::DeSerializeFmuState = fmi2DeSerializeFMUstate;
    const _: sys::GetDirectionalDerivative = fmi2GetDirectionalDerivative;
    const _: sys::SetRealInputDerivatives = fmi2SetRealInputDerivatives;
    const _: sys::GetRealOutputDerivatives = fmi2GetRealOutputDerivatives;
    const _: sys::EnterEventMode = fmi2EnterEventMode;
    const _: sys::NewDiscreteStates = fmi2NewDiscreteStates;
    const _: sys::EnterContinuousTimeMode = fmi2EnterContinuousTimeMode;
    const _: sys::CompletedIntegratorStep = fmi2CompletedIntegratorStep;
    const _: sys::SetTime = fmi2SetTime;
    const _: sys::SetContinuousStates = fmi2SetContinuousStates;
    const _: sys::GetDerivatives = fmi2GetDerivatives;
    const _: sys::GetEventIndicators = fmi2GetEventIndicators;
    const _: sys::GetContinuousStates = fmi2GetContinuousStates;
    const _: sys::GetNominalsOfContinuousStates = fmi2GetNominalsOfContinuousStates;
    const _: sys::DoStep = fmi2DoStep;
    const _: sys::CancelStep = fmi2CancelStep;
    const _: sys::GetStatus = fmi2GetStatus;
    const _: sys::GetRealStatus = fmi2GetRealStatus;
    const _: sys::GetIntegerStatus = fmi2GetIntegerStatus;
    const _: sys::GetBooleanStatus = fmi2GetBooleanStatus;
    const _: sys::GetStringStatus = fmi2GetStringStatus;
}
