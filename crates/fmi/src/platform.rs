//! Platforms and their folder names in an FMU.
//!
//! FMI 2.0 has names for x86-64 only; for other processors the names of FMI 3.0 are used.

/// A platform of an FMU.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Folder below `binaries`.
    pub name: &'static str,
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
    name: "linux64",
    ending: "so",
    os: "linux",
    arch: "x86_64",
    triple: "x86_64-unknown-linux-gnu",
};
/// Windows on x86-64.
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
/// All platforms.
pub const PLATFORMS: [Platform; 6] = [
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

impl Platform {
    /// The platform with Rust's names of operating system and architecture.
    pub fn of(os: &str, arch: &str) -> Option<Self> {
        PLATFORMS.into_iter().find(|platform| (platform.os, platform.arch) == (os, arch))
    }

    /// Name of a model's library in an FMU.
    pub fn binary(self, identifier: &str) -> String {
        format!("binaries/{}/{identifier}.{}", self.name, self.ending)
    }
}
