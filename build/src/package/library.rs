//! Compiles the library for a platform.

use super::binary::GLIBC;
use super::platform::{LINUX, Platform, WINDOWS, host};
use super::windows::Toolchain;
use crate::describe::MODEL_IDENTIFIER;
use crate::python::{Environment, environment};
use crate::workspace::{cargo, root, target, variable};
use anyhow::{Context, Result, anyhow, bail};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Builds the library for this machine, which then needs its C library or a newer one.
pub fn for_host() -> Result<PathBuf> {
    let mut command = cargo();
    command.arg("rustc");
    compile(command, host()?, "host", Vec::new())
}

/// The linker of zig, which has the interfaces of all glibc versions.
pub fn zig() -> Result<Environment> {
    environment("zig", &root().join("build/zig/requirements.lock"))
}

/// Builds the library for Linux, linked against the interface of glibc 2.17.
pub fn for_linux(zig: &Environment) -> Result<PathBuf> {
    let caches = target().join("fmu/zig");
    let mut command = Command::new(zig.programs.join("cargo-zigbuild"));
    command
        .current_dir(root())
        .args(["rustc", "--target", &format!("{}.{}.{}", LINUX.triple, GLIBC.0, GLIBC.1)])
        .env("CARGO_ZIGBUILD_PYTHON_PATH", &zig.python)
        .env("CARGO_ZIGBUILD_CACHE_DIR", caches.join("zigbuild"))
        .env("ZIG_GLOBAL_CACHE_DIR", caches.join("global"))
        .env("ZIG_LOCAL_CACHE_DIR", caches.join("local"));
    compile(command, LINUX, LINUX.fmi2, Vec::new())
}

/// Builds the library for Windows.
pub fn for_windows(toolchain: Toolchain) -> Result<PathBuf> {
    let mut flags = vec!["-Clink-arg=-Wl,--no-insert-timestamp".into()];
    flags.extend(toolchain.std.map(|sources| remap(&sources, "rust")));
    compile(toolchain.command, WINDOWS, WINDOWS.fmi2, flags)
}

/// Compiles the library for a platform.
fn compile(
    command: Command,
    platform: Platform,
    directory: &str,
    flags: Vec<OsString>,
) -> Result<PathBuf> {
    compile_crate(command, "ahv-fmu", MODEL_IDENTIFIER, platform, directory, flags)
}

/// Runs `cargo rustc` with our options; returns the path of the library with this name of a package.
///
/// Each kind of build has its own target directory, because compilers and flags differ.
pub fn compile_crate(
    mut command: Command,
    package: &str,
    name: &str,
    platform: Platform,
    directory: &str,
    flags: Vec<OsString>,
) -> Result<PathBuf> {
    command
        // With the C interface only, link-time optimisation makes the library 4 % smaller.
        .args(["--release", "--package", package, "--lib", "--crate-type", "cdylib"])
        .args(["--config", "profile.release.lto='fat'"])
        .args(["--config", "profile.release.strip='symbols'"])
        .arg("--message-format=json-render-diagnostics")
        .arg("--target-dir")
        .arg(target().join("fmu").join(directory))
        .env("CARGO_ENCODED_RUSTFLAGS", rustflags(flags))
        .stderr(Stdio::inherit());
    let output = command
        .output()
        .with_context(|| format!("cannot start {}", command.get_program().display()))?;
    if !output.status.success() {
        bail!("the library for {} does not compile: see the messages above", platform.fmi2);
    }
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .filter(|message| message["reason"] == "compiler-artifact")
        .filter_map(|message| message["filenames"].as_array().cloned())
        .flatten()
        .filter_map(|file| file.as_str().map(PathBuf::from))
        .find(|file| {
            file.extension().is_some_and(|ending| ending == platform.ending)
                && file
                    .file_stem()
                    .is_some_and(|stem| stem.to_string_lossy().trim_start_matches("lib") == name)
        })
        .ok_or_else(|| anyhow!("cargo reported no path of the library {name}.{}", platform.ending))
}

/// Compiler flags: the user's, ours, and those that remove local directories from the source paths in panic
/// messages.
fn rustflags(ours: Vec<OsString>) -> OsString {
    let home = variable("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let mut prefixes =
        vec![(root().to_path_buf(), MODEL_IDENTIFIER), (target().join("fmu"), "target")];
    let registries = home.and_then(|home| fs::read_dir(home.join("registry/src")).ok());
    let directories = registries.into_iter().flatten().flatten();
    prefixes.extend(directories.map(|directory| (directory.path(), "crates")));
    // Where several prefixes match, the compiler takes the last.
    prefixes.sort();
    let user = variable("RUSTFLAGS").unwrap_or_default();
    let user = user.to_str().unwrap_or_default().split_whitespace().map(OsString::from);
    let remaps = prefixes.iter().map(|(path, name)| remap(path, name));
    let flags: Vec<_> = user.chain(ours).chain(remaps).collect();
    flags.join(OsStr::new("\x1f"))
}

pub fn remap(path: &Path, name: &str) -> OsString {
    let mut flag = OsString::from("--remap-path-prefix=");
    flag.push(path);
    flag.push(format!("={name}"));
    flag
}
