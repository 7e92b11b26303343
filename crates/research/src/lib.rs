//! Derives the numbers of ahv and compares them with the paper and with other programs; not needed to fly.
//! `cargo ahv` compiles it at the first command that needs it.
//!
//! | module | command | result | source |
//! |---|---|---|---|
//! | [`gas`] | | shocks, expansions, heat addition, ducts | NACA Report 1135 |
//! | [`shock_expansion`] | | air and engine from first principles | Bolender and Doman 2007 |
//! | `fit` | `cargo ahv fit` | `src/data/aero/shock_expansion.toml`, the curves of eq. (4) | [`shock_expansion`] |
//! | `identify` | `cargo ahv identify beam` | stiffness and tanks in `src/data/vehicle.toml` | Tables 1 and 2 |
//! | `identify` | `cargo ahv identify xu2015` | `src/data/aero/xu2015.toml` | Tables 2 and 3 |
//! | `published` | | the printed tables of the paper | `src/data/published.toml` |
//! | `reproduce` | `cargo ahv reproduce` | report: tables, claims and figures of the paper compared with ours | `published` |
//! | `methods` | `cargo ahv methods` | comparison of integration methods: right-hand sides against error | |
//! | `bench` | `cargo ahv bench` | speed and size against other integrators, Python and SciPy | |
//!
//! The committed numbers must be those that the commands write: `tests/committed.rs` runs `fit --check`,
//! `identify beam --check` and `identify xu2015 --check`. These numbers are part of the
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

/// Runs the command of the command line.
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
