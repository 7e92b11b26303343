//! Inspects a library: format, dependencies and exported functions.

mod elf;
mod macho;

use super::platform::Platform;
use anyhow::{Context, Result, bail};
use elf::version;
use fmi_model::export::exported;
use macho::MachO;
use object::read::{File, NameOrOrdinal};
use object::{Architecture, BinaryFormat, Object, ObjectKind, ObjectSection};
use std::collections::BTreeSet;

/// Version of the GNU C library: major, minor.
pub type Glibc = (u32, u32);

/// The newest glibc that the Linux library may need: that of Rust's standard library, and of the oldest
/// distributions in use.
pub const GLIBC: Glibc = (2, 17);

/// Parts of glibc, which every Linux has.
const LINUX_LIBRARIES: [&str; 6] = [
    "libc.so.6",
    "libm.so.6",
    "libpthread.so.0",
    "libdl.so.2",
    "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
];

/// Linked by default; on nearly every Linux, but not on all.
const UNWINDER: &str = "libgcc_s.so.1";

/// Libraries that every Windows has, in lower case.
const WINDOWS_LIBRARIES: [&str; 9] = [
    "kernel32.dll",
    "kernelbase.dll",
    "ntdll.dll",
    "msvcrt.dll",
    "advapi32.dll",
    "bcryptprimitives.dll",
    "userenv.dll",
    "ws2_32.dll",
    "api-ms-win-core-synch-l1-2-0.dll",
];

/// Where macOS keeps its own libraries.
const MACOS_FOLDERS: [&str; 2] = ["/usr/lib/", "/System/Library/"];

/// Properties of a library.
#[derive(Debug)]
pub struct Binary {
    format: BinaryFormat,
    architecture: Architecture,
    /// Newest version of glibc that a symbol needs; `None` without such a symbol.
    pub glibc: Option<Glibc>,
    /// Names of the libraries that are loaded with it.
    pub needed: BTreeSet<String>,
    macho: Option<MachO>,
    /// Names of exported functions.
    exports: BTreeSet<String>,
}

impl Binary {
    /// Reads an ELF, PE or Mach-O file.
    pub fn parse(bytes: &[u8]) -> Result<Self> {
        const OTHER: &str = "this is not a shared library";
        let file = File::parse(bytes).ok().context(OTHER)?;
        if file.kind() != ObjectKind::Dynamic {
            bail!(OTHER);
        }
        for section in file.sections() {
            section.data().ok().context("the end of this library is missing")?;
        }
        let (format, architecture) = (file.format(), file.architecture());
        // Mach-O puts an underscore before every C name.
        let prefix = if format == BinaryFormat::MachO { "_" } else { "" };
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let exports = file.exports()?.map(|export| {
            Ok(match export?.name() {
                NameOrOrdinal::Name(name) => text(name).trim_start_matches(prefix).to_string(),
                NameOrOrdinal::Ordinal(number) => format!("number {number}"),
            })
        });
        let exports = exports.collect::<Result<_>>()?;
        let other = Self {
            format,
            architecture,
            glibc: None,
            needed: BTreeSet::new(),
            macho: None,
            exports,
        };
        if let File::Elf64(_) = file {
            let (needed, versions) = elf::dependencies(bytes)?;
            let glibc = versions.iter().filter_map(|name| version(name)).max();
            return Ok(Self { glibc, needed, ..other });
        }
        if let File::MachO64(file) = &file {
            let (macho, needed) = macho::properties(file)?;
            return Ok(Self { needed, macho: Some(macho), ..other });
        }
        let imports = file.imports()?.map(|import| Ok(text(import?.library())));
        let mut needed = imports.collect::<Result<BTreeSet<_>>>()?;
        if format == BinaryFormat::Pe {
            needed = needed.iter().map(|name| name.to_lowercase()).collect();
        }
        Ok(Self { needed, ..other })
    }

    /// Checks operating system and processor.
    pub fn is_for(&self, platform: Platform) -> Result<()> {
        let format = match platform.os {
            "linux" => BinaryFormat::Elf,
            "windows" => BinaryFormat::Pe,
            _ => BinaryFormat::MachO,
        };
        let architecture = match platform.arch {
            "x86_64" => Architecture::X86_64,
            _ => Architecture::Aarch64,
        };
        if (self.format, self.architecture) != (format, architecture) {
            bail!(
                "{} needs {format:?} for {architecture:?}, this is {:?} for {:?}",
                platform.fmi2,
                self.format,
                self.architecture
            );
        }
        Ok(())
    }

