//! Checks everything, in the order in which mistakes are cheapest to find.

use crate::cli::{Describe, Test};
use crate::package::Targets;
use crate::python::environment;
use crate::workspace::{cargo, check, root};
use crate::{abuse, bench, describe, package, say};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

/// A named step.
type Step = (&'static str, fn(&Test) -> Result<()>);

const STEPS: [Step; 15] = [
    ("prerequisites", |_| prerequisites()),
    ("format", |_| check(cargo().args(["fmt", "--all", "--check"]))),
    ("lints", |_| {
        check(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))
    }),
    ("documentation", |_| {
        let mut doc = cargo();
        doc.args(["doc", "--package", "ahv-fmu", "--no-deps"]);
        check(doc.env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("Rust tests", |_| {
        // The long fuzz has a step of its own.
        check(cargo().args(["test", "--workspace", "--no-fail-fast"]).env_remove(abuse::SEQUENCES))
    }),
    ("description", |_| describe::run(&Describe { check: true, file: None })),
    ("package", |options| {
        let targets = if options.all_targets { Targets::All } else { Targets::Possible };
        package::build(&package::default_output(Targets::Possible), targets)
    }),
    ("C ABI fuzz", |_| abuse::fuzz()),
    ("sanitizer", |_| abuse::sanitizer()),
    ("valgrind", |_| abuse::valgrind()),
    ("Python lints", |_| python_lints()),
    ("FMI headers", |_| fmi_headers()),
    ("FMU tests", |_| python_tests("tests/fmu")),
    ("bench runs", |_| bench::smoke()),
    WINDOWS,
];

/// Runs where there is a Windows to run it on, or if everything is wanted.
const WINDOWS: Step = ("Windows", |_| {
    if let Some(missing) = missing_for_windows() {
        bail!("{missing}");
    }
    python_tests("tests/wine")
});

pub fn run(options: &Test) -> Result<()> {
    let mut results = Vec::new();
    for (number, (name, step)) in STEPS.into_iter().enumerate() {
        note!("\n[{}/{}] {name}", number + 1, STEPS.len());
        let started = Instant::now();
        if name == WINDOWS.0
            && !options.all_targets
            && let Some(missing) = missing_for_windows()
        {
            note!("not run: {missing}");
            break;
        }
        let result = step(options);
        if let Err(error) = &result {
            note!("error: {}", say::causes(error));
        }
        let passed = result.is_ok();
        results.push((name, passed, started.elapsed().as_secs_f64()));
        if !passed && options.fail_fast {
            break;
        }
    }
    note!("\nSummary");
    for (name, passed, seconds) in &results {
        let result = if *passed { "passed" } else { "FAILED" };
        note!("  {name:<14} {result} {seconds:8.1} s");
    }
    for (name, _) in STEPS.iter().skip(results.len()) {
        note!("  {name:<14} not run");
    }
    let failed: Vec<_> =
        results.iter().filter(|(_, passed, _)| !passed).map(|(name, ..)| *name).collect();
    if !failed.is_empty() {
        bail!("failed: {}", failed.join(", "));
    }
    Ok(())
}

/// What has to be on the machine, and the Debian package that brings it.
fn prerequisites() -> Result<()> {
    const NEEDED: [(&str, &[&str], &str); 5] = [
        ("cc", &["--version"], "gcc"),
        (
            "python3",
            &["-c", "import sys; assert sys.version_info >= (3, 11)"],
            "python3 (3.11 or newer)",
        ),
        ("python3", &["-c", "import venv"], "python3-venv"),
        ("python3", &["-c", "import ensurepip"], "python3-venv"),
        // Ecos, one of the masters, is linked with it.
        ("python3", &["-c", "import ctypes; ctypes.CDLL('libtbb.so.12')"], "libtbb12"),
    ];
    let mut missing: Vec<_> = NEEDED
        .into_iter()
        .filter(|(program, arguments, _)| !works(program, arguments))
        .map(|(_, _, package)| package)
        .collect();
    missing.dedup();
    if !missing.is_empty() {
        bail!("missing; on Debian: apt-get install {}", missing.join(" "));
    }
    Ok(())
}

/// Whether a program can be run like this.
pub fn works(program: &str, arguments: &[&str]) -> bool {
    Command::new(program).args(arguments).output().is_ok_and(|output| output.status.success())
}

/// The packaged FMU in other masters, driven from Python.
fn python_tests(folder: &str) -> Result<()> {
    check(
        Command::new(python()?)
            .args(["-m", "pytest", "-p", "no:cacheprovider"])
            .arg(root().join(folder))
            .current_dir(root())
            .env("AHV_FMU", package::default_output(Targets::Possible)),
    )
}

/// What the tests of the Windows library need and this machine does not have.
fn missing_for_windows() -> Option<String> {
    if let Err(error) = package::can_build_for_windows() {
        return Some(say::causes(&error));
    }
    (!works("wine", &["--version"]))
        .then(|| "wine runs the library; on Debian: apt-get install wine wine64".to_string())
}

fn python_lints() -> Result<()> {
    let python = python()?;
    for arguments in [["check"].as_slice(), &["format", "--check"]] {
        let mut ruff = Command::new(&python);
        check(ruff.args(["-m", "ruff"]).args(arguments).arg("--no-cache").current_dir(root()))?;
    }
    Ok(())
}

/// Our declarations against the official headers, of which FMPy brings a copy.
fn fmi_headers() -> Result<()> {
    let python = python()?;
    let find = "import fmpy, pathlib; print(pathlib.Path(fmpy.__file__).parent / 'c-code')";
    let output = Command::new(&python).args(["-c", find]).output()?;
    let headers = String::from_utf8_lossy(&output.stdout).trim().to_string();
    check(
        cargo()
            .args(["test", "--package", "ahv-fmu", "--features", "verify-abi"])
            .args(["--test", "abi_signatures"])
            .env("FMI2_INCLUDE", headers),
    )
}

/// The interpreter for the tests of the FMU, and for what is measured in Python.
pub fn python() -> Result<PathBuf> {
    Ok(environment("venv", &root().join("tests/fmu/requirements.lock"))?.python)
}
