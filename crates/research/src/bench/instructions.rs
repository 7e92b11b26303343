//! Instruction counts by callgrind, which do not depend on the load of the machine.

use super::Effort;
use super::precision::fly;
use super::report::Report;
use super::timing::Spread;
use crate::cli::Probe;
use crate::methods::Law;
use ahv::flight::Setup;
use ahv_tool::cli::Set;
use ahv_tool::trim::flight;
use ahv_tool::workspace::works;
use ahv_tool::workspace::{MAX_TEXT_BYTES, cargo, read_text, root, target};
use anyhow::{Context, Result, bail};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Calls of a probe; a run with twice as many gives their cost without start-up.
const CALLS: usize = 1000;
/// The same of a probe that starts flights.
const STARTS: usize = 3;
/// Steps of a flight in the probe `steps`.
const STEPS: usize = 100;

/// Runs a probe many times, under callgrind.
pub fn probe(probe: Probe, calls: usize) -> Result<()> {
    let mut flight = flight(&Set { settings: Vec::new() })?;
    let mut burning = Setup::new()?;
    burning.parameters.options.fuel_burn = true;
    let (vehicle, trim) = (flight.vehicle(), flight.trim());
    let (vehicle, trim) = (vehicle.clone(), *trim);
    let start = flight.snapshot();
    match probe {
        Probe::Rates => (0..calls).for_each(|_| {
            black_box(vehicle.derivatives(black_box(&trim.state), &trim.control, [0.0; 2]));
        }),
        Probe::Outputs => (0..calls).for_each(|_| {
            black_box(vehicle.derivatives_and_outputs(
                black_box(&trim.state),
                &trim.control,
                [0.0; 2],
            ));
        }),
        Probe::Steps => {
            for _ in 0..calls / STEPS {
                flight.rewind(&start);
                fly(&mut flight, STEPS, &Law::OPEN)?;
            }
        }
        Probe::Burning => {
            for _ in 0..calls {
                black_box(burning.fly()?);
            }
        }
    }
    Ok(())
}

/// Instructions of a program with these arguments.
pub fn count(program: &Path, arguments: &[&str]) -> Result<f64> {
    let file = target().join("bench/callgrind.out");
    let output = Command::new("valgrind")
        .arg("--tool=callgrind")
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(program)
        .args(arguments)
        .output()?;
    if !output.status.success() {
        bail!("valgrind: {}", String::from_utf8_lossy(&output.stderr));
    }
    let text = read_text(&file, MAX_TEXT_BYTES)?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: "));
    Ok(total.context("callgrind wrote no totals")?.trim().parse()?)
}

/// Instructions of one of some calls: `run` counts those of a run with so many.
fn per_call(calls: usize, run: impl Fn(&str) -> Result<f64>) -> Result<Spread> {
    let of = |calls: usize| run(&calls.to_string());
    Ok(Spread::exact(((of(2 * calls)? - of(calls)?) / calls as f64).round()))
}

/// A program that takes samples of the autopilot: its library has the functions of the vehicle's, so that no
/// program can have both.
fn sampler() -> Result<PathBuf> {
    let mut build = cargo();
    build.args([
        "build",
        "--quiet",
        "--release",
        "--package",
        "ahv-autopilot",
        "--example",
        "samples",
    ]);
    build.arg("--manifest-path").arg(root().join("Cargo.toml"));
    if !build.status()?.success() {
        bail!("the autopilot does not compile: see the messages above");
    }
    Ok(target().join("release/examples/samples"))
}

pub fn measure(_: &Effort, report: &mut Report) -> Result<()> {
    if !works("valgrind", &["--version"]) {
        bail!("valgrind is not installed; on Debian: apt-get install valgrind libc6-dbg");
    }
    std::fs::create_dir_all(target().join("bench"))?;
    let own = std::env::current_exe()?;
    for (probe, calls, what, aim) in [
        ("rates", CALLS, "right-hand side", "aim 750"),
        ("outputs", CALLS, "right-hand side and all outputs", "sensors included"),
        ("steps", CALLS, "step of 10 ms at 1e-8, in a doublet", "aim 8,000"),
        ("burning", STARTS, "start with fuel_burn", "modes at 17 fuel levels"),
    ] {
        let run = |calls: &str| count(&own, &["bench", "--probe", probe, "--calls", calls]);
        report.line(what, per_call(calls, run)?, "instructions", aim);
    }
    let sampler = sampler()?;
    let sample = per_call(CALLS, |calls| count(&sampler, &[calls]))?;
    report.line("autopilot, step of 10 ms", sample, "instructions", "inputs and outputs included");
    Ok(())
}
