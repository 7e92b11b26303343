//! Tests the FMU in other masters than FMPy, each in its own Python environment: tests/masters.

use crate::console;
use crate::models::VEHICLE;
use crate::package::{self, Targets};
use crate::python::environment;
use crate::workspace::root;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const LOCK: &str = "requirements.lock";
/// Prefix of the line with the difference from FMPy, written by tests/masters/conftest.py.
const DIFFERENCE: &str = "difference: ";

/// Tests all masters and prints a line for each; fails at the end if one failed.
pub fn fly() -> Result<()> {
    let mut failed = Vec::new();
    for (name, folder) in masters()? {
        let started = Instant::now();
        let result = tested(&name, &folder);
        let seconds = started.elapsed().as_secs_f64();
        match result {
            Ok(outcome) => errln!("  {name:<10} passed {seconds:6.1} s  {outcome}"),
            Err(error) => {
                errln!("  {name:<10} FAILED {seconds:6.1} s");
                errln!("{}", console::error_chain(&error));
                failed.push(name);
            }
        }
    }
    if !failed.is_empty() {
        bail!("these masters failed: {}", failed.join(", "));
    }
    Ok(())
}

/// Folders with a lock file, by name.
fn masters() -> Result<Vec<(String, PathBuf)>> {
    let home = root().join("tests/masters");
    let mut found = Vec::new();
    for entry in fs::read_dir(&home).with_context(|| home.display().to_string())? {
        let entry = entry?;
        if entry.path().join(LOCK).exists() {
            found.push((entry.file_name().to_string_lossy().into_owned(), entry.path()));
        }
    }
    found.sort();
    Ok(found)
}

/// Tests one master; its result in one line.
fn tested(name: &str, folder: &Path) -> Result<String> {
    let python = environment(&format!("masters/{name}"), &folder.join(LOCK))?.python;
    let output = Command::new(python)
        .args(["-m", "pytest", "-p", "no:cacheprovider", "--quiet"])
        .arg(folder)
        .current_dir(root())
        .env("AHV_FMU", package::default_output(&VEHICLE, Targets::Possible))
        .output()?;
    let said = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        bail!("{said}{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(outcome(&said).to_string())
}

/// The line with the difference, or the last line of pytest.
fn outcome(said: &str) -> &str {
    let difference = said.lines().find_map(|line| line.strip_prefix(DIFFERENCE));
    difference.or(said.lines().last()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_folder_of_tests_has_its_packages_locked() {
        let flown: Vec<_> = masters().unwrap().into_iter().map(|(name, _)| name).collect();
        for entry in fs::read_dir(root().join("tests/masters")).unwrap() {
            let entry = entry.unwrap();
            let name = entry.file_name().to_string_lossy().into_owned();
            if entry.path().join(format!("test_{name}.py")).exists() {
                assert!(flown.contains(&name), "{name}");
            }
        }
        assert!(flown.len() > 5, "{flown:?}");
    }

    #[test]
    fn a_master_is_told_by_its_difference_or_the_last_line() {
        assert_eq!(outcome("..\ndifference: level 0e+00\n2 passed in 1 s\n"), "level 0e+00");
        assert_eq!(outcome(".\n1 passed in 1 s\n"), "1 passed in 1 s");
        assert_eq!(outcome(""), "");
    }
}
