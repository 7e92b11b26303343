//! The linker for macOS: LLVM's lld, with the interface of the system library that zig brings.
//!
//! The linker of zig itself exports more than the functions of the standard.

use super::toolchain::output_of;
use crate::python::Environment;
use crate::workspace::{MAX_BINARY_BYTES, read_text, target, variable, write};
use anyhow::{Context, Result, anyhow};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest macOS that the libraries run on: the first for ARM.
pub const OLDEST: (u16, u8) = (11, 0);

/// The name by which a model's library knows itself.
pub fn install_name(identifier: &str) -> String {
    format!("@rpath/{identifier}.dylib")
}

/// Flags of the compiler.
pub fn flags(linker: &Path) -> [OsString; 2] {
    let mut path = OsString::from("-Clinker=");
    path.push(linker);
    ["-Clinker-flavor=ld64.lld".into(), path]
}

/// Flags that give a model's library its name.
pub fn name_flags(identifier: &str) -> Vec<OsString> {
    let name = format!("-Clink-arg={}", install_name(identifier));
    vec!["-Clink-arg=-install_name".into(), name.into()]
}

/// Environment of the compiler.
pub fn configure(command: &mut Command, zig: &Environment) -> Result<()> {
    command
        .env("MACOSX_DEPLOYMENT_TARGET", format!("{}.{}", OLDEST.0, OLDEST.1))
        .env("SDKROOT", sdk(zig)?);
    Ok(())
}

/// lld: that of rustup's compiler or an installed one.
pub fn linker() -> Result<PathBuf> {
    let rustc = PathBuf::from(variable("RUSTC").unwrap_or_else(|| "rustc".into()));
    let host = format!("lib/rustlib/{}/bin/rust-lld", super::platform::LINUX.triple);
    let own = output_of(&rustc, &["--print", "sysroot"]).map(|root| Path::new(&root).join(host));
    own.into_iter()
        .chain([PathBuf::from("lld")])
        .find(|lld| output_of(lld, &["-flavor", "darwin", "--version"]).is_some())
        .ok_or_else(|| anyhow!("the linker lld is missing; on Debian: apt-get install lld"))
}

/// A directory like an SDK with the parts of the system library that the standard library asks for.
fn sdk(zig: &Environment) -> Result<PathBuf> {
    let find = "import ziglang, pathlib; print(pathlib.Path(ziglang.__file__).parent)";
    let package = output_of(&zig.python, &["-c", find]).context("zig cannot be found")?;
    let file = Path::new(&package).join("lib/libc/darwin/libSystem.tbd");
    // Older versions of lld do not know the newest processors, whose interface is the same.
    let interface = read_text(&file, MAX_BINARY_BYTES)?.replace("arm64e.x1-", "arm64-");
    let root = target().join("fmu/macos");
    for name in ["libSystem", "libc", "libm"] {
        write(&root.join(format!("usr/lib/{name}.tbd")), interface.as_bytes())?;
    }
    Ok(root)
}
