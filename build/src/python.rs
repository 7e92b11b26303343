//! Python environments with exactly the packages of a lock file.

use crate::workspace::{MAX_TEXT_BYTES, check, read, root, shown, target, write};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A virtual environment in the target directory.
pub struct Environment {
    /// Directory of its programs.
    pub programs: PathBuf,
    pub python: PathBuf,
}

/// The environment `name` with the packages of a lock file; created if it is missing or out of date.
///
/// A copy of the lock file, written last, marks a complete environment.
pub fn environment(name: &str, lock: &Path) -> Result<Environment> {
    let wanted = read(lock, MAX_TEXT_BYTES)?;
    let directory = target().join(name);
    let stamp = directory.join("requirements.lock");
    let programs = directory.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let python = programs.join(if cfg!(windows) { "python.exe" } else { "python" });
    if stamp.exists() && python.exists() && read(&stamp, MAX_TEXT_BYTES)? == wanted {
        return Ok(Environment { programs, python });
    }
    errln!("creating {} from {}", shown(&directory), shown(lock));
    check(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&directory))
        .context("a virtual environment needs Python; on Debian: apt-get install python3-venv")?;
    check(
        Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"])
            .args(["--require-hashes", "--requirement"])
            .arg(lock),
    )
    .with_context(|| format!("cannot install the packages of {}", shown(lock)))?;
    write(&stamp, wanted)?;
    Ok(Environment { programs, python })
}

/// The Python interpreter for FMU tests and benchmarks.
pub fn python() -> Result<PathBuf> {
    Ok(environment("venv", &root().join("tests/fmu/requirements.lock"))?.python)
}
