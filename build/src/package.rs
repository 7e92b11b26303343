//! `cargo ahv package`: builds the libraries and assembles the FMUs, one for each standard.

mod archive;
mod binary;
mod cross_check;
mod libraries;
mod library;
mod macos;
mod platform;
mod reference_experiment;
mod toolchain;
mod trial;
pub mod universal;
mod wasm;

use crate::cli::Package;
use crate::fmu::Fmu;
use crate::models::{Content, MODELS, PackagedModel, VEHICLE, vehicle};
use crate::own_vehicle::OwnVehicle;
use crate::workspace::{MAX_BINARY_BYTES, can_write, read, root, shown, target, write};
use crate::{documentation, licenses};
use ahv::data::OwnFiles;
use anyhow::{Context, Result, bail};
pub use binary::Binary;
use fmi_model::archive::zip;
use fmi_model::describe::terminals::terminals_and_icons;
use fmi_model::standard::Standard;
use libraries::{Libraries, Library};
pub use library::guard_on_arm;
pub use platform::{LINUX_ARM, Platform, WINDOWS, host};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
pub use trial::step as trial_step;

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
    let is_of_one = own.is_given() || options.output.is_some() || !options.library.is_empty();
    let model = match options.model {
        None if !is_of_one => return build_all(targets),
        None => &VEHICLE,
        Some(model) if own.is_given() && model.identifier != VEHICLE.identifier => {
            bail!("--vehicle and --coefficients are data of the vehicle; {} has none", model.name)
        }
        Some(model) => model,
    };
    let default = || own.results().join(file_name(model, targets));
    let output = options.output.clone().unwrap_or_else(default);
    can_write(&output)?;
    let files = own.files()?;
    if !options.library.is_empty() {
        let content = if own.is_given() { vehicle::content(&files) } else { (model.content)() };
        return package(Libraries::given(model, &options.library)?, &content?, &output);
    }
    if own.is_given() {
        with_data(&files, &output, targets)
    } else {
        build(model, &output, targets)
    }
}

/// The package of the user's vehicle: the libraries of the existing one, which is built first if it is not there
/// or not of these sources, with other data.
fn with_data(files: &OwnFiles, output: &Path, targets: Targets) -> Result<()> {
    let content = vehicle::content(files)?;
    let built_in = default_output(&VEHICLE, targets);
    if targets == Targets::All || !is_current(&VEHICLE, &built_in) {
        build(&VEHICLE, &built_in, targets)?;
    }
    package(Libraries::of_package(&VEHICLE, &built_in)?, &content, output)
}

/// Whether a file is the package of a model, as the sources describe it.
pub fn is_current(model: &PackagedModel, file: &Path) -> bool {
    let found = archive::entry(file, "modelDescription.xml");
    matches!((found, (model.content)()), (Ok(found), Ok(expected)) if found == expected.xml(Standard::Fmi2).as_bytes())
}

/// Packages the user's vehicle at its default path.
pub fn own_default(own: &OwnVehicle, targets: Targets) -> Result<PathBuf> {
    let output = own.results().join(file_name(&VEHICLE, targets));
    with_data(&own.files()?, &output, targets)?;
    Ok(output)
}

/// Builds and packages all models at their default paths.
pub fn build_all(targets: Targets) -> Result<()> {
    MODELS.iter().try_for_each(|model| build(model, &default_output(model, targets), targets))
}

/// Builds and packages.
pub fn build(model: &'static PackagedModel, output: &Path, targets: Targets) -> Result<()> {
    can_write(output)?;
    let libraries = Libraries::build(model, targets, output)?;
    if targets == Targets::All && !libraries.missing.is_empty() {
        bail!("{}", libraries.missing.join("\n"));
    }
    package(libraries, &(model.content)()?, output)
}

