//! What makes the numbers of ahv: the paper beside ours, identification, fits, methods, benchmarks.

#[macro_use(note, put, say)]
extern crate ahv_tool;

mod bench;
mod cli;
mod fit;
mod identify;
mod methods;
mod published;
mod reproduce;
#[cfg(test)]
mod texts;

use ahv_tool::{say, workspace};
use anyhow::Result;
use clap::Parser;
use cli::{Cli, Command};
use std::process::ExitCode;

fn main() -> ExitCode {
    say::finish(Cli::try_parse().map(|Cli { command }| run(&command)))
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
