//! `cargo ahv wheel`: the Python package with all FMUs inside.

use crate::cli::Wheel;
use crate::models::{MODELS, VEHICLE};
use crate::package::{self, Targets};
use crate::python::{Environment, environment};
use crate::workspace::{MAX_BINARY_BYTES, check, read, root, shown, target, write};
use anyhow::{Context, Result};
use fmi_model::standard::Standard;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a file of the package may be called: not what an interpreter leaves beside it.
const KINDS: [&str; 2] = ["py", "typed"];
/// Data files to copy and change for an own vehicle, in src/data.
const TEMPLATES: [&str; 2] = ["vehicle.toml", "aero/parker2007.toml"];
const LICENSES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

pub fn run(options: &Wheel) -> Result<()> {
    let fmu = match &options.fmu {
        Some(fmu) => fmu.clone(),
        None => package::default_output(&VEHICLE, Targets::Possible),
    };
    if options.fmu.is_none() {
        for model in MODELS {
            let output = package::default_output(model, Targets::Possible);
            if !package::is_current(model, &output) {
                package::build(model, &output, Targets::Possible)?;
            }
        }
    }
    let wheel = build(&fmu)?;
    let size = fs::metadata(&wheel)?.len();
    outln!("{}: {} kB", shown(&wheel), size.div_ceil(1000))
}

/// Tests the wheel: tests/wheel.
pub fn test() -> Result<()> {
    let fmu = package::default_output(&VEHICLE, Targets::Possible);
    let wheel = build(&fmu)?;
    check(
        Command::new(tools()?.python)
            .args(["-m", "pytest", "-p", "no:cacheprovider", "--quiet"])
            .arg(root().join("tests/wheel"))
            .current_dir(root())
            .env("AHV_FMU", fmu)
            .env("AHV_WHEEL", wheel),
    )
}

/// The programs that build and test the wheel.
fn tools() -> Result<Environment> {
    environment("wheel/venv", &root().join("tests/wheel/requirements.lock"))
}

/// Builds the wheel with the vehicle's FMU of FMI 2.0 and the other FMUs beside it. The same FMUs give the same bytes.
fn build(fmu: &Path) -> Result<PathBuf> {
    let staged = target().join("wheel/package");
    stage(&staged, fmu)?;
    check(
        Command::new(tools()?.python)
            .args(["-m", "hatchling", "build", "--target", "wheel", "--directory"])
            .arg(target())
            .current_dir(&staged)
            // Without it hatchling writes a fixed date.
            .env_remove("SOURCE_DATE_EPOCH")
            .env("PYTHONDONTWRITEBYTECODE", "1"),
    )?;
    Ok(target().join(concat!("ahv-", env!("CARGO_PKG_VERSION"), "-py3-none-any.whl")))
}

/// Copies sources, licences and FMUs into an empty folder.
fn stage(staged: &Path, fmu: &Path) -> Result<()> {
    if staged.exists() {
        fs::remove_dir_all(staged).with_context(|| shown(staged))?;
    }
    let copy = |from: &Path, to: PathBuf| write(&to, read(from, MAX_BINARY_BYTES)?);
    let (sources, package) = (root().join("python"), Path::new("src/ahv"));
    for name in ["pyproject.toml", "README.md"] {
        copy(&sources.join(name), staged.join(name))?;
    }
    for name in LICENSES {
        copy(&root().join(name), staged.join(name))?;
    }
    let modules = sources.join(package);
    for entry in fs::read_dir(&modules).with_context(|| shown(&modules))? {
        let path = entry?.path();
        let kind = path.extension().unwrap_or_default();
        if let (true, Some(name)) = (KINDS.iter().any(|known| kind == *known), path.file_name()) {
            copy(&path, staged.join(package).join(name))?;
        }
    }
    let data = staged.join(package).join("data");
    for name in TEMPLATES {
        let file = root().join("src/data").join(name);
        copy(&file, data.join(file.file_name().unwrap_or_default()))?;
    }
    for model in MODELS {
        let from = package::beside(fmu, model)?;
        for standard in Standard::ALL {
            let name = standard.file_name(model.identifier);
            copy(&package::of(standard, &from), data.join(name)).context(
                "a wheel has all models' FMUs of both standards, which `cargo ahv package` writes",
            )?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::{MAX_TEXT_BYTES, read_text};

    #[test]
    fn the_wheel_has_the_version_and_licence_of_the_workspace() {
        let manifest = read_text(&root().join("python/pyproject.toml"), MAX_TEXT_BYTES).unwrap();
        let manifest: toml::Table = manifest.parse().unwrap();
        let project = &manifest["project"];
        assert_eq!(project["version"].as_str(), Some(env!("CARGO_PKG_VERSION")));
        assert_eq!(project["license"].as_str(), Some(env!("CARGO_PKG_LICENSE")));
    }
}
