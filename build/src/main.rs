//! The `cargo ahv` command.

#![warn(clippy::disallowed_macros, clippy::disallowed_methods)]

use ahv_tool::cli::{Cli, Command};
use ahv_tool::{
    console, describe, fly, modes, package, poles, research, site, test, trim, wheel, workspace,
};
use anyhow::Result;
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    console::exit_code(Cli::try_parse().map(|Cli { command }| run(&command)))
}

fn run(command: &Command) -> Result<ExitCode> {
    workspace::locate()?;
    match command {
        Command::Describe(options) => describe::run(options),
        Command::Package(options) => package::run(options),
        Command::Fly(options) => fly::run(options),
        Command::Modes(options) => modes::run(options),
        Command::Trim(options) => trim::run(options),
        Command::Poles(options) => poles::run(options),
        Command::Wheel(options) => wheel::run(options),
        Command::Site(options) => site::run(options),
        Command::Test(options) => test::run(options),
        Command::Reproduce(options) => return research::run("reproduce", options),
        Command::Identify(options) => return research::run("identify", options),
        Command::Fit(options) => return research::run("fit", options),
        Command::Methods(options) => return research::run("methods", options),
        Command::Bench(options) => return research::run("bench", options),
    }?;
    Ok(ExitCode::SUCCESS)
}
