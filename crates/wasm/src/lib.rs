//! The FMU as a WebAssembly component, by the draft of the layered standard FMI-LS-WASM: functions of
//! FMI 3.0 for Co-Simulation and Model Exchange, their interface in `wit/`.
//!
//! | module | its job |
//! |---|---|
//! | [`bindings`] | the interface in Rust, generated |
//! | [`handle`] | one instance: calls through the guard, messages for the host |
//! | [`lifecycle`], [`values`], [`derivatives`] | functions of both interfaces |
//! | [`co_simulation`], [`model_exchange`] | the two interfaces |
//!
//! There is no intermediate update: a component cannot be called while it calls its host.
//!
//! WebAssembly cannot unwind here: a panic is a trap, which ends the host's instance of the component.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

pub mod bindings;
pub mod co_simulation;
pub mod derivatives;
pub mod handle;
pub mod lifecycle;
pub mod model_exchange;
mod shared;
pub mod values;

use ahv::flight::Setup;
use bindings::exports::fmi::fmi3::{co_simulation as cs, common, model_exchange as me};
use handle::Handle;

/// The component.
#[derive(Debug)]
pub struct Component;

impl common::Guest for Component {
    fn get_version() -> String {
        "3.0".to_string()
    }
}

impl cs::Guest for Component {
    type CoSimulationInstance = Handle<Setup>;
}

impl me::Guest for Component {
    type ModelExchangeInstance = Handle<Setup>;
}

#[cfg(target_family = "wasm")]
#[allow(unsafe_code, reason = "names and sections of the canonical ABI")]
const _: () = {
    bindings::export!(Component);
};
