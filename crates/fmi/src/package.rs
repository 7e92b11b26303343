//! FMUs around a library that Cargo built: one for each standard.
//!
//! A package with a `cdylib` and a program that calls [`main`] is all that they need: `cargo run
//! --release` builds both and writes the FMUs beside them.

#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "a program, not the library: it writes a file and says where"
)]

use crate::archive::zip;
use crate::describe::model_description;
use crate::model::Model;
use crate::platform::Platform;
use crate::standard::Standard;
use std::collections::BTreeMap;
use std::env::{self, consts};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What kept an FMU from being written.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// The model has no defaults.
    #[error("the model cannot be described: {0}")]
    Model(#[from] crate::failure::Failure),
    /// FMI has no name for this machine.
    #[error("FMI has no name for a platform like {os} on {arch}")]
    Platform {
        /// System, as Rust calls it.
        os: &'static str,
        /// Processor, as Rust calls it.
        arch: &'static str,
    },
    /// A file cannot be read or written.
    #[error("{}: {error}", file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// The zip file cannot be made.
    #[error("the FMU cannot be packed: {0}")]
    Zip(#[from] zip::result::ZipError),
}

/// Packs a model's description and its library for this machine; the same inputs give the same bytes.
///
/// # Errors
/// [`PackageError`]; a file that is there is replaced only by a whole one.
pub fn package<M: Model>(
    library: &Path,
    standard: Standard,
    output: &Path,
) -> Result<(), PackageError> {
    let (os, arch) = (consts::OS, consts::ARCH);
    let platform = Platform::of(os, arch).ok_or(PackageError::Platform { os, arch })?;
    let failed = |file: &Path| {
        let file = file.to_path_buf();
        |error| PackageError::File { file, error }
    };
    let content = fs::read(library).map_err(failed(library))?;
    let name = platform.binary(standard, M::ABOUT.identifier);
    let description = model_description::<M>(standard)?.into_bytes();
    let files =
        BTreeMap::from([("modelDescription.xml".to_string(), description), (name, content)]);
    let beside = output.with_extension("fmu.part");
    fs::write(&beside, zip(&files)?).map_err(failed(&beside))?;
    fs::rename(&beside, output).map_err(failed(output))
}

/// The program that writes the FMUs of both standards beside itself, where Cargo also puts the library.
pub fn main<M: Model>() -> ExitCode {
    let identifier = M::ABOUT.identifier;
    let written = env::current_exe()
        .map_err(|error| PackageError::File { file: "this program".into(), error })
        .and_then(|program| {
            let library = format!("{}{identifier}{}", consts::DLL_PREFIX, consts::DLL_SUFFIX);
            let library = program.with_file_name(library);
            let outputs = Standard::ALL
                .map(|standard| (standard, program.with_file_name(standard.file_name(identifier))));
            for (standard, output) in &outputs {
                package::<M>(&library, *standard, output)?;
            }
            Ok(outputs)
        });
    match written {
        Ok(outputs) => {
            for (_, output) in outputs {
                println!("{}", output.display());
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
