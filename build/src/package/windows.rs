//! Selects the compiler of the Windows library.

use super::platform::WINDOWS;
use crate::workspace::{cargo, root, target, variable};
use anyhow::{Result, anyhow, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Linker for Windows, from MinGW-w64.
const LINKER: &str = "x86_64-w64-mingw32-gcc";

const HOW_TO_GET: &str = "on Debian: apt-get install gcc-mingw-w64-x86-64 rustc-web cargo-web \
                          rust-web-src; with rustup: rustup target add x86_64-pc-windows-gnu, and \
                          a MinGW-w64 linker";

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";

/// A Cargo that can build for Windows, up to its subcommand's options.
pub struct Toolchain {
    pub command: Command,
    /// Sources of the standard library, if it has to be compiled.
    pub std: Option<PathBuf>,
}

/// The Cargo that runs this tool if it has the Windows target, otherwise Debian's with the sources of the
/// standard library.
pub fn toolchain() -> Result<Toolchain> {
    let missing = |what: &str| anyhow!("without win64: {what}; {HOW_TO_GET}");
    if output_of(Path::new(LINKER), &["--version"]).is_none() {
        return Err(missing(&format!("the linker {LINKER} is missing")));
    }
    let own = PathBuf::from(variable("RUSTC").unwrap_or_else(|| "rustc".into()));
    let (mut command, std) = if has_target(&own, WINDOWS.triple) {
        let mut command = cargo();
        command.arg("rustc");
        (command, None)
    } else {
        let std = debian().map_err(|error| missing(&format!("{error:#}")))?;
        (debian_cargo("std,panic_unwind"), Some(std))
    };
    command
        .args(["--target", WINDOWS.triple])
        .env(
            "CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER",
            root().join("build/windows/relative-gcc.sh"),
        )
        .env("AHV_TARGET", target());
    Ok(Toolchain { command, std })
}

/// The sources of the standard library of Debian's compiler.
pub(super) fn debian() -> Result<PathBuf> {
    let rustc = Path::new(DEBIAN_RUSTC);
    let exists = Path::new(DEBIAN_CARGO).exists();
    let Some(version) = output_of(rustc, &["--version"]).filter(|_| exists) else {
        bail!("no installed compiler has the target");
    };
    let wanted = env!("CARGO_PKG_RUST_VERSION");
    let minor = |text: &str| text.split('.').nth(1).and_then(|minor| minor.parse::<u32>().ok());
    if minor(&version) < minor(wanted) {
        bail!("{version} is older than {wanted}");
    }
    let sysroot = output_of(rustc, &["--print", "sysroot"]).unwrap_or_default();
    let std = Path::new(&sysroot).join("lib/rustlib/src/rust");
    if !std.join("library/std").exists() {
        bail!("the sources of the standard library of {version} are missing");
    }
    Ok(std)
}

/// `cargo rustc` of Debian's Cargo, which compiles these parts of the standard library too.
pub(super) fn debian_cargo(parts: &str) -> Command {
    let mut command = Command::new(DEBIAN_CARGO);
    command
        .current_dir(root())
        .args(["rustc", &format!("-Zbuild-std={parts}")])
        .env("RUSTC", DEBIAN_RUSTC)
        // Allows -Z with a stable compiler.
        .env("RUSTC_BOOTSTRAP", "1")
        // Set by rustup for the libraries of the other toolchain.
        .env_remove("LD_LIBRARY_PATH");
    command
}

pub(super) fn has_target(rustc: &Path, triple: &str) -> bool {
    output_of(rustc, &["--target", triple, "--print", "target-libdir"])
        .is_some_and(|directory| Path::new(&directory).exists())
}

/// Standard output of a program, if it exists and succeeds.
pub(super) fn output_of(program: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_string();
    output.status.success().then_some(text)
}
