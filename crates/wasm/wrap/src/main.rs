//! Wraps a core module, a file, into a component, on standard output.
//!
//! The module carries its interface: wit-bindgen put it there.

#![deny(unsafe_code)]

use anyhow::{Context, Result};
use std::io::{Write, stdout};
use std::{env, fs};
use wit_component::ComponentEncoder;

fn main() -> Result<()> {
    let file = env::args_os().nth(1).context("usage: ahv-wasm-wrap MODULE > COMPONENT")?;
    let module = fs::read(&file).with_context(|| file.display().to_string())?;
    let component = ComponentEncoder::default().validate(true).module(&module)?.encode()?;
    Ok(stdout().write_all(&component)?)
}
