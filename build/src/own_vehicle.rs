//! Commands with the user's own vehicle: rebuilds the tool with the user's data and runs the command again.

use crate::cli::Command;
use crate::workspace::{MAX_DATA_BYTES, cargo, read_text, root, shown, target, variable};
use ahv::data::{AeroData, DataFile, VehicleData};
use anyhow::{Context, Result};
use clap::Args;
use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The user's data files. The tool and the library are built with them in target/own, where results are
/// written too.
#[derive(Debug, Args)]
#[command(next_help_heading = "Your own vehicle")]
pub struct OwnVehicle {
    /// Geometry, mass, beam, tanks: a file like src/data/vehicle.toml
    #[arg(long, value_name = "FILE.toml")]
    pub vehicle: Option<PathBuf>,
    /// Coefficients of eq. (4), inertia, envelope: a file like src/data/aero/parker2007.toml; becomes
    /// the coefficient set `own`, which is then the default
    #[arg(long, value_name = "FILE.toml")]
    pub coefficients: Option<PathBuf>,
}

/// Environment variables that pass the files to the build script.
const VEHICLE: &str = "AHV_VEHICLE";
const COEFFICIENTS: &str = "AHV_COEFFICIENTS";

/// The data files of a command that takes them.
fn data_files(command: &Command) -> Option<&OwnVehicle> {
    match command {
        Command::Package(options) => Some(&options.own_vehicle),
        Command::Fly(options) => Some(&options.own_vehicle),
        Command::Trim(options) => Some(&options.own_vehicle),
        Command::Modes(options) => Some(&options.analyse.own_vehicle),
        Command::Poles(options) => Some(&options.analyse.own_vehicle),
        _ => None,
    }
}

/// Checks the user's files and runs the command with them. Returns `None` without such files, or if this
/// tool was built with them.
pub fn run(command: &Command) -> Result<Option<ExitCode>> {
    let Some(own) = data_files(command) else { return Ok(None) };
    let files = [
        (VEHICLE, &own.vehicle, check::<VehicleData> as fn(&Path) -> Result<PathBuf>),
        (COEFFICIENTS, &own.coefficients, check::<AeroData>),
    ];
    let given = |name| variable(name).is_some();
    if given(VEHICLE) || given(COEFFICIENTS) || files.iter().all(|(_, file, _)| file.is_none()) {
        return Ok(None);
    }
    let mut command = cargo();
    command
        .args(["run", "--profile", "tool", "--package", "ahv", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        .arg("--")
        .args(env::args_os().skip(1))
        .current_dir(env::current_dir()?)
        .env("CARGO_TARGET_DIR", target().join("own"));
    for (name, file, check) in files {
        if let Some(file) = file {
            command.env(name, check(file)?);
        }
    }
    errln!("building with your data; the first build takes some minutes");
    let status = command.status().context("cannot start cargo")?;
    Ok(Some(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE }))
}

/// Checks a data file and returns its absolute path.
fn check<T: DataFile>(file: &Path) -> Result<PathBuf> {
    T::parse(&shown(file), &read_text(file, MAX_DATA_BYTES)?)?;
    file.canonicalize().with_context(|| format!("cannot find {}", shown(file)))
}
