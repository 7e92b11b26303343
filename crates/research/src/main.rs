//! `cargo ahv reproduce`, `identify`, `fit`, `methods`, `bench`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ahv_research::main()
}
