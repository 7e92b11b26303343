//! Node packages with exactly the versions of a lock file.

use crate::workspace::{MAX_TEXT_BYTES, check, read, shown, write};
use anyhow::{Context, Result, bail};
use std::path::Path;
use std::process::Command;

/// The oldest major version that the build of the page runs on.
const OLDEST: u32 = 20;
const MANIFESTS: [&str; 2] = ["package.json", "package-lock.json"];

/// Installs the packages of `sources` into `directory`, if they are missing or out of date. Programs below it
/// find them.
pub fn install(sources: &Path, directory: &Path) -> Result<()> {
    available()?;
    let [_, lock] = MANIFESTS;
    let wanted = read(&sources.join(lock), MAX_TEXT_BYTES)?;
    // npm writes its own copy; ours, written last, marks a complete installation.
    let stamp = directory.join("installed.json");
    if stamp.exists() && read(&stamp, MAX_TEXT_BYTES)? == wanted {
        return Ok(());
    }
    errln!("installing the packages of {} into {}", shown(&sources.join(lock)), shown(directory));
    for name in MANIFESTS {
        write(&directory.join(name), read(&sources.join(name), MAX_TEXT_BYTES)?)?;
    }
    check(
        Command::new("npm")
            .args(["ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"])
            .current_dir(directory),
    )
    .with_context(|| format!("cannot install the packages of {}", shown(&sources.join(lock))))?;
    write(&stamp, wanted)
}

/// Checks for the programs, and names the Debian packages of missing ones.
fn available() -> Result<()> {
    let output = Command::new("node").arg("--version").output();
    let version = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_string());
    match version.ok().and_then(|version| Some((major(&version)?, version))) {
        None => bail!("node is missing; on Debian: apt-get install nodejs npm"),
        Some((found, version)) if found < OLDEST => {
            bail!("node {version} is too old: {OLDEST} or newer is needed")
        }
        Some(_) => {}
    }
    if Command::new("npm").arg("--version").output().is_err() {
        bail!("npm is missing; on Debian: apt-get install npm");
    }
    Ok(())
}

/// Of `v20.19.2`.
fn major(version: &str) -> Option<u32> {
    version.strip_prefix('v')?.split('.').next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_of_node_are_read() {
        assert_eq!(major("v20.19.2"), Some(20));
        assert_eq!(major("v9.0.0"), Some(9));
        assert_eq!(major("unknown"), None);
    }
}
