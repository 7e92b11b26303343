//! Builds the libraries and puts the FMU together.

mod archive;
mod binary;
mod cross_check;
mod icon;
mod library;
mod platform;
mod related;
mod terminals;
mod windows;

use crate::cli::Package;
use crate::describe::{self, MODEL_IDENTIFIER};
use crate::fmu::Fmu;
use crate::workspace::{BINARY, read, shown, target, write};
use crate::{documentation, licenses};
use anyhow::{Result, bail};
use binary::Binary;
pub use platform::HOST;
use platform::{LINUX, Platform, WINDOWS};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// For which platforms an FMU is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Targets {
    /// This machine's, with this machine's C library.
    Host,
    /// As many as this machine can build for.
    Possible,
    /// A missing one is an error.
    All,
}

/// Libraries for an FMU.
#[derive(Default)]
struct Libraries {
    found: Vec<(Platform, PathBuf)>,
    /// What could not be built as it should be, why, and what to do.
    missing: Vec<String>,
}

pub fn run(options: &Package) -> Result<()> {
    let output = options.output.clone().unwrap_or_else(default_output);
    if options.library.is_empty() {
        let targets = match (options.host_only, options.all_targets) {
            (true, _) => Targets::Host,
            (_, true) => Targets::All,
            _ => Targets::Possible,
        };
        return build(&output, targets);
    }
    let given = options.library.iter().map(|text| platform::given(text));
    write_fmu(contents(&given.collect::<Result<Vec<_>>>()?)?, &output)
}

/// Builds and packages.
pub fn build(output: &Path, targets: Targets) -> Result<()> {
    let libraries = match targets {
        Targets::Host => Libraries::host()?,
        _ => Libraries::build()?,
    };
    if targets == Targets::All && !libraries.missing.is_empty() {
        bail!("{}", libraries.missing.join("\n"));
    }
    let mut files = contents(&libraries.found)?;
    files.extend(reference(&files)?);
    write_fmu(files, output)?;
    for (platform, library) in &libraries.found {
        let binary = Binary::parse(&read(library, BINARY)?)?;
        let needed: Vec<_> = binary.needed.iter().map(String::as_str).collect();
        let glibc = binary.glibc.map(|(major, minor)| format!("glibc {major}.{minor}: "));
        println!("  {} needs {}{}", platform.name, glibc.unwrap_or_default(), needed.join(", "));
    }
    for text in libraries.missing {
        println!("  {text}");
    }
    Ok(())
}

/// The FMU at its usual place, built anew.
pub fn fresh(targets: Targets) -> Result<PathBuf> {
    let output = default_output();
    build(&output, targets)?;
    Ok(output)
}

/// Says what is missing for a Windows library.
pub fn can_build_for_windows() -> Result<()> {
    windows::toolchain().map(drop)
}

/// Where the FMU goes if nothing else is said.
pub fn default_output() -> PathBuf {
    target().join(MODEL_IDENTIFIER).with_extension("fmu")
}

impl Libraries {
    /// Compiles for this machine as Cargo does.
    fn host() -> Result<Self> {
        Ok(Self { found: vec![(HOST, library::for_host()?)], missing: Vec::new() })
    }

    /// Compiles for all platforms that this machine can compile for.
    fn build() -> Result<Self> {
        let mut libraries = Self::default();
        if HOST != LINUX {
            libraries = Self::host()?;
            libraries.missing.push(format!(
                "only {} is in it: the FMU for Linux and Windows is built on Linux",
                HOST.name
            ));
            return Ok(libraries);
        }
        match library::zig() {
            Ok(zig) => {
                let library = library::for_linux(&zig)?;
                Binary::parse(&read(&library, BINARY)?)?.check(LINUX)?;
                libraries.found.push((LINUX, library));
            }
            Err(error) => {
                let library = library::for_host()?;
                let glibc = Binary::parse(&read(&library, BINARY)?)?.glibc.unwrap_or_default();
                libraries.missing.push(format!(
                    "linux64 is for machines like this one: it needs glibc {}.{}. For glibc 2.17 \
                     the linker of zig is needed: {error:#}",
                    glibc.0, glibc.1
                ));
                libraries.found.push((LINUX, library));
            }
        }
        match windows::toolchain() {
            Ok(toolchain) => {
                let library = library::for_windows(toolchain)?;
                Binary::parse(&read(&library, BINARY)?)?.check(WINDOWS)?;
                libraries.found.push((WINDOWS, library));
            }
            Err(error) => libraries.missing.push(format!("{error:#}")),
        }
        Ok(libraries)
    }
}

/// Files of the FMU by their names.
type Files = BTreeMap<String, Vec<u8>>;

fn contents(libraries: &[(Platform, PathBuf)]) -> Result<Files> {
    let mut files = Files::new();
    files.insert("modelDescription.xml".to_string(), describe::xml()?.into_bytes());
    files.extend(licenses::collect()?);
    let picture = icon::png()?;
    files.extend(terminals::files(&picture)?);
    files.insert("model.png".to_string(), picture);
    let mut machines = Vec::new();
    for (platform, library) in libraries {
        let name = format!("binaries/{}/{MODEL_IDENTIFIER}.{}", platform.name, platform.ending);
        let library = read(library, BINARY)?;
        let glibc = Binary::parse(&library).ok().and_then(|binary| binary.glibc);
        machines.push(platform.machines(glibc));
        files.insert(name, library);
    }
    let page = documentation::html(&machines)?;
    files.insert("documentation/index.html".to_string(), page.into_bytes());
    Ok(files)
}

/// What comes out when the FMU is flown; it is flown as it will be packaged.
fn reference(files: &Files) -> Result<Files> {
    let directory = TempDir::with_prefix("fmu-")?;
    let file = directory.path().join("ahv.fmu");
    write(&file, archive::zip(files)?)?;
    let fmu = Fmu::open(&file)?;
    let mut found = cross_check::fly_reference(&fmu)?;
    found.extend(related::files(&fmu.model)?);
    Ok(found)
}

/// Writes the FMU and says what it is.
fn write_fmu(files: Files, output: &Path) -> Result<()> {
    let bytes = archive::zip(&files)?;
    write(output, &bytes)?;
    let platforms: Vec<_> =
        files.keys().filter_map(|name| name.strip_prefix("binaries/")?.split('/').next()).collect();
    println!("{}: {} kB, {}", shown(output), bytes.len().div_ceil(1000), platforms.join(", "));
    let digest: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    println!("  sha256 {digest}");
    Ok(())
}
