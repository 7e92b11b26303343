//! `cargo ahv package`: builds the libraries and assembles the FMUs, one for each standard.

mod binary;
mod cross_check;
mod libraries;
mod library;
mod macos;
mod platform;
mod reference_experiment;
mod terminals;
mod toolchain;
pub mod universal;
mod wasm;

use crate::cli::Package;
use crate::describe::{self, MODEL_IDENTIFIER};
use crate::fmu::Fmu;
use crate::own_vehicle::{self, OwnVehicle};
use crate::workspace::{MAX_BINARY_BYTES, can_write, read, root, shown, write};
use crate::{documentation, licenses};
use ahv::data::OwnFiles;
use ahv::flight::Setup;
use anyhow::{Context, Result, bail};
pub use binary::Binary;
use fmi_model::archive::zip;
use fmi_model::standard::Standard;
use libraries::{Libraries, Library};
pub use library::guard_on_arm;
pub use platform::{LINUX_ARM, Platform, WINDOWS, host};
use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// For which platforms an FMU is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Targets {
    /// This machine, with its C library.
    Host,
    /// This machine, and the other platforms of the existing package if the model is the same.
    AsExisting,
    /// All that this machine can build for.
    Possible,
    /// All; a missing one is an error.
    All,
}

pub fn run(options: &Package) -> Result<()> {
    let targets = match (options.host_only, options.all_targets) {
        (true, _) => Targets::Host,
        (_, true) => Targets::All,
        _ => Targets::Possible,
    };
    let own = &options.own_vehicle;
    let output = options.output.clone().unwrap_or_else(|| own_output(own, targets));
    can_write(&output)?;
    let files = own.files()?;
    own_vehicle::setup(&files)?;
    if !options.library.is_empty() {
        return package(Libraries::given(&options.library)?, &files, &output);
    }
    if own.is_given() { with_data(&files, &output, targets) } else { build(&output, targets) }
}

/// The package of the user's vehicle: the libraries of the existing one, which is built first if it is not there
/// or not of these sources, with other data.
fn with_data(files: &OwnFiles, output: &Path, targets: Targets) -> Result<()> {
    let built_in = default_output(targets);
    if targets == Targets::All || !is_current(&built_in) {
        build(&built_in, targets)?;
    }
    package(Libraries::of_package(&built_in)?, files, output)
}

/// Whether a file is the package of the built-in vehicle, as the sources describe it.
pub fn is_current(file: &Path) -> bool {
    let found = libraries::entry(file, "modelDescription.xml");
    matches!((found, describe::xml(Standard::Fmi2)), (Ok(found), Ok(xml)) if found == xml.as_bytes())
}

/// Packages the user's vehicle at its default path.
pub fn own_default(own: &OwnVehicle, targets: Targets) -> Result<PathBuf> {
    let output = own_output(own, targets);
    with_data(&own.files()?, &output, targets)?;
    Ok(output)
}

/// Builds and packages.
pub fn build(output: &Path, targets: Targets) -> Result<()> {
    let libraries = Libraries::build(targets, output)?;
    if targets == Targets::All && !libraries.missing.is_empty() {
        bail!("{}", libraries.missing.join("\n"));
    }
    package(libraries, &OwnFiles::default(), output)
}

/// Writes the FMUs; prints their platforms and dependencies.
fn package(libraries: Libraries, own: &OwnFiles, output: &Path) -> Result<()> {
    let host = host()?;
    let setup = own_vehicle::setup(own)?;
    // What both standards have alike is found once.
    let mut same = libraries.licenses.clone().map_or_else(licenses::collect, Ok)?;
    same.extend(terminals::files()?);
    same.extend(resources(own));
    for standard in Standard::ALL {
        let mut files = contents(&libraries, &setup, standard)?;
        files.extend(same.clone());
        if standard == Standard::Fmi2 && libraries.get(host).is_some() {
            let flown = reference(&files, libraries.prebuilt)?;
            files.extend(flown.clone());
            same.extend(flown);
        }
        write_fmu(files, &of(standard, output))?;
    }
    for Library { platform, binary, .. } in &libraries.found {
        let needed: Vec<_> = binary.needed.iter().map(String::as_str).collect();
        let glibc = binary.glibc.map(|(major, minor)| format!("glibc {major}.{minor}: "));
        outln!("  {} needs {}{}", platform.fmi2, glibc.unwrap_or_default(), needed.join(", "))?;
    }
    for text in libraries.missing {
        outln!("  {text}")?;
    }
    Ok(())
}

