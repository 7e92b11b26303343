//! Compiles the library for a platform.

use super::binary::GLIBC;
use super::macos;
use super::platform::{LINUX, LINUX_ARM, Platform, WINDOWS, host};
use super::toolchain::{Toolchain, output_of};
use crate::models::{PackagedModel, VEHICLE};
use crate::python::{Environment, environment};
use crate::workspace::{cargo, root, target, variable};
use anyhow::{Context, Result, anyhow, bail};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Linker for Windows, from MinGW-w64.
const MINGW: &str = "x86_64-w64-mingw32-gcc";

/// Builds the library for this machine, which then needs its C library or a newer one.
pub fn for_host(model: &PackagedModel) -> Result<PathBuf> {
    let mut command = cargo();
    command.arg("rustc");
    compile(command, &Product::library(model), host()?, "host", Flags::default())
}

/// The linker of zig, which has the interfaces of all glibc versions and of macOS.
pub fn zig() -> Result<Environment> {
    environment("zig", &root().join("build/zig/requirements.lock"))
}

/// Builds the library for Linux on this processor, linked against the interface of glibc 2.17.
pub fn for_linux(zig: &Environment, model: &PackagedModel) -> Result<PathBuf> {
    let command = with_zig(zig, &Toolchain::OWN, LINUX, "rustc");
    compile(command, &Product::library(model), LINUX, LINUX.fmi2, Flags::default())
}

/// What builds the library for another platform.
pub struct Builder<'zig> {
    platform: Platform,
    toolchain: Toolchain,
    linker: Linker<'zig>,
}

enum Linker<'zig> {
    Mingw,
    Zig(&'zig Environment),
    Lld(&'zig Environment, PathBuf),
}

/// What builds the library for another platform, or what is missing for it.
pub fn builder(platform: Platform, zig: Option<&Environment>) -> Result<Builder<'_>> {
    let zig = zig.context("the linker of zig is missing");
    let linker = match platform.os {
        "windows" => {
            if output_of(Path::new(MINGW), &["--version"]).is_none() {
                bail!(
                    "the linker {MINGW} is missing; on Debian: apt-get install gcc-mingw-w64-x86-64"
                );
            }
            Linker::Mingw
        }
        "macos" => Linker::Lld(zig?, macos::linker()?),
        _ => Linker::Zig(zig?),
    };
    Ok(Builder { platform, toolchain: Toolchain::new(platform)?, linker })
}

impl Builder<'_> {
    /// Builds the library.
    pub fn build(&self, model: &PackagedModel) -> Result<PathBuf> {
        let (platform, toolchain) = (self.platform, &self.toolchain);
        let mut flags = Flags::default();
        let command = match &self.linker {
            Linker::Zig(zig) => with_zig(zig, toolchain, platform, "rustc"),
            Linker::Mingw => {
                flags.all.push("-Clink-arg=-Wl,--no-insert-timestamp".into());
                with_mingw(toolchain)
            }
            Linker::Lld(zig, linker) => {
                flags.all.extend(macos::flags(linker));
                flags.product = macos::name_flags(model.identifier);
                let mut command = toolchain.cargo();
                command.args(["--target", platform.triple]);
                macos::configure(&mut command, zig)?;
                command
            }
        };
        flags.all.extend(self.std_remap());
        compile(command, &Product::library(model), platform, toolchain.directory(), flags)
    }

    fn std_remap(&self) -> Option<OsString> {
        self.toolchain.std.as_ref().map(|sources| remap(sources, "rust"))
    }
}

/// The test of the panic guard on Linux on ARM, run by `emulator`.
pub fn guard_on_arm(emulator: &str) -> Result<Command> {
    let zig = zig()?;
    let builder = builder(LINUX_ARM, Some(&zig))?;
    let mut command = with_zig(&zig, &builder.toolchain, LINUX_ARM, "test");
    command
        .args(["--release", "--package", "fmi-model", "--test", "guard"])
        .args(profile(LINUX_ARM))
        .arg("--target-dir")
        .arg(target().join("fmu").join(builder.toolchain.directory()))
        .env("CARGO_ENCODED_RUSTFLAGS", rustflags(builder.std_remap().into_iter().collect()))
        .env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER", emulator);
    Ok(command)
}

