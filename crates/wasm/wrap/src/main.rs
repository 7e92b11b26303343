//! Wraps a core module, from standard input, into a component, to standard output.
//!
//! The module carries its interface: wit-bindgen put it there.

#![deny(unsafe_code)]

use anyhow::Result;
use std::io::{Read, Write, stdin, stdout};
use wit_component::ComponentEncoder;

fn main() -> Result<()> {
    let mut module = Vec::new();
    stdin().read_to_end(&mut module)?;
    let component = ComponentEncoder::default().validate(true).module(&module)?.encode()?;
    Ok(stdout().write_all(&component)?)
}
