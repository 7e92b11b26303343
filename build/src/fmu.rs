//! An FMU as a file: unzipped, with its description read.

use crate::model_description::ModelDescription;
use crate::package::HOST;
use crate::workspace::{read_text, shown};
use anyhow::{Context, Result, bail};
use std::fs::File;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use zip::ZipArchive;

/// An unpacked FMU. The directory goes when this value does.
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
        let archive = File::open(file).with_context(|| format!("cannot open {name}"))?;
        let directory = TempDir::with_prefix("fmu-")?;
        ZipArchive::new(archive)
            .and_then(|mut archive| archive.extract(directory.path()))
            .with_context(|| format!("{name} is not an FMU: it cannot be unzipped"))?;
        let xml = read_text(&directory.path().join("modelDescription.xml"))
            .with_context(|| format!("{name} is not an FMU: it has no modelDescription.xml"))?;
        let model = ModelDescription::parse(&xml).with_context(|| name.clone())?;
        let Some(co_simulation) =
            model.co_simulation.as_ref().filter(|_| model.fmi_version == "2.0")
        else {
            bail!("{name}: FMI {}; an FMU for FMI 2.0 co-simulation is needed", model.fmi_version);
        };
        let binary =
            format!("binaries/{}/{}.{}", HOST.name, co_simulation.model_identifier, HOST.ending);
        let path = directory.path().join(&binary);
        if !path.exists() {
            bail!("{name} has no binary for this machine: {binary} is not in it");
        }
        Ok(Self { directory, binary: path, model })
    }

    /// URI of the resources, for the sake of the interface: an FMU may look there.
    pub fn resources(&self) -> String {
        format!("file://{}", self.directory.path().join("resources").display())
    }
}
