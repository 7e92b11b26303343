//! `cargo ahv`.

#![warn(clippy::disallowed_macros, clippy::disallowed_methods)]

use ahv_tool::cli::{Cli, Command};
use ahv_tool::{
    console, describe, fly, modes, own_vehicle, package, poles, research, test, trim, workspace,
};
use anyhow::Result;
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    console::exit_code(Cli::try_parse().map(|Cli { command }| run(&command)))
}

fn run(command: &Command) -> Result<ExitCode> {
    workspace::locate()?;
    if let Some(code) = own_vehicle::run(command)? {
        return Ok(code);
    }
    match command {
        Command::Describe(options) => describe::run(options),
        Command::Package(options) => package::run(options),
        Command::Fly(options) => fly::run(options),
        Command::Modes(options) => modes::run(options),
        Command::Trim(options) => trim::run(options),
        Command::Poles(options) => poles::run(options),
        Command::Test(options) => test::run(options),
        Command::Reproduce(passed) => return research::run("reproduce", passed),
        Command::Identify(passed) => return research::run("identify", passed),
        Command::Fit(passed) => return research::run("fit", passed),
        Command::Methods(passed) => return research::run("methods", passed),
        Command::Bench(passed) => return research::run("bench", passed),
    }?;
    Ok(ExitCode::SUCCESS)
}
