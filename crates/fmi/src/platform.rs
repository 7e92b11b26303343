//! Platforms and their folder names in an FMU.
//!
//! FMI 2.0 names x86-64 only, and refers to the tuples of FMI 3.0 for other processors. UniFMU, FMIImport.jl
//! and fmi-rs follow it; FMPy looks for ARM in `linux64` and `darwin64`. There a library for Linux can serve
//! one processor only, so the names are those of the standard.

use crate::standard::Standard;

/// A platform of an FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Folder below `binaries` in FMI 2.0.
    pub fmi2: &'static str,
    /// Folder below `binaries` in FMI 3.0, a platform tuple.
    pub fmi3: &'static str,
    /// File extension of a library.
    pub ending: &'static str,
    /// Operating system, as Rust names it.
    pub os: &'static str,
    /// Architecture, as Rust names it.
    pub arch: &'static str,
    /// Target, as Rust names it.
    pub triple: &'static str,
}

/// Linux on x86-64.
pub const LINUX: Platform = Platform {
    fmi2: "linux64",
    fmi3: "x86_64-linux",
    ending: "so",
    os: "linux",
    arch: "x86_64",
    triple: "x86_64-unknown-linux-gnu",
};
/// Windows on x86-64.
pub const WINDOWS: Platform = Platform {
    fmi2: "win64",
    fmi3: "x86_64-windows",
    ending: "dll",
    os: "windows",
    arch: "x86_64",
    triple: "x86_64-pc-windows-gnu",
};
/// macOS on x86-64.
pub const MACOS: Platform = Platform {
    fmi2: "darwin64",
    fmi3: "x86_64-darwin",
    ending: "dylib",
    os: "macos",
    arch: "x86_64",
    triple: "x86_64-apple-darwin",
};
/// Linux on ARM64.
pub const LINUX_ARM: Platform = Platform {
    fmi2: "aarch64-linux",
    fmi3: "aarch64-linux",
    arch: "aarch64",
    triple: "aarch64-unknown-linux-gnu",
    ..LINUX
};
/// macOS on ARM64.
pub const MACOS_ARM: Platform = Platform {
    fmi2: "aarch64-darwin",
    fmi3: "aarch64-darwin",
    arch: "aarch64",
    triple: "aarch64-apple-darwin",
    ..MACOS
};
/// All platforms.
pub const PLATFORMS: [Platform; 6] = [
    LINUX,
    WINDOWS,
    MACOS,
    LINUX_ARM,
    Platform {
        fmi2: "aarch64-windows",
        fmi3: "aarch64-windows",
        arch: "aarch64",
        triple: "aarch64-pc-windows-msvc",
        ..WINDOWS
    },
    MACOS_ARM,
];

impl Platform {
    /// The platform with Rust's names of operating system and architecture.
    pub fn of(os: &str, arch: &str) -> Option<Self> {
        PLATFORMS.into_iter().find(|platform| (platform.os, platform.arch) == (os, arch))
    }

    /// Folder below `binaries`.
    pub fn folder(self, standard: Standard) -> &'static str {
        match standard {
            Standard::Fmi2 => self.fmi2,
            Standard::Fmi3 => self.fmi3,
        }
    }

    /// Name of a model's library in an FMU.
    pub fn binary(self, standard: Standard, identifier: &str) -> String {
        format!("binaries/{}/{identifier}.{}", self.folder(standard), self.ending)
    }
}
