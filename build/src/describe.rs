//! `cargo ahv describe`: writes the model descriptions from the tables of variables.

use crate::cli::Describe;
use crate::models::{MODELS, PackagedModel, VEHICLE};
use crate::workspace::{MAX_TEXT_BYTES, cargo, read_text, root, shown, write};
use anyhow::{Context, Result, bail};
use fmi_model::standard::Standard;
use std::path::{Path, PathBuf};
use std::process::Stdio;

pub fn run(options: &Describe) -> Result<()> {
    let models = match (options.model, &options.file) {
        (Some(model), _) => vec![model],
        (None, Some(_)) => vec![&VEHICLE],
        (None, None) => MODELS.to_vec(),
    };
    let standards = match options.fmi {
        Some(version) => vec![version.into()],
        None if options.file.is_some() => vec![Standard::Fmi2],
        None => Standard::ALL.to_vec(),
    };
    for model in models {
        for standard in &standards {
            let file = options.file.clone().unwrap_or_else(|| committed_file(model, *standard));
            let xml = (model.describe)(*standard)?;
            if options.check { compare(&file, &xml) } else { write_to(&file, &xml) }?;
        }
    }
    Ok(())
}

/// The committed file.
fn committed_file(model: &PackagedModel, standard: Standard) -> PathBuf {
    let mut folder = root().join("modelDescription");
    if model.identifier != VEHICLE.identifier {
        folder.push(model.identifier);
    }
    if standard == Standard::Fmi3 {
        folder.push("fmi3");
    }
    folder.join("modelDescription.xml")
}

fn write_to(file: &Path, xml: &str) -> Result<()> {
    write(file, xml)?;
    outln!("wrote {}", shown(file))
}

fn compare(file: &Path, expected: &str) -> Result<()> {
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

/// The committed description of a model.
pub fn committed(model: &PackagedModel, standard: Standard) -> Result<String> {
    read_text(&committed_file(model, standard), MAX_TEXT_BYTES)
}

/// The description of a part, which only a program of its own can link: each exports the same C functions.
pub fn by_program(name: &str, standard: Standard) -> Result<String> {
    let version = match standard {
        Standard::Fmi2 => "2",
        Standard::Fmi3 => "3",
    };
    let example = format!("describe_{name}");
    let mut run = cargo();
    run.args(["run", "--quiet", "--profile", "tool", "--package", "ahv", "--example", &example]);
    run.args(["--", version]).stderr(Stdio::inherit());
    let output = run.output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("{name} cannot be described: see the messages above");
    }
    String::from_utf8(output.stdout).context("the description is not UTF-8")
}

#[cfg(test)]
mod tests;
