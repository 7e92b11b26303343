//! Tries a package on this machine before it is written.

use super::Files;
use crate::fly::positive;
use crate::fmu::Fmu;
use crate::master::{Instance, Step};
use crate::models::PackagedModel;
use crate::workspace::write;
use anyhow::{Context, Result, bail};
use fmi_model::archive::zip;
use std::env;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// The files that the model's trial adds to a package.
pub fn files(model: &PackagedModel, package: &Files, prebuilt: bool) -> Result<Files> {
    let directory = TempDir::with_prefix("fmu-")?;
    let file = directory.path().join("trial.fmu");
    write(&file, zip(package)?)?;
    if prebuilt {
        in_child_process(&file, directory.path())?;
    }
    (model.trial)(&Fmu::open(&file)?)
}

/// Makes one step with all defaults; adds no files.
pub fn step(fmu: &Fmu) -> Result<Files> {
    let default = &fmu.model.experiment;
    let stop = positive("stop time", default.stop_time)?;
    let mut instance = Instance::new(fmu).context(
        "library and committed description differ; after a change of the model: cargo ahv describe",
    )?;
    instance.set_up(0.0, stop, positive("tolerance", default.tolerance)?)?;
    instance.initialise()?;
    if let Step::Discarded(_, reason) = instance.step(0.0, stop)? {
        bail!("the first step ends early: {reason}");
    }
    instance.terminate()?;
    Ok(Files::new())
}

/// Flies a prebuilt library in a child process first, because it may crash its process. Other failures are
/// reported by the trial.
fn in_child_process(file: &Path, directory: &Path) -> Result<()> {
    let level = directory.join("level.csv");
    write(&level, "time\n0\n")?;
    let mut fly = Command::new(env::current_exe()?);
    fly.args(["fly", "--stop", "0.1", "--fmu"]).arg(file);
    let status = fly.arg("--input").arg(level).arg("--output").arg(directory).output()?.status;
    if status.code().is_none() {
        bail!("the library for this machine crashes the process that loads it: {status}");
    }
    Ok(())
}
