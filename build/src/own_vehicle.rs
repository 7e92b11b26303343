//! The user's own vehicle: the same command again, by a tool that is built with the user's data.

use crate::cli::Command;
use crate::workspace::{MAX_DATA_BYTES, cargo, read_text, root, shown, target, variable};
use ahv::data::{AeroData, DataFile, VehicleData};
use anyhow::{Context, Result};
use clap::Args;
use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Data of the user in place of ours. The tool and the library are built with them in target/own, and
/// everything is written there.
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

/// The build script's names for the files.
const VEHICLE: &str = "AHV_VEHICLE";
const COEFFICIENTS: &str = "AHV_COEFFICIENTS";

/// The user's data, where a command takes them.
fn of(command: &Command) -> Option<&OwnVehicle> {
    match command {
        Command::Package(options) => Some(&options.own_vehicle),
        Command::Fly(options) => Some(&options.own_vehicle),
        Command::Trim(options) => Some(&options.own_vehicle),
        Command::Modes(options) => Some(&options.analyse.own_vehicle),
        Command::Poles(options) => Some(&options.analyse.own_vehicle),
        _ => None,
    }
}

/// Checks the user's files and runs a command with them; nothing if there are none, or if this tool
/// is the one that was built with them.
pub fn run(command: &Command) -> Result<Option<ExitCode>> {
    let Some(own) = of(command) else { return Ok(None) };
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
    errln!("building with your data; the first time takes some minutes");
    let status = command.status().context("cannot start cargo")?;
    Ok(Some(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE }))
}

/// Refuses a file that is not the data of a vehicle; where it is.
fn check<T: DataFile>(file: &Path) -> Result<PathBuf> {
    T::parse(&shown(file), &read_text(file, MAX_DATA_BYTES)?)?;
    file.canonicalize().with_context(|| format!("cannot find {}", shown(file)))
}
