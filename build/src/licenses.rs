//! The licences of everything that is inside the library.

use crate::workspace::{MAX_TEXT_BYTES, cargo, read, root};
use anyhow::{Context, Result, bail};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Crate>,
}

#[derive(Deserialize)]
struct Crate {
    name: String,
    version: String,
    manifest_path: PathBuf,
}

/// Licence files by their name in the FMU: our own, those of every crate that is linked in, and
/// those of the runtimes that compilers and linkers add.
pub fn collect() -> Result<BTreeMap<String, Vec<u8>>> {
    let mut files = BTreeMap::new();
    for (name, content) in in_directory(root())? {
        files.insert(format!("documentation/licenses/{name}"), content);
    }
    let runtimes = root().join("build/licenses");
    let entries = fs::read_dir(&runtimes).with_context(|| format!("{}", runtimes.display()))?;
    for entry in entries {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        files.insert(
            format!("documentation/licenses/runtime/{name}"),
            read(&entry.path(), MAX_TEXT_BYTES)?,
        );
    }
    for linked in linked_crates()? {
        let Some(directory) = linked.manifest_path.parent() else { continue };
        for (name, content) in in_directory(directory)? {
            let Crate { name: of, version, .. } = &linked;
            files.insert(format!("documentation/licenses/{of}-{version}/{name}"), content);
        }
    }
    Ok(files)
}

/// Files of a directory that look like a licence.
fn in_directory(directory: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let mut found = Vec::new();
    let entries = fs::read_dir(directory).with_context(|| format!("{}", directory.display()))?;
    for entry in entries {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let upper = name.to_uppercase();
        let wanted = ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"]
            .iter()
            .any(|start| upper.starts_with(start));
        if wanted && entry.path().is_file() {
            found.push((name, read(&entry.path(), MAX_TEXT_BYTES)?));
        }
    }
    Ok(found)
}

/// The crates that the library is linked from, without itself. Macros run at build time and leave
/// nothing behind.
fn linked_crates() -> Result<Vec<Crate>> {
    let tree = ask_cargo(&[
        "tree",
        "--package=ahv-fmu",
        "--edges=normal,no-proc-macro",
        "--prefix=none",
        "--format={p}",
    ])?;
    // A line is like `libm v0.2.16`; the library itself has its path behind that.
    let linked: BTreeSet<_> = String::from_utf8_lossy(&tree)
        .lines()
        .filter_map(|line| line.split_once(" v"))
        .map(|(name, rest)| (name.to_string(), rest.split(' ').next().unwrap_or(rest).to_string()))
        .filter(|(name, _)| name != "ahv-fmu")
        .collect();
    let metadata = ask_cargo(&["metadata", "--format-version=1"])?;
    let Metadata { mut packages } =
        serde_json::from_slice(&metadata).context("cargo metadata cannot be read")?;
    packages.retain(|found| linked.contains(&(found.name.clone(), found.version.clone())));
    Ok(packages)
}

fn ask_cargo(arguments: &[&str]) -> Result<Vec<u8>> {
    let output = cargo().args(arguments).arg("--quiet").output().context("cannot start cargo")?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        bail!("cargo {}: {}", arguments[0], message.trim());
    }
    Ok(output.stdout)
}
