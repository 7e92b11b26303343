//! Opens an FMU: unzips it and reads its model description.

use crate::model_description::ModelDescription;
use crate::package::{Binary, host, universal};
use crate::workspace::{MAX_BINARY_BYTES, read, shown, write};
use anyhow::{Context, Result, bail};
use std::io::{Cursor, Read};
use std::path::{Component, Path, PathBuf};
use tempfile::TempDir;
use zip::ZipArchive;

/// Limit on files in an FMU; those with sources and documentation have hundreds.
const MAX_ENTRIES: usize = 10_000;
/// Limit on the unpacked size of an FMU.
const MAX_UNPACKED_BYTES: u64 = 2 * MAX_BINARY_BYTES;
/// Size limit of a model description; thousands of variables take a few MB.
const MAX_DESCRIPTION_BYTES: u64 = 50_000_000;

/// An unpacked FMU. Its directory is deleted when this value is dropped.
pub struct Fmu {
    directory: TempDir,
    /// Path of the binary for this machine.
    pub binary: PathBuf,
    pub model: ModelDescription,
}

impl Fmu {
    /// Unpacks a file and reads its description.
    pub fn open(file: &Path) -> Result<Self> {
        let name = shown(file);
        let content = read(file, MAX_BINARY_BYTES)?;
        let directory = TempDir::with_prefix("fmu-")?;
        unpack(&content, directory.path(), [MAX_ENTRIES as u64, MAX_UNPACKED_BYTES])
            .with_context(|| format!("{name} is not an FMU"))?;
        let xml = directory.path().join("modelDescription.xml");
        if !xml.exists() {
            bail!("{name} is not an FMU: it has no modelDescription.xml");
        }
        let xml = read(&xml, MAX_DESCRIPTION_BYTES).with_context(|| name.clone())?;
        let Ok(xml) = String::from_utf8(xml) else {
            bail!("{name}: modelDescription.xml is not UTF-8 text");
        };
        let model = ModelDescription::parse(&xml).with_context(|| name.clone())?;
        let Some(co_simulation) = &model.co_simulation else {
            bail!("{name} does not support co-simulation, which is needed");
        };
        let identifier = &co_simulation.model_identifier;
        if !is_c_identifier(identifier) {
            bail!("{name}: the modelIdentifier {identifier:?} is not a C identifier");
        }
        let host = host()?;
        let binary = host.binary(model.standard, identifier);
        let path = directory.path().join(&binary);
        if !path.exists() {
            bail!("{name} has no binary for this machine: {binary} is missing");
        }
        // Loading a damaged library may crash the process.
        let content = read(&path, MAX_BINARY_BYTES)?;
        universal::part(&content, host)
            .and_then(Binary::parse)
            .and_then(|found| found.is_for(host))
            .with_context(|| format!("{name}: {binary}"))?;
        Ok(Self { directory, binary: path, model })
    }

    /// The resources directory.
    pub fn resources(&self) -> PathBuf {
        self.directory.path().join("resources")
    }
}

fn is_c_identifier(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Unpacks a zip into a directory. Entries that lead out of it are refused.
fn unpack(content: &[u8], directory: &Path, [entries, bytes]: [u64; 2]) -> Result<()> {
    let mut archive = ZipArchive::new(Cursor::new(content)).context("it cannot be unzipped")?;
    if archive.len() as u64 > entries {
        bail!("it has {} files; the limit is {entries}", archive.len());
    }
    let mut left = bytes;
    for index in 0..archive.len() {
        let entry = archive.by_index(index).context("it cannot be unzipped")?;
        let name = entry.name().context("an entry has no readable name")?.into_owned();
        let inside = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        if entry.is_symlink() || !Path::new(&name).components().all(inside) {
            bail!("its entry {name:?} may lead out of the target folder");
        }
        if entry.is_dir() {
            continue;
        }
        let mut unpacked = Vec::new();
        // The size in the header may be wrong.
        entry
            .take(left + 1)
            .read_to_end(&mut unpacked)
            .with_context(|| format!("its entry {name:?} cannot be unzipped"))?;
        left = left.checked_sub(unpacked.len() as u64).with_context(|| {
            format!("it unpacks to more than {} MB, the limit", bytes / 1_000_000)
        })?;
        write(&directory.join(&name), unpacked)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, content) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(content).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }

    fn refused(content: &[u8], limits: [u64; 2]) -> String {
        let scratch = TempDir::new().unwrap();
        let inner = scratch.path().join("a/b");
        let message = format!("{:#}", unpack(content, &inner, limits).unwrap_err());
        assert!(!scratch.path().join("out.so").exists());
        message
    }

    #[test]
    fn bombs_and_ways_out_are_refused() {
        const MANY: [u64; 2] = [100, 1_000_000];
        let zeros = vec![0; 1_000_001];
        let mut linked = ZipWriter::new(Cursor::new(Vec::new()));
        linked.add_symlink("binaries", "/tmp", SimpleFileOptions::default()).unwrap();
        let linked = linked.finish().unwrap().into_inner();
        for (content, limits, told) in [
            (archive(&[("../../out.so", b"x")]), MANY, "entry \"../../out.so\" may lead out"),
            (archive(&[("/tmp/out.so", b"x")]), MANY, "may lead out"),
            (linked, MANY, "entry \"binaries\" may lead out"),
            (archive(&[("zeros", &zeros)]), MANY, "more than 1 MB, the limit"),
            (
                archive(&[("a", &zeros[..600_000]), ("b", &zeros[..600_000])]),
                MANY,
                "more than 1 MB",
            ),
            (archive(&[("a", b""), ("b", b"")]), [1, 10], "it has 2 files; the limit is 1"),
            (b"no zip".to_vec(), MANY, "it cannot be unzipped"),
        ] {
            let message = refused(&content, limits);
            assert!(message.contains(told), "{message}");
        }
        let good = archive(&[("modelDescription.xml", b"<x/>"), ("binaries/linux64/a.so", b"a")]);
        let scratch = TempDir::new().unwrap();
        unpack(&good, scratch.path(), MANY).unwrap();
        assert!(scratch.path().join("binaries/linux64/a.so").exists());
    }

    #[test]
    fn a_model_identifier_is_a_c_identifier() {
        assert!(is_c_identifier("ahv") && is_c_identifier("_a1"));
        for name in ["", "../../../tmp/evil", "1a", "a b", "a\\b"] {
            assert!(!is_c_identifier(name), "{name}");
        }
    }
}
