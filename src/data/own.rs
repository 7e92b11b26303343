//! The user's data files, which take the place of built-in ones.

use crate::error::Error;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Size limit of a data file; ours have 8 kB.
pub const MAX_DATA_BYTES: u64 = 1_000_000;

/// A file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OwnFile {
    /// Its name or path, for messages and descriptions.
    pub name: String,
    /// What it holds.
    pub text: String,
}

/// The user's data files; what is not there is that of the library.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OwnFiles {
    /// Geometry, mass, beam, tanks.
    pub vehicle: Option<OwnFile>,
    /// The coefficient set `own`.
    pub coefficients: Option<OwnFile>,
}

impl OwnFiles {
    /// Name of the vehicle's file in the resources of a package.
    pub const VEHICLE: &str = "vehicle.toml";
    /// Name of the coefficients' file there.
    pub const COEFFICIENTS: &str = "aero.toml";

    /// The files in the resources of a package.
    ///
    /// # Errors
    /// [`Error::File`] of a file that is there and cannot be read.
    pub fn in_folder(folder: &Path) -> Result<Self, Error> {
        Ok(Self {
            vehicle: file(folder, Self::VEHICLE)?,
            coefficients: file(folder, Self::COEFFICIENTS)?,
        })
    }

    /// Names of the files, without their folders.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let files = [&self.vehicle, &self.coefficients].into_iter().flatten();
        files.map(|file| file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name))
    }
}

/// A file of the folder, if it has it. Links, devices and pipes are refused: those may never end.
fn file(folder: &Path, name: &str) -> Result<Option<OwnFile>, Error> {
    let path = folder.join(name);
    match text(&path) {
        Ok(text) => Ok(Some(OwnFile { name: name.to_string(), text })),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::File {
            file: path.to_string_lossy().into_owned(),
            problem: error.to_string(),
        }),
    }
}

#[expect(clippy::disallowed_methods, reason = "the one place of the library that reads files")]
fn text(path: &Path) -> io::Result<String> {
    let file = fs::symlink_metadata(path)?;
    if !file.is_file() {
        return Err(io::Error::other("it is no regular file"));
    }
    if file.len() > MAX_DATA_BYTES {
        return Err(io::Error::other("it has more than 1 MB"));
    }
    let mut text = String::new();
    File::open(path)?.take(MAX_DATA_BYTES).read_to_string(&mut text)?;
    Ok(text)
}
