//! The libraries of a package, which an archive of either version of FMI can hold.

use super::binary::Binary;
use super::platform::{LINUX, LINUX_ARM, MACOS, MACOS_ARM, Platform, WINDOWS, host};
use super::{Files, Targets, archive, library, of, platform, universal, wasm};
use crate::console;
use crate::models::PackagedModel;
use crate::python::Environment;
use crate::workspace::{MAX_BINARY_BYTES, read, shown};
use anyhow::{Context, Result, bail};
use fmi_model::platform::PLATFORMS;
use fmi_model::standard::Standard;
use std::path::Path;

/// What a full package contains besides the library for Linux on x86-64, where it is built.
const OTHERS: [Platform; 4] = [WINDOWS, LINUX_ARM, MACOS, MACOS_ARM];

/// A library with its inspected binary.
pub struct Library {
    pub platform: Platform,
    pub content: Vec<u8>,
    pub binary: Binary,
}

/// Libraries for an FMU.
pub struct Libraries {
    pub model: &'static PackagedModel,
    pub found: Vec<Library>,
    /// The WebAssembly component, which only FMI 3.0 knows.
    pub component: Option<Vec<u8>>,
    /// Whether they were given by the user.
    pub prebuilt: bool,
    /// Licences of what is in them, if they are of a package.
    pub licenses: Option<Files>,
    /// Libraries that could not be built as intended: what, why, and the remedy.
    pub missing: Vec<String>,
}

impl Libraries {
    fn none(model: &'static PackagedModel) -> Self {
        Self {
            model,
            found: Vec::new(),
            component: None,
            prebuilt: false,
            licenses: None,
            missing: Vec::new(),
        }
    }

    /// Those that the user names, as `platform=file`.
    pub fn given(model: &'static PackagedModel, options: &[String]) -> Result<Self> {
        let mut libraries = Self { prebuilt: true, ..Self::none(model) };
        for option in options {
            let (platform, file) = platform::parse_library_option(option)?;
            libraries.read(platform, &file)?;
        }
        Ok(libraries)
    }

    /// Those of a package, whose FMU of FMI 2.0 this is, for a vehicle in files: a component reads none.
    pub fn of_package(model: &'static PackagedModel, package: &Path) -> Result<Self> {
        let mut libraries = Self::none(model);
        for platform in PLATFORMS {
            let found = archive::library(package, model.identifier, platform);
            let Ok(content) = found else { continue };
            libraries.add(platform, content).with_context(|| shown(package))?;
        }
        libraries.missing.push("without WebAssembly: a component reads no files".to_string());
        libraries.licenses = Some(archive::entries(package, "documentation/licenses/")?);
        Ok(libraries)
    }

    /// Builds them; `package` is the existing one.
    pub fn build(model: &'static PackagedModel, targets: Targets, package: &Path) -> Result<Self> {
        let host = host()?;
        let mut libraries = Self::none(model);
        if targets == Targets::Host || host != LINUX {
            libraries.read(host, &library::for_host(model)?)?;
            if targets != Targets::Host {
                libraries.missing.push(format!(
                    "contains only {}: packages for all platforms are built on Linux (x86-64)",
                    host.fmi2
                ));
            }
            return Ok(libraries);
        }
        let zig = libraries.linux()?;
        match targets {
            Targets::AsExisting => libraries.keep(package)?,
            _ => libraries.others(zig.as_ref())?,
        }
        Ok(libraries)
    }

    /// Their names and contents in an archive.
    pub fn files(&self, standard: Standard) -> Files {
        let libraries = self.found.iter();
        let libraries = libraries.map(|library| (library.platform, library.content.as_slice()));
        let mut files = files(self.model.identifier, &libraries.collect::<Vec<_>>(), standard);
        if let (Standard::Fmi3, Some(component)) = (standard, &self.component) {
            files.insert(wasm::name(self.model.identifier), component.clone());
            files.extend(wasm::manifests());
        }
        files
    }

    pub fn get(&self, platform: Platform) -> Option<&Library> {
        self.found.iter().find(|library| library.platform == platform)
    }

    fn read(&mut self, platform: Platform, file: &Path) -> Result<&Binary> {
        self.add(platform, read(file, MAX_BINARY_BYTES)?).with_context(|| shown(file))
    }

    /// Inspects a library and adds it if it is valid for its platform.
    fn add(&mut self, platform: Platform, content: Vec<u8>) -> Result<&Binary> {
        if self.get(platform).is_some() {
            bail!("there are two libraries for {}", platform.fmi2);
        }
        let binary = Binary::parse(&content)?;
        binary.check(platform)?;
        self.found.push(Library { platform, content, binary });
        Ok(&self.found[self.found.len() - 1].binary)
    }

    /// Builds for Linux on x86-64; returns the linker for the other platforms.
    fn linux(&mut self) -> Result<Option<Environment>> {
        let identifier = self.model.identifier;
        match library::zig() {
            Ok(zig) => {
                let library = library::for_linux(&zig, self.model)?;
                self.read(LINUX, &library)?.check_everywhere(LINUX, identifier)?;
                Ok(Some(zig))
            }
            Err(error) => {
                let glibc =
                    self.read(LINUX, &library::for_host(self.model)?)?.glibc.unwrap_or_default();
                self.missing.push(format!(
                    "linux64 needs glibc {}.{}, as this machine has; supporting glibc 2.17 requires \
                     the linker of zig: {}",
                    glibc.0,
                    glibc.1,
                    console::error_chain(&error)
                ));
                Ok(None)
            }
        }
    }

