//! Collects the licences of everything in a library.

use crate::models::PackagedModel;
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

/// Licence files by name in the FMU: ours, those of every crate linked into the library or the WebAssembly component,
/// those of the interface of the latter, and those of the run-time libraries that compilers and linkers add.
pub fn collect(model: &PackagedModel) -> Result<BTreeMap<String, Vec<u8>>> {
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
    for (name, content) in in_directory(&root().join("crates/wasm/wit"))? {
        files.insert(format!("documentation/licenses/fmi-ls-wasm/{name}"), content);
    }
    for linked in linked_crates(model)? {
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

/// The crates linked into a library, without procedural macros, which run only at build time.
fn linked_crates(model: &PackagedModel) -> Result<Vec<Crate>> {
    let own = [model.cargo_package, "ahv-wasm"];
    let [library, component] = own.map(|package| format!("--package={package}"));
    let tree = cargo_output(&[
        "tree",
        &library,
        &component,
        "--edges=normal,no-proc-macro",
        "--target=all",
        "--prefix=none",
        "--format={p}",
    ])?;
    // Lines such as `libm v0.2.16`; that of the library also has a path.
    let linked: BTreeSet<_> = String::from_utf8_lossy(&tree)
        .lines()
        .filter_map(|line| line.split_once(" v"))
        .map(|(name, rest)| (name.to_string(), rest.split(' ').next().unwrap_or(rest).to_string()))
        .filter(|(name, _)| !own.contains(&name.as_str()))
        .collect();
    let metadata = cargo_output(&["metadata", "--format-version=1"])?;
    let Metadata { mut packages } =
        serde_json::from_slice(&metadata).context("cargo metadata cannot be read")?;
    packages.retain(|found| linked.contains(&(found.name.clone(), found.version.clone())));
    Ok(packages)
}

fn cargo_output(arguments: &[&str]) -> Result<Vec<u8>> {
    let output = cargo().args(arguments).arg("--quiet").output().context("cannot start cargo")?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        bail!("cargo {}: {}", arguments[0], message.trim());
    }
    Ok(output.stdout)
}
