//! `cargo ahv reproduce`, `identify`, `fit`, `methods`, `bench`.

#![warn(clippy::disallowed_macros, clippy::disallowed_methods)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ahv_research::main()
}