    /// Builds for the other platforms where possible.
    fn others(&mut self, zig: Option<&Environment>) -> Result<()> {
        // Platforms that lack the same are told of together.
        let mut lacking: Vec<(String, Vec<&str>)> = Vec::new();
        let identifier = self.model.identifier;
        for platform in OTHERS {
            match library::builder(platform, zig) {
                Ok(builder) => {
                    let library = builder.build(self.model)?;
                    self.read(platform, &library)?.check_everywhere(platform, identifier)?;
                }
                Err(error) => {
                    let reason = console::error_chain(&error);
                    match lacking.iter_mut().find(|(known, _)| *known == reason) {
                        Some((_, platforms)) => platforms.push(platform.fmi2),
                        None => lacking.push((reason, vec![platform.fmi2])),
                    }
                }
            }
        }
        match wasm::component(identifier) {
            Ok(component) => self.component = Some(component),
            Err(error) => lacking.push((console::error_chain(&error), vec!["WebAssembly"])),
        }
        let told = lacking
            .into_iter()
            .map(|(reason, platforms)| format!("without {}: {reason}", platforms.join(", ")));
        self.missing.extend(told);
        Ok(())
    }

    /// Keeps the other platforms of a package whose library for Linux is the one just built: the model is the
    /// same.
    fn keep(&mut self, package: &Path) -> Result<()> {
        let identifier = self.model.identifier;
        let linux = self.get(LINUX).map(|library| library.content.clone()).unwrap_or_default();
        let mut lacking = Vec::new();
        for platform in OTHERS {
            match archive::kept(package, identifier, &linux, platform) {
                Some(content) => {
                    self.add(platform, content)?.check_everywhere(platform, identifier)?;
                }
                None => lacking.push(platform.fmi2),
            }
        }
        let fmi3 = of(Standard::Fmi3, package);
        self.component = archive::component(&fmi3, identifier, &linux).ok();
        if self.component.is_none() {
            lacking.push("WebAssembly");
        }
        if !lacking.is_empty() {
            let lacking = lacking.join(", ");
            self.missing.push(format!("without {lacking}; to add them: cargo ahv package"));
        }
        Ok(())
    }
}

/// Names and contents of libraries in an archive.
fn files(identifier: &str, libraries: &[(Platform, &[u8])], standard: Standard) -> Files {
    let named = |(platform, content): &(Platform, &[u8])| {
        (platform.binary(standard, identifier), content.to_vec())
    };
    let mut files: Files = libraries.iter().map(named).collect();
    // Some masters for FMI 2.0 look for ARM under the name of x86-64. On macOS one file can be for both.
    let find = |wanted| libraries.iter().find(|(platform, _)| *platform == wanted);
    if standard == Standard::Fmi2
        && let (Some((_, intel)), Some((_, arm))) = (find(MACOS), find(MACOS_ARM))
    {
        files.insert(MACOS.binary(standard, identifier), universal::join(&[intel, arm]));
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace::write;
    use fmi_model::archive::zip;
    use tempfile::TempDir;

    /// Libraries for all platforms of a package; those of macOS with the head of a Mach-O file.
    fn libraries() -> Vec<(Platform, Vec<u8>)> {
        let macho = |processor: u32| [0xfeed_facf_u32, processor, 0].map(u32::to_le_bytes).concat();
        vec![
            (LINUX, b"linux".to_vec()),
            (WINDOWS, b"windows".to_vec()),
            (LINUX_ARM, b"arm".to_vec()),
            (MACOS, macho(0x0100_0007)),
            (MACOS_ARM, macho(0x0100_000c)),
        ]
    }

    fn archived(standard: Standard) -> Files {
        let libraries = libraries();
        let borrowed: Vec<_> =
            libraries.iter().map(|(platform, content)| (*platform, content.as_slice())).collect();
        files("ahv", &borrowed, standard)
    }

    #[test]
    fn each_standard_names_every_library_and_fmi2_finds_both_macs_in_darwin64() {
        let names = |standard| archived(standard).into_keys().collect::<Vec<_>>();
        assert_eq!(
            names(Standard::Fmi3),
            [
                "binaries/aarch64-darwin/ahv.dylib",
                "binaries/aarch64-linux/ahv.so",
                "binaries/x86_64-darwin/ahv.dylib",
                "binaries/x86_64-linux/ahv.so",
                "binaries/x86_64-windows/ahv.dll",
            ]
        );
        assert_eq!(
            names(Standard::Fmi2),
            [
                "binaries/aarch64-darwin/ahv.dylib",
                "binaries/aarch64-linux/ahv.so",
                "binaries/darwin64/ahv.dylib",
                "binaries/linux64/ahv.so",
                "binaries/win64/ahv.dll",
            ]
        );
        let both = &archived(Standard::Fmi2)["binaries/darwin64/ahv.dylib"];
        for (platform, content) in &libraries()[3..] {
            assert_eq!(universal::part(both, *platform).unwrap(), content);
        }
        let alone = &archived(Standard::Fmi3)["binaries/x86_64-darwin/ahv.dylib"];
        assert_eq!(*alone, libraries()[3].1);
    }

    #[test]
    fn libraries_of_a_package_are_kept_only_beside_the_same_library_for_linux() {
        let directory = TempDir::new().unwrap();
        let package = directory.path().join("ahv.fmu");
        assert_eq!(archive::kept(&package, "ahv", b"linux", WINDOWS), None);
        write(&package, zip(&archived(Standard::Fmi2)).unwrap()).unwrap();
        for (platform, content) in libraries() {
            assert_eq!(archive::kept(&package, "ahv", b"linux", platform), Some(content));
            assert_eq!(archive::kept(&package, "ahv", b"changed", platform), None);
        }
    }
}
