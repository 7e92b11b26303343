//! What is in a package that was written before.

use super::platform::{LINUX, Platform};
use super::{Files, universal, wasm};
use crate::workspace::{MAX_BINARY_BYTES, read, shown};
use anyhow::{Context, Result, bail};
use fmi_model::standard::Standard;
use std::io::{Cursor, Read};
use std::path::Path;
use zip::ZipArchive;

/// A file in an archive.
pub fn entry(package: &Path, name: &str) -> Result<Vec<u8>> {
    let mut archive = ZipArchive::new(Cursor::new(read(package, MAX_BINARY_BYTES)?))?;
    let file =
        archive.by_name(name).with_context(|| format!("{} has no {name}", shown(package)))?;
    let mut content = Vec::new();
    file.take(MAX_BINARY_BYTES).read_to_end(&mut content)?;
    Ok(content)
}

/// The files below a folder in an archive.
pub fn entries(package: &Path, folder: &str) -> Result<Files> {
    let mut archive = ZipArchive::new(Cursor::new(read(package, MAX_BINARY_BYTES)?))?;
    let mut files = Files::new();
    for index in 0..archive.len() {
        let file = archive.by_index(index)?;
        let name = file.name()?.into_owned();
        if name.starts_with(folder) && file.is_file() {
            let mut content = Vec::new();
            file.take(MAX_BINARY_BYTES).read_to_end(&mut content)?;
            files.insert(name, content);
        }
    }
    Ok(files)
}

/// A model's library for a platform in an FMU of FMI 2.0.
pub fn library(package: &Path, identifier: &str, platform: Platform) -> Result<Vec<u8>> {
    let content = entry(package, &platform.binary(Standard::Fmi2, identifier))?;
    Ok(universal::part(&content, platform)?.to_vec())
}

/// The same if the package's library for Linux is `linux`: then the model is the same.
pub fn kept(package: &Path, identifier: &str, linux: &[u8], platform: Platform) -> Option<Vec<u8>> {
    let same = library(package, identifier, LINUX).is_ok_and(|packaged| packaged == linux);
    if same { library(package, identifier, platform).ok() } else { None }
}

/// The component in an FMU of FMI 3.0 whose library for Linux is `linux`.
pub fn component(package: &Path, identifier: &str, linux: &[u8]) -> Result<Vec<u8>> {
    if entry(package, &LINUX.binary(Standard::Fmi3, identifier))? != linux {
        bail!("{} is of another model", shown(package));
    }
    entry(package, &wasm::name(identifier))
}