/// Builds the FMU at its default path.
pub fn build_default(targets: Targets) -> Result<PathBuf> {
    let output = default_output(targets);
    build(&output, targets)?;
    Ok(output)
}

/// An error if the library for another platform cannot be built here.
pub fn can_build_for(platform: Platform) -> Result<()> {
    library::builder(platform, library::zig().ok().as_ref()).map(drop)
}

/// Default path of the FMU. A package for this machine only does not replace one for all platforms.
pub fn default_output(targets: Targets) -> PathBuf {
    own_output(&OwnVehicle::default(), targets)
}

/// The same of the user's vehicle.
fn own_output(own: &OwnVehicle, targets: Targets) -> PathBuf {
    let kind = if targets == Targets::Host { "-host" } else { "" };
    own.results().join(format!("{MODEL_IDENTIFIER}{kind}.fmu"))
}

/// Where the FMU of a standard is written if that of FMI 2.0 is written to `output`.
pub fn of(standard: Standard, output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    match standard {
        Standard::Fmi2 => output.to_path_buf(),
        Standard::Fmi3 => output.with_file_name(standard.file_name(&stem)),
    }
}

/// The WebAssembly component of a package, whose FMU of FMI 2.0 is at `output`.
pub fn component(output: &Path) -> Result<Vec<u8>> {
    libraries::entry(&of(Standard::Fmi3, output), &wasm::name())
        .context("there is no WebAssembly component; to add it: cargo ahv package")
}

/// Files of the FMU, by name.
type Files = BTreeMap<String, Vec<u8>>;

/// The user's data files.
fn resources(own: &OwnFiles) -> Files {
    [(OwnFiles::VEHICLE, &own.vehicle), (OwnFiles::COEFFICIENTS, &own.coefficients)]
        .into_iter()
        .filter_map(|(name, file)| {
            let text = file.as_ref()?.text.clone();
            Some((format!("resources/{name}"), text.into_bytes()))
        })
        .collect()
}

/// What an FMU has for its standard alone.
fn contents(libraries: &Libraries, setup: &Setup, standard: Standard) -> Result<Files> {
    let mut files = Files::new();
    let xml = describe::xml_of(setup, standard)?;
    files.insert("modelDescription.xml".to_string(), xml.into_bytes());
    if standard == Standard::Fmi2 {
        files.insert("model.png".to_string(), icon("vehicle")?);
    }
    files.extend(libraries.files(standard));
    let machines: Vec<_> = libraries
        .found
        .iter()
        .map(|library| platform::machines(library.platform, library.binary.glibc))
        .collect();
    let page = documentation::html(setup, standard, &machines)?;
    files.insert("documentation/index.html".to_string(), page.into_bytes());
    Ok(files)
}

/// An image of the FMU.
fn icon(name: &str) -> Result<Vec<u8>> {
    read(&root().join(format!("build/icons/{name}.png")), MAX_BINARY_BYTES)
}

/// Inputs and outputs of the reference flight, flown with the package as it will be written.
fn reference(files: &Files, prebuilt: bool) -> Result<Files> {
    let directory = TempDir::with_prefix("fmu-")?;
    let file = directory.path().join("ahv.fmu");
    write(&file, zip(files)?)?;
    if prebuilt {
        run_in_child_process(&file)?;
    }
    let fmu = Fmu::open(&file)?;
    let mut found = cross_check::fly_reference(&fmu)?;
    found.extend(reference_experiment::files(&fmu.model)?);
    Ok(found)
}

/// Flies a prebuilt library in a child process first, because it may crash its process. Other failures are
/// reported by the reference flight.
fn run_in_child_process(file: &Path) -> Result<()> {
    let results = TempDir::with_prefix("fmu-")?;
    let mut fly = Command::new(env::current_exe()?);
    fly.args(["fly", "--stop", "0.1", "--fmu"]).arg(file).arg("--output").arg(results.path());
    let status = fly.output()?.status;
    if status.code().is_none() {
        bail!("the library for this machine crashes the process that loads it: {status}");
    }
    Ok(())
}

/// Writes the FMU; prints its size, platforms and checksum.
fn write_fmu(files: Files, output: &Path) -> Result<()> {
    let bytes = zip(&files)?;
    write(output, &bytes)?;
    let platforms: Vec<_> =
        files.keys().filter_map(|name| name.strip_prefix("binaries/")?.split('/').next()).collect();
    outln!("{}: {} kB, {}", shown(output), bytes.len().div_ceil(1000), platforms.join(", "))?;
    let digest: String =
        hmac_sha256::Hash::hash(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    outln!("  sha256 {digest}")?;
    Ok(())
}
