//! `cargo ahv test`: checks everything, quick checks first.

use crate::cli::{Describe, Test};
use crate::emulation::{QEMU, WINE, emulated};
use crate::models::{MODELS, VEHICLE};
use crate::package::Targets;
use crate::python::{environment, python};
use crate::workspace::{cargo, check, root, target, works, write};
use crate::{abi_stress, console, describe, masters, package, research, site, wheel};
use anyhow::{Result, bail};
use std::ffi::OsString;
use std::process::Command;
use std::thread;
use std::time::Instant;

/// Which of the two levels a step belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    /// Rust, and the FMU in FMPy: minutes.
    Always,
    /// Other tools, masters and platforms.
    Thorough,
}
use Level::{Always, Thorough};

/// Name, level and action of a step.
type Step = (&'static str, Level, fn(&Test) -> Result<()>);

const STEPS: [Step; 21] = [
    ("prerequisites", Always, prerequisites),
    ("format", Always, |_| check(cargo().args(["fmt", "--all", "--check"]))),
    ("lints", Always, |_| {
        check(cargo().args(["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]))
    }),
    ("documentation", Always, |_| {
        let mut doc = cargo();
        doc.args([
            "doc",
            "--package",
            "ahv-fmu",
            "--package",
            "fmi-model",
            "--all-features",
            "--no-deps",
        ]);
        check(doc.env("RUSTDOCFLAGS", "-D warnings"))
    }),
    ("Rust tests", Always, |_| {
        // The long fuzz is a separate step.
        check(
            cargo()
                .args(["test", "--workspace", "--no-fail-fast"])
                .env_remove(abi_stress::SEQUENCES_VARIABLE),
        )
    }),
    ("description", Always, |_| {
        describe::run(&Describe { check: true, file: None, fmi: None, model: None })
    }),
    ("package", Always, |options| {
        let targets = match (options.all_targets, options.thorough) {
            (true, _) => Targets::All,
            (_, true) => Targets::Possible,
            _ => Targets::AsExisting,
        };
        package::build_all(targets)
    }),
    ("Python lints", Always, |_| python_lints()),
    ("FMI headers", Always, |_| fmi_headers()),
    ("FMU tests", Always, |_| pytest(&["tests/fmu", "--ignore=tests/fmu/examples"])),
    ("examples", Thorough, |_| pytest(&["tests/fmu/examples"])),
    ("Python package", Thorough, |_| wheel::test()),
    ("other masters", Thorough, |_| masters::fly()),
    ("C ABI fuzz", Thorough, |_| abi_stress::fuzz()),
    ("sanitizer", Thorough, |_| abi_stress::sanitizer()),
    ("valgrind", Thorough, |_| abi_stress::valgrind()),
    ("bench runs", Thorough, |_| bench()),
    ("Windows", Thorough, |options| emulated(options, &WINE)),
    ("ARM", Thorough, |options| emulated(options, &QEMU)),
    ("WebAssembly", Thorough, webassembly),
    ("page", Thorough, site::test),
];

pub fn run(options: &Test) -> Result<()> {
    let wanted = |step: &&Step| options.thorough || step.1 == Always;
    let steps: Vec<_> = STEPS.iter().filter(wanted).collect();
    let mut results = Vec::new();
    for (number, (name, _, step)) in steps.iter().enumerate() {
        errln!("\n[{}/{}] {name}", number + 1, steps.len());
        let started = Instant::now();
        let result = step(options);
        if let Err(error) = &result {
            errln!("error: {}", console::error_chain(error));
        }
        let passed = result.is_ok();
        results.push((name, passed, started.elapsed().as_secs_f64()));
        if !passed && options.fail_fast {
            break;
        }
    }
    errln!("\nSummary");
    for (name, passed, seconds) in &results {
        let result = if *passed { "passed" } else { "FAILED" };
        errln!("  {name:<14} {result} {seconds:8.1} s");
    }
    for (name, ..) in steps.iter().skip(results.len()) {
        errln!("  {name:<14} not run");
    }
    let failed: Vec<_> =
        results.iter().filter(|(_, passed, _)| !passed).map(|(name, ..)| **name).collect();
    if !failed.is_empty() {
        bail!("failed: {}", failed.join(", "));
    }
    if !options.thorough {
        errln!(
            "\nNot tested: examples, Python package, other masters, sanitizer, valgrind, Windows, ARM, WebAssembly, page; see --thorough"
        );
    }
    Ok(())
}

/// Checks for required programs, and names the Debian packages of missing ones.
fn prerequisites(options: &Test) -> Result<()> {
    const NEEDED: [(&str, &[&str], &str); 5] = [
        ("cc", &["--version"], "gcc"),
        (
            "python3",
            &["-c", "import sys; assert sys.version_info >= (3, 11)"],
            "python3 (3.11 or newer)",
        ),
        ("python3", &["-c", "import venv"], "python3-venv"),
        ("python3", &["-c", "import ensurepip"], "python3-venv"),
        // Ecos, a master of the thorough tests, is linked with it.
        ("python3", &["-c", "import ctypes; ctypes.CDLL('libtbb.so.12')"], "libtbb12"),
    ];
    let needed = if options.thorough { NEEDED.len() } else { NEEDED.len() - 1 };
    let mut missing: Vec<_> = NEEDED[..needed]
        .iter()
        .filter(|(program, arguments, _)| !works(program, arguments))
        .map(|(_, _, package)| *package)
        .collect();
    missing.dedup();
    if !missing.is_empty() {
        bail!("missing; on Debian: apt-get install {}", missing.join(" "));
    }
    Ok(())
}

/// Runs Python tests of the packaged FMU on all processors.
pub fn pytest(arguments: &[&str]) -> Result<()> {
    let workers = thread::available_parallelism().map_or(1, usize::from);
    check(
        Command::new(python()?)
            .args(["-m", "pytest", "-p", "no:cacheprovider", "--quiet"])
            .args(["--numprocesses", &workers.to_string(), "--dist", "worksteal"])
            .args(arguments)
            .current_dir(root())
            .env("AHV_FMU", package::default_output(&VEHICLE, Targets::Possible)),
    )
}

/// Flies the WebAssembly components of the packages in a runtime.
fn webassembly(options: &Test) -> Result<()> {
    let folder = target().join("components");
    for model in MODELS {
        let package = package::default_output(model, Targets::Possible);
        match package::component(model, &package) {
            Ok(component) => write(&folder.join(format!("{}.wasm", model.identifier)), component)?,
            Err(missing) if options.all_targets => return Err(missing),
            Err(missing) => {
                errln!("skipped: {missing:#}");
                return Ok(());
            }
        }
    }
    let tests = root().join("tests/wasm");
    let python = environment("wasm", &tests.join("requirements.lock"))?.python;
    check(
        Command::new(python)
            .args(["-m", "pytest", "-p", "no:cacheprovider", "--quiet"])
            .arg(tests)
            .current_dir(root())
            .env("AHV_FMU", package::default_output(&VEHICLE, Targets::Possible))
            .env("AHV_WASM", folder),
    )
}

fn python_lints() -> Result<()> {
    let python = python()?;
    for arguments in [["check"].as_slice(), &["format", "--check"]] {
        let mut ruff = Command::new(&python);
        check(ruff.args(["-m", "ruff"]).args(arguments).arg("--no-cache").current_dir(root()))?;
    }
    Ok(())
}

/// Compares our declarations with the official headers, which FMPy contains.
fn fmi_headers() -> Result<()> {
    let python = python()?;
    let find = "import fmpy, pathlib; print(pathlib.Path(fmpy.__file__).parent / 'c-code')";
    let output = Command::new(&python).args(["-c", find]).output()?;
    let headers = String::from_utf8_lossy(&output.stdout).trim().to_string();
    check(
        cargo()
            .args(["test", "--package", "fmi-model", "--test", "headers", "--", "--ignored"])
            .env("FMI_INCLUDE", headers),
    )
}

/// Runs the benchmarks quickly, to see that they work.
fn bench() -> Result<()> {
    let output = target().join("bench/quick").into_os_string();
    let options = ["--quick", "--only", "precision,ensemble", "--output"].map(OsString::from);
    check(&mut research::command("bench", &[&options[..], &[output]].concat()))
}
