//! The interface of `wit/` in Rust.

#![allow(missing_docs, clippy::all)]

wit_bindgen::generate!({
    path: "wit",
    world: "fmu",
    default_bindings_module: "crate::bindings",
    pub_export_macro: true,
});
