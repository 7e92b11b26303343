//! Selects the Cargo that builds the library for another platform.

use super::platform::Platform;
use crate::workspace::{cargo, root, variable};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// How to get a compiler for every platform.
const HOW_TO_GET: &str = "on Debian: apt-get install rustc-web cargo-web rust-web-src; with rustup: \
                          rustup target add x86_64-pc-windows-gnu aarch64-unknown-linux-gnu \
                          x86_64-apple-darwin aarch64-apple-darwin wasm32-unknown-unknown";

const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";

/// A Cargo that can build for a platform: the one that runs this tool if it has the target, otherwise
/// Debian's with the sources of the standard library.
pub struct Toolchain {
    /// Sources of the standard library, if it has to be compiled.
    pub std: Option<PathBuf>,
    /// What a panic does.
    panic: &'static str,
}

impl Toolchain {
    /// The Cargo that runs this tool.
    pub const OWN: Self = Self { std: None, panic: "unwind" };

    pub fn new(platform: Platform) -> Result<Self> {
        let own = PathBuf::from(variable("RUSTC").unwrap_or_else(|| "rustc".into()));
        let std = if has_target(&own, platform) { None } else { Some(debian()?) };
        // WebAssembly cannot unwind.
        let panic = if platform.arch == "wasm32" { "abort" } else { "unwind" };
        Ok(Self { std, panic })
    }

    /// `cargo rustc`, up to its options.
    pub fn cargo(&self) -> Command {
        let cargo = match self.std {
            None => cargo(),
            Some(_) => Command::new(DEBIAN_CARGO),
        };
        self.subcommand(cargo, "rustc")
    }

    /// A subcommand of Cargo or of a program that is called like it.
    pub fn subcommand(&self, mut command: Command, name: &str) -> Command {
        command.current_dir(root()).arg(name);
        if self.std.is_some() {
            let test = if name == "test" { ",test" } else { "" };
            command
                .arg(format!("-Zbuild-std=std,panic_{}{test}", self.panic))
                .env("CARGO", DEBIAN_CARGO)
                .env("RUSTC", DEBIAN_RUSTC)
                // Allows -Z with a stable compiler.
                .env("RUSTC_BOOTSTRAP", "1")
                // Set by rustup for the libraries of the other toolchain.
                .env_remove("LD_LIBRARY_PATH");
        }
        command
    }

    /// Directory of its products, which those of another compiler would replace.
    pub fn directory(&self) -> &'static str {
        if self.std.is_some() { "debian" } else { "cross" }
    }
}

/// The sources of the standard library of Debian's compiler.
fn debian() -> Result<PathBuf> {
    let rustc = Path::new(DEBIAN_RUSTC);
    let exists = Path::new(DEBIAN_CARGO).exists();
    let Some(version) = output_of(rustc, &["--version"]).filter(|_| exists) else {
        bail!("no installed compiler has the target; {HOW_TO_GET}");
    };
    let wanted = env!("CARGO_PKG_RUST_VERSION");
    let minor = |text: &str| text.split('.').nth(1).and_then(|minor| minor.parse::<u32>().ok());
    if minor(&version) < minor(wanted) {
        bail!("{version} is older than {wanted}; {HOW_TO_GET}");
    }
    let sysroot = output_of(rustc, &["--print", "sysroot"]).unwrap_or_default();
    let std = Path::new(&sysroot).join("lib/rustlib/src/rust");
    if !std.join("library/std").exists() {
        bail!("the sources of the standard library of {version} are missing; {HOW_TO_GET}");
    }
    Ok(std)
}

fn has_target(rustc: &Path, platform: Platform) -> bool {
    output_of(rustc, &["--target", platform.triple, "--print", "target-libdir"])
        .is_some_and(|directory| Path::new(&directory).exists())
}

/// Standard output of a program, if it exists and succeeds.
pub fn output_of(program: &Path, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_string();
    output.status.success().then_some(text)
}
