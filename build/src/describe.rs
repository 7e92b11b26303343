//! `cargo ahv describe`: writes modelDescription.xml from the table of variables.

use crate::cli::Describe;
use crate::workspace::{MAX_TEXT_BYTES, read_text, root, shown, write};
use ahv::flight::Setup;
use anyhow::{Result, bail};
use fmi_model::Model;
use fmi_model::describe::model_description;
use fmi_model::standard::Standard;

/// Name of the library in the FMU.
pub const MODEL_IDENTIFIER: &str = Setup::ABOUT.identifier;

pub fn run(options: &Describe) -> Result<()> {
    let default = root().join("modelDescription/modelDescription.xml");
    let file = options.file.as_ref().unwrap_or(&default);
    let expected = xml()?;
    if !options.check {
        write(file, expected)?;
        outln!("{}: {} variables", shown(file), Setup::VARIABLES.len())?;
        return Ok(());
    }
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
    outln!("{} is up to date", shown(file))?;
    Ok(())
}

/// The text of the file. It has no date, path or host name: the same sources give the same bytes.
pub fn xml() -> Result<String> {
    Ok(model_description::<Setup>(Standard::Fmi2)?)
}

#[cfg(test)]
mod tests;
