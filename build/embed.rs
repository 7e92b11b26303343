//! Build script: checks the data files of the library and packs them in binary form.

/// What reads the data files, as in the library.
#[allow(dead_code)]
#[path = "../src/data"]
mod data {
    pub mod document;
    pub mod files;
    pub mod quantity;
    pub mod ranges;
    pub mod reader;
    pub mod shape;
}
#[path = "../src/short.rs"]
mod short;

use data::files::{AeroData, EarthData, VehicleData};
use data::reader::{Entry, Problem, parse};
use std::path::Path;
use std::{env, fs};

fn main() {
    embed::<VehicleData>("vehicle");
    embed::<EarthData>("earth");
    for name in ["aero/xu2015", "aero/parker2007", "aero/shock_expansion"] {
        embed::<AeroData>(name);
    }
}

/// Embeds the text of a file, and its numbers in packed form, which is quick to read and what the FMU's GUID
/// depends on.
fn embed<T: Entry>(name: &str) {
    let file = Path::new("src/data").join(name).with_extension("toml");
    println!("cargo::rerun-if-changed={}", file.display());
    let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let packed = match parse::<T>(&text) {
        Ok((_, packed)) => packed,
        Err(Problem { key, problem }) => panic!("{}: {key}: {problem}", file.display()),
    };
    let out = Path::new(&env::var_os("OUT_DIR").expect("Cargo says where")).join(name);
    fs::create_dir_all(out.parent().expect("a file has a folder")).expect("the folder is ours");
    fs::write(out.with_extension("toml"), text).expect("the folder is ours");
    fs::write(out.with_extension("packed"), packed).expect("the folder is ours");
}
