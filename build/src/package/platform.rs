//! Platforms and their folder names in an FMU.
//!
//! FMI 2.0 has names for x86-64 only; for other processors the names of FMI 3.0 are used.

use super::binary::{GLIBC, Glibc};
use anyhow::{Context, Result, bail};
use std::env::consts::{ARCH, OS};
use std::path::PathBuf;

/// A platform of an FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Folder below `binaries`.
    pub name: &'static str,
    /// File extension of a library.
    pub ending: &'static str,
    /// Rust's names of operating system, architecture and target.
    pub os: &'static str,
    pub arch: &'static str,
    pub triple: &'static str,
}

pub const LINUX: Platform = Platform {
    name: "linux64",
    ending: "so",
    os: "linux",
    arch: "x86_64",
    triple: "x86_64-unknown-linux-gnu",
};
pub const WINDOWS: Platform = Platform {
    name: "win64",
    ending: "dll",
    os: "windows",
    arch: "x86_64",
    triple: "x86_64-pc-windows-gnu",
};
const MACOS: Platform = Platform {
    name: "darwin64",
    ending: "dylib",
    os: "macos",
    arch: "x86_64",
    triple: "x86_64-apple-darwin",
};
const PLATFORMS: [Platform; 6] = [
    LINUX,
    WINDOWS,
    MACOS,
    Platform {
        name: "aarch64-linux",
        arch: "aarch64",
        triple: "aarch64-unknown-linux-gnu",
        ..LINUX
    },
    Platform {
        name: "aarch64-windows",
        arch: "aarch64",
        triple: "aarch64-pc-windows-msvc",
        ..WINDOWS
    },
    Platform { name: "aarch64-darwin", arch: "aarch64", triple: "aarch64-apple-darwin", ..MACOS },
];

/// The platform of this machine.
pub fn host() -> Result<Platform> {
    of(OS, ARCH).with_context(|| format!("FMI has no platform name for {OS} on {ARCH}"))
}

/// The platform with Rust's names of operating system and architecture.
fn of(os: &str, arch: &str) -> Option<Platform> {
    PLATFORMS.into_iter().find(|platform| (platform.os, platform.arch) == (os, arch))
}

impl Platform {
    /// Description of the supported machines; `glibc` is the newest version that the library needs. Versions
    /// below [`GLIBC`] are not promised.
    pub fn machines(self, glibc: Option<Glibc>) -> String {
        let system = match self.os {
            "linux" => "Linux",
            "windows" => "Windows",
            _ => "macOS",
        };
        let processor = if self.arch == "x86_64" { "x86-64" } else { "ARM64" };
        let with = glibc.map(|glibc| glibc.max(GLIBC));
        let with = with.map_or(String::new(), |(major, minor)| {
            format!(" with glibc {major}.{minor} or newer")
        });
        format!("{system} ({processor}){with}")
    }
}

/// Parses a `--library` option, `platform=file`.
pub fn parse_library_option(text: &str) -> Result<(Platform, PathBuf)> {
    let known = || PLATFORMS.map(|platform| platform.name).join(", ");
    let Some((name, file)) = text.split_once('=') else {
        bail!("--library {text}: PLATFORM=FILE is expected; platforms are {}", known());
    };
    let Some(platform) = PLATFORMS.into_iter().find(|platform| platform.name == name) else {
        bail!("--library {text}: there is no platform `{name}`; platforms are {}", known());
    };
    Ok((platform, file.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_machine_has_the_name_of_what_it_is() {
        for (os, arch, name) in [
            ("linux", "x86_64", "linux64"),
            ("linux", "aarch64", "aarch64-linux"),
            ("windows", "x86_64", "win64"),
            ("windows", "aarch64", "aarch64-windows"),
            ("macos", "x86_64", "darwin64"),
            ("macos", "aarch64", "aarch64-darwin"),
        ] {
            let platform = of(os, arch).unwrap();
            assert_eq!(platform.name, name);
            assert!(platform.triple.starts_with(arch));
        }
        assert_eq!(of("linux", "s390x"), None);
        let arm = of("linux", "aarch64").unwrap();
        assert_eq!(arm.machines(Some((2, 36))), "Linux (ARM64) with glibc 2.36 or newer");
        assert_eq!(arm.ending, "so");
    }

    #[test]
    fn readers_are_told_the_glibc_that_the_library_needs() {
        let told = |glibc| LINUX.machines(Some(glibc));
        assert_eq!(told((2, 36)), "Linux (x86-64) with glibc 2.36 or newer");
        assert_eq!(told((2, 14)), told(GLIBC));
        assert!(!WINDOWS.machines(None).contains("glibc"));
    }

    #[test]
    fn library_options_name_the_platform() {
        assert_eq!(parse_library_option("win64=a.dll").unwrap(), (WINDOWS, PathBuf::from("a.dll")));
        let message = parse_library_option("win32=a.dll").unwrap_err().to_string();
        assert!(message.contains("`win32`") && message.contains("linux64, win64, darwin64"));
    }
}
