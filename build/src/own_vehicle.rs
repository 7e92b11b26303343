//! The user's own vehicle: data files that a command reads in place of the built-in ones.

use crate::workspace::{MAX_DATA_BYTES, read_text, shown, target};
use ahv::data::{Data, OwnFile, OwnFiles};
use ahv::flight::Setup;
use anyhow::Result;
use clap::Args;
use std::path::{Path, PathBuf};

/// The user's data files. Results with them are written to target/own.
#[derive(Debug, Default, Args)]
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

impl OwnVehicle {
    /// Whether there are any.
    pub fn is_given(&self) -> bool {
        self.vehicle.is_some() || self.coefficients.is_some()
    }

    /// What the files hold.
    pub fn files(&self) -> Result<OwnFiles> {
        Ok(OwnFiles {
            vehicle: self.vehicle.as_deref().map(read).transpose()?,
            coefficients: self.coefficients.as_deref().map(read).transpose()?,
        })
    }

    /// Default parameters of the vehicle.
    pub fn setup(&self) -> Result<Setup> {
        setup(&self.files()?)
    }

    /// Where results are written.
    pub fn results(&self) -> PathBuf {
        if self.is_given() { target().join("own") } else { target() }
    }
}

/// Default parameters of the vehicle with these files.
pub fn setup(files: &OwnFiles) -> Result<Setup> {
    Ok(Setup::of(Data::with(files)?))
}

fn read(file: &Path) -> Result<OwnFile> {
    Ok(OwnFile { name: shown(file), text: read_text(file, MAX_DATA_BYTES)? })
}
