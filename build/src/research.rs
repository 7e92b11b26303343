//! The commands of crates/research: nothing that flies needs them, so they are compiled when they are
//! first called.

use crate::cli::Research;
use crate::workspace::{cargo, root};
use anyhow::{Context, Result};
use std::env;
use std::ffi::OsString;
use std::process::{Command, ExitCode};

/// Runs one with full optimisation, in the current directory.
pub fn run(name: &str, passed: &Research) -> Result<ExitCode> {
    let status = command(name, &passed.arguments)
        .current_dir(env::current_dir()?)
        .status()
        .context("cannot start cargo")?;
    Ok(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The command itself.
pub fn command(name: &str, arguments: &[OsString]) -> Command {
    let mut command = cargo();
    command
        .args(["run", "--release", "--package", "ahv-research", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        .args(["--", name])
        .args(arguments);
    command
}
