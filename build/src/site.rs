//! `cargo ahv site`: the vehicle in a browser, from the WebAssembly component of the FMU.

use crate::cli::{Site, Test};
use crate::flight_page;
use crate::models::{VEHICLE, parts::AUTOPILOT};
use crate::node;
use crate::package::{self, Targets};
use crate::workspace::{MAX_TEXT_BYTES, cargo, check, read, root, shown, target, works, write};
use anyhow::{Context, Result, bail};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Sources of the page, in the repository.
const SOURCES: &str = "site";
/// Where their FMUs are unpacked, below the target directory.
const FMUS: &str = "node/fmu";
/// The browser of the tests.
const CHROMIUM: &str = "/usr/bin/chromium";
/// Files and folders that the build reads.
const PARTS: [&str; 5] = ["build.mjs", "tsconfig.json", "build", "src", "test"];

pub fn run(options: &Site) -> Result<()> {
    let fmu = match &options.fmu {
        Some(fmu) => fmu.clone(),
        None => package::default_output(&VEHICLE, Targets::Possible),
    };
    if options.fmu.is_none() {
        for model in [&VEHICLE, &AUTOPILOT] {
            let output = package::default_output(model, Targets::Possible);
            if !package::is_current(model, &output) {
                package::build(model, &output, Targets::Possible)?;
            }
        }
    }
    let output = options.output.clone().unwrap_or_else(|| target().join("site"));
    let page = build(&stage()?, &fmu, &output)?;
    let size = fs::metadata(&page).with_context(|| shown(&page))?.len();
    outln!("{}: {} kB", shown(&page), size.div_ceil(1000))
}

/// Builds the page from the FMU of FMI 2.0 and that of FMI 3.0 beside it. The same FMUs give the same bytes.
fn build(stage: &Path, fmu: &Path, output: &Path) -> Result<PathBuf> {
    let mut node = node(stage, "build.mjs", &unpacked(fmu)?, output)?;
    node.arg("--flight").arg(flight_page()).arg("--api").arg(api()?);
    let report = target().join("report/report.html");
    match report.exists() {
        true => drop(node.arg("--report").arg(report)),
        false => errln!("without the report on the paper; to add it: cargo ahv reproduce"),
    }
    check(&mut node)?;
    Ok(output.join("index.html"))
}

/// Documentation of the crate that turns a model into FMUs, in a folder without that of other crates.
fn api() -> Result<PathBuf> {
    let folder = target().join("rustdoc");
    let document = ["doc", "--package", "fmi-model", "--no-deps", "--all-features", "--quiet"];
    check(cargo().args(document).arg("--target-dir").arg(&folder))?;
    Ok(folder.join("doc"))
}

/// The page of a flight, as the sources give it.
fn flight_page() -> PathBuf {
    target().join("node/flight.html")
}

/// Checks the types of the page, and flies it in Chromium; skipped without one.
pub fn test(options: &Test) -> Result<()> {
    if !works(CHROMIUM, &["--version"]) {
        let missing = format!("{CHROMIUM} is missing; on Debian: apt-get install chromium");
        if options.all_targets {
            bail!("{missing}");
        }
        errln!("skipped: {missing}");
        return Ok(());
    }
    let fmu = package::default_output(&VEHICLE, Targets::Possible);
    let stage = stage()?;
    let page = build(&stage, &fmu, &target().join("site"))?;
    let packages = target().join("node");
    check(
        Command::new("node")
            .arg(packages.join("node_modules/typescript/bin/tsc"))
            .current_dir(&stage),
    )?;
    if read(&flight_page(), MAX_TEXT_BYTES)? != flight_page::TEMPLATE.as_bytes() {
        bail!("build/pages/flight.html is out of date: copy {} over it", shown(&flight_page()));
    }
    let tests = stage.join("tests");
    let unpacked = unpacked(&fmu)?;
    check(&mut node(&stage, "test/bundle.mjs", &unpacked, &tests)?)?;
    let pictures = target().join("site-pictures");
    fs::create_dir_all(&pictures).with_context(|| shown(&pictures))?;
    check(
        Command::new("node")
            .args(["--test", "--test-reporter=spec"])
            .arg(&tests)
            .current_dir(&stage)
            .env("AHV_TOOL", env::current_exe()?)
            .env("AHV_FMU", target().join(FMUS).join(VEHICLE.identifier))
            .env("AHV_PACKAGE", fmu)
            .env("AHV_PAGE", page)
            .env("AHV_PACKAGES", packages.join("package.json"))
            .env("AHV_PICTURES", pictures)
            .env("AHV_CHROMIUM", CHROMIUM),
    )
}

/// Copies the sources below their packages, where Node finds these.
fn stage() -> Result<PathBuf> {
    let directory = target().join("node");
    let sources = root().join(SOURCES);
    node::install(&sources, &directory)?;
    let stage = directory.join(SOURCES);
    if stage.exists() {
        fs::remove_dir_all(&stage).with_context(|| shown(&stage))?;
    }
    for part in PARTS {
        copy(&sources.join(part), &stage.join(part))?;
    }
    Ok(stage)
}

/// Copies a file, or a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> Result<()> {
    if !from.is_dir() {
        return write(to, read(from, MAX_TEXT_BYTES)?);
    }
    for entry in fs::read_dir(from).with_context(|| shown(from))? {
        let path = entry?.path();
        if let Some(name) = path.file_name() {
            copy(&path, &to.join(name))?;
        }
    }
    Ok(())
}

/// The FMUs of the page, unpacked; `fmu` is that of the vehicle for FMI 2.0. The page can do without the autopilot.
fn unpacked(fmu: &Path) -> Result<Vec<PathBuf>> {
    let folders = target().join(FMUS);
    if folders.exists() {
        fs::remove_dir_all(&folders).with_context(|| shown(&folders))?;
    }
    let mut unpacked = Vec::new();
    for model in [&VEHICLE, &AUTOPILOT] {
        let files = package::beside(fmu, model).and_then(|file| package::for_page(model, &file));
        let files = match files {
            Err(missing) if model.identifier == AUTOPILOT.identifier => {
                errln!("without the autopilot: {missing:#}");
                continue;
            }
            files => files?,
        };
        let folder = folders.join(model.identifier);
        for (name, content) in files {
            write(&folder.join(name), content)?;
        }
        unpacked.push(folder);
    }
    Ok(unpacked)
}

/// A program of the page's sources; `fmus` are in folders with the names of their models.
fn node(stage: &Path, program: &str, fmus: &[PathBuf], output: &Path) -> Result<Command> {
    let mut command = Command::new("node");
    command.arg(program).current_dir(stage);
    for fmu in fmus {
        let mut argument = fmu.file_name().unwrap_or_default().to_os_string();
        argument.push("=");
        argument.push(fmu);
        command.arg("--fmu").arg(argument);
    }
    command.arg("--root").arg(root()).arg("--output").arg(std::path::absolute(output)?);
    Ok(command)
}