fn with_mingw(toolchain: &Toolchain) -> Command {
    let mut command = toolchain.cargo();
    let linker = root().join("build/windows/relative-gcc.sh");
    command
        .args(["--target", WINDOWS.triple])
        .env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", linker)
        .env("AHV_TARGET", target());
    command
}

fn with_zig(
    zig: &Environment,
    toolchain: &Toolchain,
    platform: Platform,
    subcommand: &str,
) -> Command {
    let caches = target().join("fmu/zig");
    let mut command =
        toolchain.subcommand(Command::new(zig.programs.join("cargo-zigbuild")), subcommand);
    let triple = match platform.os {
        "linux" => format!("{}.{}.{}", platform.triple, GLIBC.0, GLIBC.1),
        _ => platform.triple.to_string(),
    };
    command
        .args(["--target", &triple])
        .env("CARGO_ZIGBUILD_PYTHON_PATH", &zig.python)
        .env("CARGO_ZIGBUILD_CACHE_DIR", caches.join("zigbuild"))
        .env("ZIG_GLOBAL_CACHE_DIR", caches.join("global"))
        .env("ZIG_LOCAL_CACHE_DIR", caches.join("local"));
    command
}

/// What Cargo makes: a package's library or example of this name, also a library.
pub struct Product<'a> {
    pub package: &'a str,
    pub is_example: bool,
    pub name: &'a str,
}

impl<'a> Product<'a> {
    fn library(model: &'a PackagedModel) -> Self {
        Self { package: model.cargo_package, is_example: false, name: model.identifier }
    }
}

/// Flags of the compiler.
#[derive(Default)]
pub struct Flags {
    /// For every crate. Models that share dependencies have the same ones, or these are compiled for each.
    pub all: Vec<OsString>,
    /// For the library itself.
    pub product: Vec<OsString>,
}

/// Runs `cargo rustc` with our options; returns the path of the library.
///
/// Each kind of build has its own target directory, because compilers and flags differ.
pub fn compile(
    mut command: Command,
    product: &Product,
    platform: Platform,
    directory: &str,
    flags: Flags,
) -> Result<PathBuf> {
    let Product { package, is_example, name } = *product;
    let selected: &[_] = if is_example { &["--example", name] } else { &["--lib"] };
    command
        .args(["--release", "--package", package, "--crate-type", "cdylib"])
        .args(selected)
        .args(profile(platform))
        .arg("--message-format=json-render-diagnostics")
        .arg("--target-dir")
        .arg(target().join("fmu").join(directory))
        .env("CARGO_ENCODED_RUSTFLAGS", rustflags(flags.all))
        .arg("--")
        .args(flags.product)
        .stderr(Stdio::inherit());
    let output = command
        .output()
        .with_context(|| format!("cannot start {}", command.get_program().display()))?;
    if !output.status.success() {
        bail!("{name} for {} does not compile: see the messages above", platform.fmi2);
    }
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .filter(|message| message["reason"] == "compiler-artifact")
        // A dependency may have the same name.
        .filter(|message| (message["target"]["kind"][0] == "example") == is_example)
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

/// Options of the release profile. With the C interface only, link-time optimisation makes the library 4 % smaller.
fn profile(platform: Platform) -> [&'static str; 4] {
    // Stripping for macOS needs a tool of LLVM and invalidates the signature.
    let strip = match platform.os {
        "macos" => "profile.release.strip='none'",
        _ => "profile.release.strip='symbols'",
    };
    ["--config", "profile.release.lto='fat'", "--config", strip]
}

/// Compiler flags: the user's, ours, and those that remove local directories from the source paths in panic
/// messages.
fn rustflags(ours: Vec<OsString>) -> OsString {
    let home = variable("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let mut prefixes =
        vec![(root().to_path_buf(), VEHICLE.identifier), (target().join("fmu"), "target")];
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
