//! Runs the commands of crates/research, which is compiled at its first command: flying does not need it.

use crate::cli::Research;
use crate::workspace::{cargo, root};
use anyhow::{Context, Result};
use std::env;
use std::ffi::OsString;
use std::process::{Command, ExitCode};

/// Runs a command with full optimisation, in the current directory.
pub fn run(name: &str, options: &Research) -> Result<ExitCode> {
    let status = command(name, &options.arguments)
        .current_dir(env::current_dir()?)
        .status()
        .context("cannot start cargo")?;
    Ok(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The process that runs a command.
pub fn command(name: &str, arguments: &[OsString]) -> Command {
    let mut command = cargo();
    command
        .args(["run", "--release", "--package", "ahv-research", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        .args(["--", name])
        .args(arguments);
    command
}
