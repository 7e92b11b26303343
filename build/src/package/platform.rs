//! The platforms that the tool builds for, and what users are told of them.

use super::binary::{GLIBC, Glibc};
use anyhow::{Context, Result, bail};
use fmi_model::platform::PLATFORMS;
pub use fmi_model::platform::{LINUX, LINUX_ARM, MACOS, MACOS_ARM, Platform, WINDOWS};
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
    let known = || PLATFORMS.map(|platform| platform.fmi2).join(", ");
    let Some((name, file)) = text.split_once('=') else {
        bail!("--library {text}: PLATFORM=FILE is expected; platforms are {}", known());
    };
    let named = |platform: &Platform| [platform.fmi2, platform.fmi3].contains(&name);
    let Some(platform) = PLATFORMS.into_iter().find(named) else {
        bail!("--library {text}: there is no platform `{name}`; platforms are {}", known());
    };
    Ok((platform, file.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fmi_model::standard::Standard;

    #[test]
    fn every_machine_has_the_name_of_what_it_is() {
        for (os, arch, fmi2, fmi3) in [
            ("linux", "x86_64", "linux64", "x86_64-linux"),
            ("linux", "aarch64", "aarch64-linux", "aarch64-linux"),
            ("windows", "x86_64", "win64", "x86_64-windows"),
            ("windows", "aarch64", "aarch64-windows", "aarch64-windows"),
            ("macos", "x86_64", "darwin64", "x86_64-darwin"),
            ("macos", "aarch64", "aarch64-darwin", "aarch64-darwin"),
        ] {
            let platform = Platform::of(os, arch).unwrap();
            let binary = |standard| platform.binary(standard, "a");
            let ending = platform.ending;
            assert_eq!(binary(Standard::Fmi2), format!("binaries/{fmi2}/a.{ending}"));
            assert_eq!(binary(Standard::Fmi3), format!("binaries/{fmi3}/a.{ending}"));
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
        for text in ["win64=a.dll", "x86_64-windows=a.dll"] {
            assert_eq!(parse_library_option(text).unwrap(), (WINDOWS, PathBuf::from("a.dll")));
        }
        let message = parse_library_option("win32=a.dll").unwrap_err().to_string();
        assert!(message.contains("`win32`") && message.contains("linux64, win64, darwin64"));
    }
}
