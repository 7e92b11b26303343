//! Times in FMPy: the FMU, an FMU with empty steps, and the vehicle in Python.

use super::Effort;
use super::other_integrators::{lines, spread};
use super::report::Report;
use ahv_tool::package::{self, Targets};
use ahv_tool::python::python;
use ahv_tool::workspace::check;
use ahv_tool::workspace::{cargo, root, target};
use anyhow::Result;
use std::path::PathBuf;
use std::process::Command;

/// The FMU with empty steps.
fn idle() -> Result<PathBuf> {
    let mut command = cargo();
    check(command.args(["run", "--quiet", "--release", "--package", "idle"]))?;
    Ok(target().join("release/idle.fmu"))
}

/// The vehicle of the test oracle, packaged by PythonFMU.
fn python_fmu(python: &PathBuf) -> Result<PathBuf> {
    let directory = target().join("bench");
    check(
        Command::new(python)
            .args(["-m", "pythonfmu", "build", "-f"])
            .arg(root().join("crates/research/bench/python_slave.py"))
            .arg("-d")
            .arg(&directory)
            .env("AHV_ORACLE", root().join("tests/oracle")),
    )?;
    Ok(directory.join("Vehicle.fmu"))
}

pub fn measure(effort: &Effort, report: &mut Report) -> Result<()> {
    let python = python()?;
    report.python_versions(&python, &["FMPy", "pythonfmu"]);
    let mut command = Command::new(&python);
    command
        .arg(root().join("crates/research/bench/fmpy_steps.py"))
        .arg((3 * effort.repeats).to_string());
    command.arg(package::build_default(Targets::AsExisting)?).arg(idle()?);
    match python_fmu(&python) {
        Ok(file) => {
            command.arg(file);
        }
        Err(why) => report.left_out("PythonFMU", &why),
    }
    let output = command.env("AHV_ORACLE", root().join("tests/oracle")).output()?;
    let mut ours: Option<f64> = None;
    for cells in lines(output)? {
        let seconds = spread(&cells[1..4])?;
        let note = match ours {
            None => "two inputs, five outputs".to_string(),
            Some(ours) if ours > seconds.median => {
                format!("ours takes {:.2} x as long, aim 2", ours / seconds.median)
            }
            Some(ours) => format!("{:.0} x ours", seconds.median / ours),
        };
        ours = ours.or(Some(seconds.median));
        let what = format!("FMPy, steps of 10 ms, 1 s: {}", cells[0]);
        report.line(what, seconds.scaled(1e3), "ms", note);
    }
    Ok(())
}
