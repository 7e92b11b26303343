//! `cargo ahv`: describes, packages, flies and tests the ahv FMU.

mod abuse;
mod bench;
mod cli;
mod curve;
mod describe;
mod documentation;
mod figure;
mod fit;
mod fly;
mod fmu;
mod hints;
mod identify;
mod licenses;
mod manoeuvre;
mod master;
mod methods;
mod model_description;
mod modes;
mod own;
mod package;
mod panels;
mod pilot;
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

use clap::Parser;
use cli::{Cli, Command};
use std::process::ExitCode;

fn main() -> ExitCode {
    // A reader that has seen enough, `cargo ahv poles | head`, is no failure.
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if panic.to_string().contains("Broken pipe") {
            std::process::exit(0);
        }
        report(panic);
    }));
    let command = Cli::parse().command;
    match workspace::locate().and_then(|()| own::run(&command)) {
        Ok(None) => {}
        Ok(Some(code)) => return code,
        Err(error) => return failed(&error),
    }
    let result = match command {
        Command::Describe(options) => describe::run(&options),
        Command::Package(options) => package::run(&options),
        Command::Fit(options) => fit::run(&options),
        Command::Fly(options) => fly::run(&options),
        Command::Modes(options) => modes::run(&options),
        Command::Trim(options) => trim::run(&options),
        Command::Poles(options) => poles::run(&options),
        Command::Reproduce(options) => reproduce::run(&options),
        Command::Bench(options) => bench::run(&options),
        Command::Methods(options) => methods::run(&options),
        Command::Identify(options) => identify::run(&options),
        Command::Test(options) => test::run(&options),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => failed(&error),
    }
}

fn failed(error: &anyhow::Error) -> ExitCode {
    // `{:#}` puts the causes on the same line: what failed, then why.
    eprintln!("error: {error:#}");
    ExitCode::FAILURE
}
