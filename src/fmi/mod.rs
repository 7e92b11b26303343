//! FMI 2.0.5 for Co-Simulation and Model Exchange: how a simulation master sees a [`Flight`](crate::flight::Flight).
//!
//! | module | its job |
//! |---|---|
//! | [`sys`] | the standard's C types and function types |
//! | [`lifecycle`] | which call is legal in which state, as data |
//! | [`failure`] | what a call can be refused for, as text and status |
//! | [`log`] | categories, and messages waiting for the master's logger |
//! | [`instance`] | one instance: set-up, steps, status |
//! | `clock` | when two instants are the same |
//! | [`exchange`] | model exchange: the master integrates |
//! | [`values`] | reading and setting variables |
//! | [`derivatives`] | directional derivatives, those of inputs and outputs by time |
//! | [`snapshot`] | the FMU state and its bytes |
//! | [`guard`] | legal order, panics and failures become a status and a message |
//! | `abi` | the exported functions: the only unsafe code of the crate |
//!
//! What the model description has to say about this code: `canHandleVariableCommunicationStepSize`,
//! `canInterpolateInputs`, `canGetAndSetFMUstate`, `canSerializeFMUstate`,
//! `providesDirectionalDerivative` and `canNotUseMemoryManagementFunctions` are true,
//! `maxOutputDerivativeOrder` is 1.
//!
//! Steps are synchronous: `fmi2DoStep` never returns `fmi2Pending`, so there is nothing to cancel
//! and the callback `stepFinished`, which reports the end of a pending step, is not called.

mod abi;
mod advice;
mod clock;
pub mod derivatives;
pub mod exchange;
pub mod failure;
pub mod guard;
pub mod instance;
pub mod lifecycle;
pub mod log;
pub mod snapshot;
pub mod sys;
pub mod values;
