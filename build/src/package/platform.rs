//! Platforms by their names in an FMU.

use super::binary::{GLIBC, Glibc};
use anyhow::{Result, bail};
use std::path::PathBuf;

/// A platform that FMI 2.0 knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Folder below `binaries`.
    pub name: &'static str,
    /// Ending of a library.
    pub ending: &'static str,
    /// Rust's name of it.
    pub triple: &'static str,
}

pub const LINUX: Platform =
    Platform { name: "linux64", ending: "so", triple: "x86_64-unknown-linux-gnu" };
pub const WINDOWS: Platform =
    Platform { name: "win64", ending: "dll", triple: "x86_64-pc-windows-gnu" };
const MACOS: Platform =
    Platform { name: "darwin64", ending: "dylib", triple: "x86_64-apple-darwin" };

const PLATFORMS: [Platform; 3] = [LINUX, WINDOWS, MACOS];

/// The platform of this machine.
pub const HOST: Platform = if cfg!(windows) {
    WINDOWS
} else if cfg!(target_os = "macos") {
    MACOS
} else {
    LINUX
};

impl Platform {
    /// The machines that it serves, for readers; `glibc`: the newest that the library asks for.
    /// Less than what every build is allowed to ask for is not promised.
    pub fn machines(self, glibc: Option<Glibc>) -> String {
        match (self, glibc) {
            (LINUX, Some(glibc)) => {
                let (major, minor) = glibc.max(GLIBC);
                format!("Linux (x86-64) with glibc {major}.{minor} or newer")
            }
            (LINUX, None) => "Linux (x86-64)".to_string(),
            (WINDOWS, _) => "Windows (x86-64)".to_string(),
            _ => format!("machines like {}", self.triple),
        }
    }
}

/// A library given as `platform=file`.
pub fn given(text: &str) -> Result<(Platform, PathBuf)> {
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
    fn readers_are_told_the_glibc_that_the_library_needs() {
        let told = |glibc| LINUX.machines(Some(glibc));
        assert_eq!(told((2, 36)), "Linux (x86-64) with glibc 2.36 or newer");
        assert_eq!(told((2, 14)), told(GLIBC));
        assert!(!WINDOWS.machines(None).contains("glibc"));
    }

    #[test]
    fn library_options_name_the_platform() {
        assert_eq!(given("win64=a.dll").unwrap(), (WINDOWS, PathBuf::from("a.dll")));
        let message = given("win32=a.dll").unwrap_err().to_string();
        assert!(message.contains("`win32`") && message.contains("linux64, win64, darwin64"));
    }
}
