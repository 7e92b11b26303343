//! Runs the tool and provides an FMU for it.
#![allow(dead_code)]

use ahv_tool::models::{PackagedModel, VEHICLE};
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

pub struct Outcome {
    pub ok: bool,
    pub out: String,
    pub err: String,
}

impl From<Output> for Outcome {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { ok: output.status.success(), out: text(output.stdout), err: text(output.stderr) }
    }
}

pub fn ahv(arguments: &[&str]) -> Outcome {
    Command::new(env!("CARGO_BIN_EXE_ahv")).args(arguments).output().unwrap().into()
}

/// The vehicle's library.
pub fn library() -> PathBuf {
    library_of(&VEHICLE)
}

/// The library of a model that Cargo built for the tool.
pub fn library_of(model: &PackagedModel) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let name = format!("{DLL_PREFIX}{}{DLL_SUFFIX}", model.identifier);
    let found = test.ancestors().skip(1).take(2).map(|folder| folder.join(&name));
    found.into_iter().find(|path| path.exists()).expect("the shared library beside the test")
}

/// A folder, the option for packaging the library, and a place to put an FMU.
pub fn scratch() -> (TempDir, String, PathBuf) {
    let directory = TempDir::new().unwrap();
    let option = format!("linux64={}", library().display());
    let fmu = directory.path().join("ahv.fmu");
    (directory, option, fmu)
}

pub fn package(option: &str, fmu: &Path) -> Vec<u8> {
    package_of(&VEHICLE, option, fmu)
}

pub fn package_of(model: &PackagedModel, option: &str, fmu: &Path) -> Vec<u8> {
    let arguments = ["package", "--model", model.name, "--library", option, "--output"];
    let done = ahv(&[&arguments[..], &[fmu.to_str().unwrap()]].concat());
    assert!(done.ok, "{}", done.err);
    fs::read(fmu).unwrap()
}
