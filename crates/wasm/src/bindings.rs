//! The interface of `wit/` in Rust.

// Of the canonical ABI; generated, with pointers and lengths that the host's runtime has checked.
#![allow(unsafe_code)]
#![allow(missing_docs, clippy::all)]

wit_bindgen::generate!({
    path: "wit",
    world: "fmu",
    default_bindings_module: "crate::bindings",
    pub_export_macro: true,
});
