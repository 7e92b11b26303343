//! `cargo ahv package`: builds the libraries and assembles the FMUs, one for each standard.

mod binary;
mod cross_check;
mod library;
mod platform;
mod reference_experiment;
mod terminals;
pub mod wasm;
mod windows;

use crate::cli::Package;
use crate::describe::{self, MODEL_IDENTIFIER};
use crate::fmu::Fmu;
use crate::workspace::{MAX_BINARY_BYTES, can_write, read, root, shown, target, write};
use crate::{console, documentation, licenses};
use anyhow::{Context, Result, bail};
pub use binary::Binary;
use fmi_model::archive::zip;
use fmi_model::standard::Standard;
pub use platform::host;
use platform::{LINUX, Platform, WINDOWS};
use std::collections::BTreeMap;
use std::env;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use zip::ZipArchive;

/// For which platforms an FMU is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Targets {
    /// This machine, with its C library.
    Host,
    /// The platforms of the existing package, or Linux.
    AsExisting,
    /// All that this machine can build for.
    Possible,
    /// Linux and Windows; a missing one is an error.
    All,
}

/// A library with its inspected binary.
struct Library {
    platform: Platform,
    content: Vec<u8>,
    binary: Binary,
}

/// Libraries for an FMU.
#[derive(Default)]
struct Libraries {
    found: Vec<Library>,
    /// Whether they were given by the user.
    prebuilt: bool,
    /// Libraries that could not be built as intended: what, why, and the remedy.
    missing: Vec<String>,
}

pub fn run(options: &Package) -> Result<()> {
    let targets = match (options.host_only, options.all_targets) {
        (true, _) => Targets::Host,
        (_, true) => Targets::All,
        _ => Targets::Possible,
    };
    let output = options.output.clone().unwrap_or_else(|| default_output(targets));
    can_write(&output)?;
    if options.library.is_empty() {
        return build(&output, targets);
    }
    let libraries_given = options.library.iter().map(|text| platform::parse_library_option(text));
    let mut libraries = Libraries::default();
    for library in libraries_given {
        libraries.add(library?)?;
    }
    libraries.prebuilt = true;
    package(libraries, &output)
}

/// Builds and packages.
pub fn build(output: &Path, targets: Targets) -> Result<()> {
    let libraries = match targets {
        Targets::Host => Libraries::host()?,
        Targets::AsExisting => Libraries::build(has_windows(output))?,
        Targets::Possible | Targets::All => Libraries::build(true)?,
    };
    if targets == Targets::All && !libraries.missing.is_empty() {
        bail!("{}", libraries.missing.join("\n"));
    }
    package(libraries, output)
}

/// Writes the FMUs; prints their platforms and dependencies.
fn package(libraries: Libraries, output: &Path) -> Result<()> {
    let host = host()?;
    let flies = libraries.found.iter().any(|library| library.platform == host);
    let mut flown = None;
    for standard in Standard::ALL {
        let mut files = contents(&libraries.found, standard)?;
        if flies {
            let found = match flown.take() {
                Some(found) => found,
                None => reference(&files, libraries.prebuilt)?,
            };
            files.extend(found.clone());
            flown = Some(found);
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

/// Whether a file is an FMU with a Windows library.
fn has_windows(file: &Path) -> bool {
    names(file).is_ok_and(|names| {
        let folder = format!("binaries/{}/", WINDOWS.fmi2);
        names.iter().any(|name| name.starts_with(&folder))
    })
}

/// Names of the files in a zip.
fn names(file: &Path) -> Result<Vec<String>> {
    let mut zip = ZipArchive::new(Cursor::new(read(file, MAX_BINARY_BYTES)?))?;
    let all = 0..zip.len();
    all.map(|index| Ok(zip.by_index_raw(index)?.name()?.into_owned())).collect()
}

/// An error if the Windows library cannot be built here.
pub fn can_build_for_windows() -> Result<()> {
    windows::toolchain().map(drop)
}

/// Default path of the FMU. A package for this machine only does not replace one for all platforms.
pub fn default_output(targets: Targets) -> PathBuf {
    let kind = if targets == Targets::Host { "-host" } else { "" };
    target().join(format!("{MODEL_IDENTIFIER}{kind}.fmu"))
}

impl Libraries {
    /// Inspects a library and adds it if it is valid for its platform.
    fn add(&mut self, (platform, file): (Platform, PathBuf)) -> Result<&Binary> {
        if self.found.iter().any(|known| known.platform == platform) {
            bail!("there are two libraries for {}", platform.fmi2);
        }
        let content = read(&file, MAX_BINARY_BYTES)?;
        let binary = Binary::parse(&content).with_context(|| shown(&file))?;
        binary.check(platform).with_context(|| shown(&file))?;
        self.found.push(Library { platform, content, binary });
        Ok(&self.found[self.found.len() - 1].binary)
    }

    /// Builds for this machine, as plain `cargo build` does.
    fn host() -> Result<Self> {
        let mut libraries = Self::default();
        libraries.add((host()?, library::for_host()?))?;
        Ok(libraries)
    }

    /// Builds for Linux and, if `windows`, for Windows where possible.
    fn build(windows: bool) -> Result<Self> {
        let mut libraries = Self::default();
        let host = host()?;
        if host != LINUX {
            libraries = Self::host()?;
            libraries.missing.push(format!(
                "contains only {}: packages for Linux and Windows are built on Linux (x86-64)",
                host.fmi2
            ));
            return Ok(libraries);
        }
        match library::zig() {
            Ok(zig) => {
                let library = library::for_linux(&zig)?;
                libraries.add((LINUX, library))?.check_everywhere(LINUX)?;
            }
            Err(error) => {
                let library = library::for_host()?;
                let glibc = libraries.add((LINUX, library))?.glibc.unwrap_or_default();
                libraries.missing.push(format!(
                    "linux64 needs glibc {}.{}, as this machine has; supporting glibc 2.17 requires \
                     the linker of zig: {}",
                    glibc.0,
                    glibc.1,
                    console::error_chain(&error)
                ));
            }
        }
        if !windows {
            let missing = "without Windows; to add it: cargo ahv package";
            libraries.missing.push(missing.to_string());
            return Ok(libraries);
        }
        match windows::toolchain() {
            Ok(toolchain) => {
                let library = library::for_windows(toolchain)?;
                libraries.add((WINDOWS, library))?.check_everywhere(WINDOWS)?;
            }
            Err(error) => libraries.missing.push(console::error_chain(&error)),
        }
        Ok(libraries)
    }
}

/// Where the FMU of a standard is written if that of FMI 2.0 is written to `output`.
pub fn of(standard: Standard, output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    match standard {
        Standard::Fmi2 => output.to_path_buf(),
        Standard::Fmi3 => output.with_file_name(standard.file_name(&stem)),
    }
}

/// Files of the FMU, by name.
type Files = BTreeMap<String, Vec<u8>>;

fn contents(libraries: &[Library], standard: Standard) -> Result<Files> {
    let mut files = Files::new();
    files.insert("modelDescription.xml".to_string(), describe::xml(standard)?.into_bytes());
    files.extend(licenses::collect()?);
    files.extend(terminals::files()?);
    if standard == Standard::Fmi2 {
        files.insert("model.png".to_string(), icon("vehicle")?);
    }
    let mut machines = Vec::new();
    for Library { platform, content, binary } in libraries {
        let name = platform.binary(standard, MODEL_IDENTIFIER);
        machines.push(platform::machines(*platform, binary.glibc));
        files.insert(name, content.clone());
    }
    let page = documentation::html(&machines)?;
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