/// Writes the FMUs; prints their platforms and dependencies.
fn package(libraries: Libraries, content: &Content, output: &Path) -> Result<()> {
    let (host, model) = (host()?, libraries.model);
    // What both standards have alike is found once.
    let mut same = libraries.licenses.clone().map_or_else(|| licenses::collect(model), Ok)?;
    same.extend(terminals(model)?);
    let resources = content.resources.iter();
    same.extend(resources.map(|(name, file)| (format!("resources/{name}"), file.clone())));
    for standard in Standard::ALL {
        let mut files = contents(&libraries, content, standard)?;
        files.extend(same.clone());
        if standard == Standard::Fmi2 && libraries.get(host).is_some() {
            let added = trial::files(model, &files, libraries.prebuilt)?;
            files.extend(added.clone());
            same.extend(added);
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

/// Builds the vehicle's FMU at its default path.
pub fn build_default(targets: Targets) -> Result<PathBuf> {
    let output = default_output(&VEHICLE, targets);
    build(&VEHICLE, &output, targets)?;
    Ok(output)
}

/// An error if the library for another platform cannot be built here.
pub fn can_build_for(platform: Platform) -> Result<()> {
    library::builder(platform, library::zig().ok().as_ref()).map(drop)
}

/// Default path of a model's FMU. A package for this machine only does not replace one for all platforms.
pub fn default_output(model: &PackagedModel, targets: Targets) -> PathBuf {
    target().join(file_name(model, targets))
}

fn file_name(model: &PackagedModel, targets: Targets) -> String {
    let kind = if targets == Targets::Host { "-host" } else { "" };
    format!("{}{kind}.fmu", model.identifier)
}

/// The FMU of a model beside the vehicle's, which has the same kind of name.
pub fn beside(vehicle: &Path, model: &PackagedModel) -> Result<PathBuf> {
    let name = vehicle.file_name().unwrap_or_default().to_string_lossy();
    let rest = name.strip_prefix(VEHICLE.identifier).with_context(|| {
        format!("{name} does not begin with {}: the vehicle's FMU is expected", VEHICLE.identifier)
    })?;
    Ok(vehicle.with_file_name(format!("{}{rest}", model.identifier)))
}

/// Where the FMU of a standard is written if that of FMI 2.0 is written to `output`.
pub fn of(standard: Standard, output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    match standard {
        Standard::Fmi2 => output.to_path_buf(),
        Standard::Fmi3 => output.with_file_name(standard.file_name(&stem)),
    }
}

/// The WebAssembly component, the description, the documentation and the pictures of a model's FMU of FMI 3.0; that of
/// FMI 2.0 is at `output`.
pub fn for_page(model: &PackagedModel, output: &Path) -> Result<Files> {
    let fmu = of(Standard::Fmi3, output);
    let description = "modelDescription.xml".to_string();
    let mut files = Files::from([
        (wasm::name(model.identifier), component(model, output)?),
        (description.clone(), archive::entry(&fmu, &description)?),
    ]);
    for folder in ["documentation", "terminalsAndIcons"] {
        files.extend(archive::entries(&fmu, folder)?);
    }
    Ok(files)
}

/// The WebAssembly component of a model's package, whose FMU of FMI 2.0 is at `output`.
pub fn component(model: &PackagedModel, output: &Path) -> Result<Vec<u8>> {
    archive::entry(&of(Standard::Fmi3, output), &wasm::name(model.identifier))
        .context("there is no WebAssembly component; to add it: cargo ahv package")
}

/// Files of the FMU, by name.
pub type Files = BTreeMap<String, Vec<u8>>;

/// What an FMU has for its standard alone.
fn contents(libraries: &Libraries, content: &Content, standard: Standard) -> Result<Files> {
    let mut files = Files::new();
    let xml = content.xml(standard).as_bytes().to_vec();
    files.insert("modelDescription.xml".to_string(), xml);
    if standard == Standard::Fmi2 {
        files.insert("model.png".to_string(), icon(libraries.model.icon)?);
    }
    files.extend(libraries.files(standard));
    let machines: Vec<_> = libraries
        .found
        .iter()
        .map(|library| platform::machines(library.platform, library.binary.glibc))
        .collect();
    let page = documentation::html(content, standard, &machines)?;
    files.insert("documentation/index.html".to_string(), page.into_bytes());
    Ok(files)
}

/// terminalsAndIcons: groups of inputs and outputs that a tool can connect as one (FMI 2.0.4,
/// section 2.3; file format of FMI 3.0, section 2.4.9).
fn terminals(model: &PackagedModel) -> Result<Files> {
    let xml = terminals_and_icons(model.terminals)?.into_bytes();
    let mut files = Files::from([("terminalsAndIcons/terminalsAndIcons.xml".to_string(), xml)]);
    for (name, picture) in [("icon", model.icon), ("input", "input"), ("output", "output")] {
        files.insert(format!("terminalsAndIcons/{name}.png"), icon(picture)?);
    }
    Ok(files)
}

/// An image of the FMU.
fn icon(name: &str) -> Result<Vec<u8>> {
    read(&root().join(format!("build/icons/{name}.png")), MAX_BINARY_BYTES)
}

/// Inputs and outputs of the vehicle's reference flight, flown with the package as it will be written.
pub fn reference_flight(fmu: &Fmu) -> Result<Files> {
    let mut found = cross_check::fly_reference(fmu)?;
    found.extend(reference_experiment::files(&fmu.model)?);
    Ok(found)
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
