//! `cargo ahv`: describes, packages, flies and tests the ahv FMU.

#[macro_use]
mod say;

mod abuse;
mod bench;
mod cli;
mod describe;
mod documentation;
mod figure;
mod fit;
mod fly;
mod fmu;
mod identify;
mod licenses;
mod manoeuvre;
mod master;
mod masters;
mod methods;
mod model_description;
mod modes;
mod own;
mod package;
mod panels;
mod plot;
mod poles;
mod published;
mod python;
mod raster;
mod record;
mod reproduce;
mod settings;
mod structure;
mod table;
mod test;
mod trim;
mod workspace;
mod xml;

use anyhow::Result;
use clap::Parser;
use cli::{Cli, Command};
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = match Cli::try_parse() {
        Ok(Cli { command }) => run(&command),
        // Help, or what is wrong with the arguments.
        Err(told) => told.print().map_err(say::refused).map(|()| code(told.exit_code())),
    };
    match done.and_then(|code| say::flush().map(|()| code)) {
        Ok(code) => code,
        Err(error) if error.is::<say::Closed>() => ExitCode::SUCCESS,
        Err(error) => {
            note!("error: {}", say::causes(&error));
            ExitCode::FAILURE
        }
    }
}

fn run(command: &Command) -> Result<ExitCode> {
    workspace::locate()?;
    if let Some(code) = own::run(command)? {
        return Ok(code);
    }
    match command {
        Command::Describe(options) => describe::run(options),
        Command::Package(options) => package::run(options),
        Command::Fit(options) => fit::run(options),
        Command::Fly(options) => fly::run(options),
        Command::Modes(options) => modes::run(options),
        Command::Trim(options) => trim::run(options),
        Command::Poles(options) => poles::run(options),
        Command::Reproduce(options) => reproduce::run(options),
        Command::Bench(options) => bench::run(options),
        Command::Methods(options) => methods::run(options),
        Command::Identify(options) => identify::run(options),
        Command::Test(options) => test::run(options),
    }?;
    Ok(ExitCode::SUCCESS)
}

fn code(number: i32) -> ExitCode {
    u8::try_from(number).map_or(ExitCode::FAILURE, ExitCode::from)
}
