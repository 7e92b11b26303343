//! What makes the numbers of ahv and what they are measured against; nothing that flies needs it.
//! `cargo ahv` compiles it when one of its commands is first called.
//!
//! | module | command | what it makes | from |
//! |---|---|---|---|
//! | [`gas`] | | shocks, expansions, heat addition, ducts | NACA Report 1135 |
//! | [`shock_expansion`] | | air and engine from first principles | Bolender and Doman 2007 |
//! | `fit` | `cargo ahv fit` | `src/data/aero/shock_expansion.toml`, the curves of eq. (4) | [`shock_expansion`] |
//! | `identify` | `cargo ahv identify beam` | stiffness and tanks in `src/data/vehicle.toml` | Tables 1 and 2 |
//! | `identify` | `cargo ahv identify xu2015` | `src/data/aero/xu2015.toml` | Tables 2 and 3 |
//! | `published` | | what the paper prints, checked | `src/data/published.toml` |
//! | `reproduce` | `cargo ahv reproduce` | report: tables, claims and figures of the paper beside ours | `published` |
//! | `methods` | `cargo ahv methods` | integration methods compared: right-hand sides against error | |
//! | `bench` | `cargo ahv bench` | speed and size beside other integrators, Python and SciPy | |
//!
//! The committed numbers must be what the commands write: `fit --check`, `identify beam --check`,
//! `identify xu2015 --check`, run by `tests/committed.rs`. The number of a command is part of the
//! library: run `cargo ahv describe` after a change.

#![warn(clippy::disallowed_macros, clippy::disallowed_methods)]

#[macro_use(errln, out, outln)]
extern crate ahv_tool;

mod bench;
mod cli;
#[cfg(test)]
mod documented_commands;
mod fit;
pub mod gas;
mod identify;
mod methods;
mod published;
mod reproduce;
pub mod shock_expansion;

use ahv_tool::{console, workspace};
use anyhow::Result;
use clap::Parser;
use cli::{Cli, Command};
use std::process::ExitCode;

/// Runs the command that was typed.
pub fn main() -> ExitCode {
    console::exit_code(Cli::try_parse().map(|Cli { command }| run(&command)))
}

fn run(command: &Command) -> Result<ExitCode> {
    workspace::locate()?;
    match command {
        Command::Reproduce(options) => reproduce::run(options),
        Command::Identify(options) => identify::run(options),
        Command::Fit(options) => fit::run(options),
        Command::Methods(options) => methods::run(options),
        Command::Bench(options) => bench::run(options),
    }?;
    Ok(ExitCode::SUCCESS)
}
