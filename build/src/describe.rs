//! `cargo ahv describe`: writes the model descriptions from the table of variables.

use crate::cli::Describe;
use crate::workspace::{MAX_TEXT_BYTES, read_text, root, shown, write};
use ahv::flight::Setup;
use anyhow::{Result, bail};
use fmi_model::Model;
use fmi_model::describe::model_description_of;
use fmi_model::standard::Standard;
use std::path::{Path, PathBuf};

/// Name of the library in the FMU.
pub const MODEL_IDENTIFIER: &str = Setup::ABOUT.identifier;

pub fn run(options: &Describe) -> Result<()> {
    let versions = match options.fmi {
        Some(version) => vec![version.into()],
        None if options.file.is_some() => vec![Standard::Fmi2],
        None => Standard::ALL.to_vec(),
    };
    versions.into_iter().try_for_each(|standard| {
        let file = options.file.clone().unwrap_or_else(|| committed(standard));
        if options.check { compare(&file, standard) } else { write_to(&file, standard) }
    })
}

/// The committed file.
fn committed(standard: Standard) -> PathBuf {
    root().join(match standard {
        Standard::Fmi2 => "modelDescription/modelDescription.xml",
        Standard::Fmi3 => "modelDescription/fmi3/modelDescription.xml",
    })
}

fn write_to(file: &Path, standard: Standard) -> Result<()> {
    write(file, xml(standard)?)?;
    outln!("{}: {} variables", shown(file), Setup::VARIABLES.len())
}

fn compare(file: &Path, standard: Standard) -> Result<()> {
    let expected = xml(standard)?;
    let found = read_text(file, MAX_TEXT_BYTES)?;
    if found != expected {
        let line = found.lines().zip(expected.lines()).take_while(|(a, b)| a == b).count();
        bail!(
            "{}, line {}: differs from the table of variables; run `cargo ahv describe` and \
             commit the result\n  found:    {}\n  expected: {}",
            shown(file),
            line + 1,
            found.lines().nth(line).unwrap_or("(end of file)").trim(),
            expected.lines().nth(line).unwrap_or("(end of file)").trim(),
        );
    }
    outln!("{} is up to date", shown(file))
}

/// The text of a file. It has no date, path or host name: the same sources give the same bytes.
pub fn xml(standard: Standard) -> Result<String> {
    xml_of(&Setup::new()?, standard)
}

/// The same of a vehicle with data of its own.
pub fn xml_of(setup: &Setup, standard: Standard) -> Result<String> {
    Ok(model_description_of(setup, standard)?)
}

#[cfg(test)]
mod tests;