    /// Checks that the library is for the platform, exports exactly the functions of FMI 2.0 and 3.0, and depends only
    /// on libraries of the system.
    pub fn check(&self, platform: Platform) -> Result<()> {
        self.is_for(platform)?;
        let known: fn(&str) -> bool = match platform.os {
            "linux" => |name| LINUX_LIBRARIES.contains(&name) || name == UNWINDER,
            "windows" => |name| WINDOWS_LIBRARIES.contains(&name),
            _ => |name| MACOS_FOLDERS.iter().any(|folder| name.starts_with(folder)),
        };
        let foreign: Vec<_> = self.needed.iter().filter(|name| !known(name)).cloned().collect();
        if !foreign.is_empty() {
            bail!("{} needs {}: not part of the system", platform.fmi2, foreign.join(", "));
        }
        let standard: BTreeSet<_> = exported().map(str::to_string).collect();
        let lacking: Vec<_> = standard.difference(&self.exports).cloned().collect();
        if lacking.len() == standard.len() {
            bail!(
                "{} needs the functions of FMI 2.0 and 3.0: this library has none",
                platform.fmi2
            );
        }
        if !lacking.is_empty() {
            bail!("{} lacks functions of FMI 2.0 or 3.0: {}", platform.fmi2, lacking.join(", "));
        }
        let more: Vec<_> = self.exports.difference(&standard).cloned().collect();
        if !more.is_empty() {
            bail!(
                "{} exports functions that are not in FMI 2.0 or 3.0: {}",
                platform.fmi2,
                more.join(", ")
            );
        }
        self.macho.as_ref().map_or(Ok(()), |macho| macho.check(platform))
    }

    /// Also checks that old systems have the dependencies, and on macOS the name of the library.
    pub fn check_everywhere(&self, platform: Platform, identifier: &str) -> Result<()> {
        self.check(platform)?;
        if self.needed.contains(UNWINDER) {
            bail!("{} needs {UNWINDER}: not part of every system", platform.fmi2);
        }
        if let Some((major, minor)) = self.glibc.filter(|version| *version > GLIBC) {
            let (most, least) = GLIBC;
            bail!("{} needs glibc {major}.{minor}, newer than {most}.{least}", platform.fmi2);
        }
        self.macho.as_ref().map_or(Ok(()), |macho| macho.check_everywhere(platform, identifier))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::package::platform::{LINUX, WINDOWS};

    fn binary(platform: Platform, glibc: Glibc, needed: &str) -> Binary {
        let elf = platform == LINUX;
        Binary {
            format: if elf { BinaryFormat::Elf } else { BinaryFormat::Pe },
            architecture: Architecture::X86_64,
            glibc: elf.then_some(glibc),
            needed: [needed.to_string()].into(),
            macho: None,
            exports: exported().map(str::to_string).collect(),
        }
    }

    #[test]
    fn versions_are_compared_by_number() {
        assert_eq!(version("GLIBC_2.2.5"), Some((2, 2)));
        assert_eq!(version("GLIBC_2.17"), Some((2, 17)));
        assert_eq!(version("GCC_3.0"), None);
        assert!(version("GLIBC_PRIVATE") > Some(GLIBC));
        assert!(version("GLIBC_2.4") < version("GLIBC_2.17"));
    }

    #[test]
    fn what_users_may_not_have_is_refused() {
        let linux = |glibc, needed| binary(LINUX, glibc, needed);
        assert!(linux((2, 17), "libc.so.6").check_everywhere(LINUX, "ahv").is_ok());
        for (binary, platform, reason) in [
            (linux((2, 18), "libc.so.6"), LINUX, "needs glibc 2.18"),
            (linux((2, 17), UNWINDER), LINUX, "needs libgcc_s.so.1"),
            (linux((2, 17), "libz.so.1"), LINUX, "needs libz.so.1"),
            (binary(WINDOWS, GLIBC, "libwinpthread-1.dll"), WINDOWS, "needs libwinpthread-1.dll"),
            (linux((2, 17), "libc.so.6"), WINDOWS, "win64 needs Pe for X86_64, this is Elf"),
        ] {
            let message = binary.check_everywhere(platform, "ahv").unwrap_err().to_string();
            assert!(message.contains(reason), "{message}");
        }
        // A library for this machine only may use everything that it has.
        assert!(linux((2, 36), UNWINDER).check(LINUX).is_ok());
        let mut arm = linux((2, 17), "libc.so.6");
        arm.architecture = Architecture::Aarch64;
        assert!(arm.check(LINUX).unwrap_err().to_string().contains("this is Elf for Aarch64"));
        let mut more = linux((2, 17), "libc.so.6");
        more.exports.insert("rust_eh_personality".into());
        assert!(more.check(LINUX).unwrap_err().to_string().contains("rust_eh_personality"));
        let mut less = linux((2, 17), "libc.so.6");
        less.exports.remove("fmi2DoStep");
        assert!(less.check(LINUX).unwrap_err().to_string().contains("fmi2DoStep"));
    }

    #[test]
    fn what_is_no_library_or_only_its_beginning_is_refused() {
        let tool = crate::workspace::read(&std::env::current_exe().unwrap(), u64::MAX - 1).unwrap();
        let told = |bytes: &[u8]| format!("{:#}", Binary::parse(bytes).unwrap_err());
        assert_eq!(told(b"# ahv"), "this is not a shared library");
        assert!(told(&tool[..tool.len() / 2]).contains("library"));
    }
}
