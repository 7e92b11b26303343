//! SUNDIALS and SciPy on the same vehicle.

use super::Effort;
use super::precision::{Point, TOLERANCES};
use super::timing::Spread;
use crate::methods::error;
use ahv::vehicle::{STATES, State};
use ahv_tool::fmu::Fmu;
use ahv_tool::package::{self, Targets};
use ahv_tool::workspace::{root, target};
use anyhow::{Context, Result, anyhow, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

const LIBRARIES: [&str; 7] = [
    "sundials_cvode",
    "sundials_arkode",
    "sundials_nvecserial",
    "sundials_sunmatrixdense",
    "sundials_sunlinsoldense",
    "sundials_sunnonlinsolfixedpoint",
    "dl",
];
/// Repetitions of SciPy, which takes seconds.
const SLOW_REPEATS: usize = 3;

/// Compiles the program that flies with CVODE and ARKODE; an error if SUNDIALS is not installed.
pub fn sundials() -> Result<PathBuf> {
    let program = target().join("bench/sundials");
    std::fs::create_dir_all(target().join("bench"))?;
    let mut compiler = Command::new("cc");
    compiler.args(["-O2", &format!("-DSTATES={STATES}")]);
    compiler.arg(root().join("crates/research/bench/sundials.c")).arg("-o").arg(&program);
    compiler.args(LIBRARIES.map(|library| format!("-l{library}")));
    let output = compiler.output().context("there is no C compiler")?;
    if !output.status.success() {
        bail!(
            "crates/research/bench/sundials.c does not compile; on Debian: apt-get install libsundials-dev"
        );
    }
    Ok(program)
}

/// CVODE and ARKODE on the Model Exchange functions of the packaged FMU.
pub fn under_sundials(program: &Path, effort: &Effort, exact: &State) -> Result<Vec<Point>> {
    let fmu = Fmu::open(&package::build_default(Targets::AsExisting)?)?;
    let elevator = fmu.model.find("delta_e").ok_or_else(|| anyhow!("no elevator"))?;
    let reference = elevator.value_reference.to_string();
    let repeats = (2 * effort.repeats).to_string();
    let output = Command::new(program)
        .arg(&fmu.binary)
        .args([&fmu.model.token, &fmu.resources().display().to_string(), &reference, &repeats])
        .args(TOLERANCES)
        .output()?;
    lines(output)?
        .iter()
        .map(|cells| {
            let state: Vec<f64> =
                cells[6..].iter().map(|cell| cell.parse()).collect::<Result<_, _>>()?;
            let state: State = state.try_into().map_err(|_| anyhow!("not a state"))?;
            point(cells, error(&state, exact))
        })
        .collect()
}

/// SciPy on the vehicle of the test oracle.
pub fn under_scipy(python: &Path, effort: &Effort) -> Result<Vec<Point>> {
    let output = Command::new(python)
        .arg(root().join("crates/research/bench/oracle.py"))
        .arg(effort.repeats.min(SLOW_REPEATS).to_string())
        .args(&TOLERANCES[..4])
        .output()?;
    lines(output)?.iter().map(|cells| point(cells, cells[6].parse()?)).collect()
}

/// Parses the output of a program into cells.
pub fn lines(output: std::process::Output) -> Result<Vec<Vec<String>>> {
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        bail!("{}", text.lines().last().unwrap_or("the program failed"));
    }
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Ok(text.lines().map(|line| line.split(';').map(str::to_string).collect()).collect())
}

/// Parses median, minimum and maximum from three cells.
pub fn spread(cells: &[String]) -> Result<Spread> {
    Ok(Spread { median: cells[0].parse()?, least: cells[1].parse()?, largest: cells[2].parse()? })
}

fn point(cells: &[String], error: f64) -> Result<Point> {
    Ok(Point {
        method: cells[0].clone(),
        tolerance: cells[1].clone(),
        seconds: spread(&cells[2..5])?,
        calls: cells[5].parse()?,
        error,
    })
}
