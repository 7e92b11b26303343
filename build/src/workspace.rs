//! Locations of repository and build products; running Cargo.

mod files;

use anyhow::{Context, Result, bail};
pub use files::{
    Files, MAX_BINARY_BYTES, MAX_DATA_BYTES, MAX_TEXT_BYTES, can_write, read, read_text, write,
    write_together,
};
use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Name of the root package.
const PACKAGE: &str = "ahv-fmu";

/// The repository. It is searched for at run time, so that a copied or moved tree works on itself.
pub fn root() -> &'static Path {
    static ROOT: OnceLock<PathBuf> = OnceLock::new();
    ROOT.get_or_init(|| search(&places()).unwrap_or_default())
}

/// Fails if there is no repository to work on.
pub fn locate() -> Result<()> {
    if root().as_os_str().is_empty() {
        let places: Vec<_> = places().iter().map(|place| place.display().to_string()).collect();
        bail!("no sources of ahv at or above {}; run the command there", places.join(" or "));
    }
    Ok(())
}

/// An environment variable that no result depends on.
#[expect(clippy::disallowed_methods, reason = "the one place that reads it")]
pub fn variable(name: &str) -> Option<OsString> {
    env::var_os(name)
}

/// Where to search, in order: the manifest directory from Cargo, the location of the tool, which is outside
/// the repository if `CARGO_TARGET_DIR` is set, and the current directory.
fn places() -> Vec<PathBuf> {
    let cargo = variable("CARGO_MANIFEST_DIR").map(PathBuf::from);
    [cargo, env::current_exe().ok(), env::current_dir().ok()].into_iter().flatten().collect()
}

/// The nearest repository at or above the first place that has one.
fn search(places: &[PathBuf]) -> Option<PathBuf> {
    places
        .iter()
        .flat_map(|place| place.ancestors())
        .find(|place| is_root(place))
        .map(Path::to_path_buf)
}

fn is_root(directory: &Path) -> bool {
    let manifest = read_text(&directory.join("Cargo.toml"), MAX_DATA_BYTES);
    let table = manifest.ok().and_then(|text| text.parse::<toml::Table>().ok());
    let name = table.as_ref().and_then(|table| table.get("package")?.get("name")?.as_str());
    name == Some(PACKAGE)
}

/// Directory of build products.
pub fn target() -> PathBuf {
    target_by_environment().unwrap_or_else(|| root().join("target"))
}

/// `CARGO_TARGET_DIR`, relative to the current directory as in Cargo.
fn target_by_environment() -> Option<PathBuf> {
    let directory = variable("CARGO_TARGET_DIR")?;
    std::path::absolute(directory).ok()
}

/// The Cargo that runs this tool, to be started in the repository.
pub fn cargo() -> Command {
    let mut command = Command::new(variable("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    if let Some(target) = target_by_environment() {
        command.env("CARGO_TARGET_DIR", target);
    }
    command
}

/// A path for messages, relative to the current directory if it is below it.
pub fn shown(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path).display().to_string()
}

/// Runs a command; its failure is an error.
pub fn check(command: &mut Command) -> Result<()> {
    let program = command.get_program().to_string_lossy().into_owned();
    let first = command.get_args().next().unwrap_or_default().to_string_lossy().into_owned();
    let status = command.status().with_context(|| format!("cannot start {program}"))?;
    if !status.success() {
        bail!("{} {first}: {status}", shown(Path::new(&program)));
    }
    Ok(())
}

/// Whether a program with these arguments runs and succeeds.
pub fn works(program: &str, arguments: &[&str]) -> bool {
    Command::new(program).args(arguments).output().is_ok_and(|output| output.status.success())
}

#[cfg(test)]
mod tests;
