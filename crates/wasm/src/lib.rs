//! Any model as a WebAssembly component, by the draft of the layered standard FMI-LS-WASM: functions of
//! FMI 3.0 for Co-Simulation and Model Exchange, their interface in `wit/`. Each file in `components/` makes one.
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

use bindings::exports::fmi::fmi3::{co_simulation as cs, common, model_exchange as me};
use fmi_model::model::Model;
use handle::Handle;
use std::marker::PhantomData;

/// The component of a model.
#[derive(Debug)]
pub struct Component<M>(PhantomData<M>);

impl<M: Model> common::Guest for Component<M> {
    fn get_version() -> String {
        "3.0".to_string()
    }
}

impl<M: Model> cs::Guest for Component<M> {
    type CoSimulationInstance = Handle<M>;
}

impl<M: Model> me::Guest for Component<M> {
    type ModelExchangeInstance = Handle<M>;
}

/// Exports the functions of a [`Model`]: all that a `cdylib` needs.
#[macro_export]
macro_rules! component {
    ($model:ty) => {
        /// The component.
        pub type Component = $crate::Component<$model>;

        #[cfg(target_family = "wasm")]
        #[allow(unsafe_code, reason = "names and sections of the canonical ABI")]
        const _: () = {
    $crate::bindings::export!(Component with_types_in $crate::bindings);
        };
    };
}
