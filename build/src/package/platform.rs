//! The platforms that the tool builds for, and what users are told of them.

use super::binary::{GLIBC, Glibc};
use anyhow::{Context, Result, bail};
use fmi_model::platform::PLATFORMS;
pub use fmi_model::platform::{LINUX, Platform, WINDOWS};
use std::env::consts::{ARCH, OS};
use std::path::PathBuf;

/// The platform of this machine.
pub fn host() -> Result<Platform> {
    Platform::of(OS, ARCH).with_context(|| format!("FMI has no platform name for {OS} on {ARCH}"))
}

/// Description of the supported machines; `glibc` is the newest version that the library needs. Versions
/// below [`GLIBC`] are not promised.
pub fn machines(platform: Platform, glibc: Option<Glibc>) -> String {
    let system = match platform.os {
        "linux" => "Linux",
        "windows" => "Windows",
        _ => "macOS",
    };
    let processor = if platform.arch == "x86_64" { "x86-64" } else { "ARM64" };
    let with = glibc.map(|glibc| glibc.max(GLIBC));
    let with = with
        .map_or(String::new(), |(major, minor)| format!(" with glibc {major}.{minor} or newer"));
    format!("{system} ({processor}){with}")
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
            let platform = Platform::of(os, arch).unwrap();
            assert_eq!(platform.name, name);
            assert!(platform.triple.starts_with(arch));
        }
        assert_eq!(Platform::of("linux", "s390x"), None);
        let arm = Platform::of("linux", "aarch64").unwrap();
        assert_eq!(machines(arm, Some((2, 36))), "Linux (ARM64) with glibc 2.36 or newer");
        assert_eq!(arm.ending, "so");
    }

    #[test]
    fn readers_are_told_the_glibc_that_the_library_needs() {
        let told = |glibc| machines(LINUX, Some(glibc));
        assert_eq!(told((2, 36)), "Linux (x86-64) with glibc 2.36 or newer");
        assert_eq!(told((2, 14)), told(GLIBC));
        assert!(!machines(WINDOWS, None).contains("glibc"));
    }

    #[test]
    fn library_options_name_the_platform() {
        assert_eq!(parse_library_option("win64=a.dll").unwrap(), (WINDOWS, PathBuf::from("a.dll")));
        let message = parse_library_option("win32=a.dll").unwrap_err().to_string();
        assert!(message.contains("`win32`") && message.contains("linux64, win64, darwin64"));
    }
}
