//! The licences of everything that is inside the library.

use crate::workspace::{cargo, read, root};
use anyhow::{Context, Result, bail};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Crate>,
    resolve: Resolve,
}

#[derive(Deserialize)]
struct Crate {
    id: String,
    name: String,
    version: String,
    manifest_path: PathBuf,
    targets: Vec<Target>,
}

#[derive(Deserialize)]
struct Target {
    kind: Vec<String>,
}

#[derive(Deserialize)]
struct Resolve {
    nodes: Vec<Node>,
}

#[derive(Deserialize)]
struct Node {
    id: String,
    deps: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    pkg: String,
    dep_kinds: Vec<DependencyKind>,
}

#[derive(Deserialize)]
struct DependencyKind {
    kind: Option<String>,
}

/// Licence files by their name in the FMU: our own, and those of every crate that is linked in.
pub fn collect() -> Result<BTreeMap<String, Vec<u8>>> {
    let mut files = BTreeMap::new();
    for (name, content) in in_directory(root())? {
        files.insert(format!("documentation/licenses/{name}"), content);
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
            found.push((name, read(&entry.path())?));
        }
    }
    Ok(found)
}

/// The crates that the library is linked from, without itself. Macros run at build time and leave
/// nothing behind.
fn linked_crates() -> Result<Vec<Crate>> {
    let output = cargo()
        .args(["metadata", "--format-version=1", "--quiet"])
        .output()
        .context("cannot start cargo")?;
    if !output.status.success() {
        bail!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    let metadata: Metadata =
        serde_json::from_slice(&output.stdout).context("cargo metadata cannot be read")?;
    let is_macro = |package: &Crate| {
        package.targets.iter().any(|target| target.kind.iter().any(|kind| kind == "proc-macro"))
    };
    let linkable: BTreeMap<_, _> = metadata
        .packages
        .iter()
        .filter(|package| !is_macro(package))
        .map(|package| (package.id.as_str(), package.name.as_str()))
        .collect();

    let mut linked = BTreeSet::new();
    let mut waiting: Vec<&str> =
        linkable.iter().filter(|(_, name)| **name == "ahv-fmu").map(|(id, _)| *id).collect();
    while let Some(id) = waiting.pop() {
        if !linkable.contains_key(id) || !linked.insert(id.to_string()) {
            continue;
        }
        let node = metadata.resolve.nodes.iter().find(|node| node.id == id);
        let normal = node.into_iter().flat_map(|node| &node.deps).filter(|dependency| {
            dependency.dep_kinds.iter().any(|DependencyKind { kind }| kind.is_none())
        });
        waiting.extend(normal.map(|dependency| dependency.pkg.as_str()));
    }
    let wanted = |package: &Crate| package.name != "ahv-fmu" && linked.contains(&package.id);
    Ok(metadata.packages.into_iter().filter(wanted).collect())
}
