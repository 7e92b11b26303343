//! Build script: selects the data files of the library and packs them in binary form.
//!
//! `AHV_VEHICLE` names a file that replaces `vehicle.toml`, `AHV_COEFFICIENTS` one that
//! becomes the coefficient set `own`; `cargo ahv` sets them from its options.

#[path = "../src/data/files.rs"]
#[allow(dead_code)]
mod files;
#[path = "../src/data/quantity.rs"]
#[allow(dead_code)]
mod quantity;
#[path = "../src/data/ranges.rs"]
mod ranges;
#[path = "../src/data/shape.rs"]
#[allow(dead_code)]
mod shape;
#[path = "../src/short.rs"]
mod short;

use files::{AeroData, EarthData, VehicleData};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let ours = |name: &str| Path::new("src/data").join(name).with_extension("toml");
    let [vehicle, coefficients] = [given("AHV_VEHICLE"), given("AHV_COEFFICIENTS")];
    embed::<VehicleData>("vehicle", vehicle.as_deref().unwrap_or(&ours("vehicle")));
    embed::<EarthData>("earth", &ours("earth"));
    for name in ["aero/xu2015", "aero/parker2007", "aero/shock_expansion"] {
        embed::<AeroData>(name, &ours(name));
    }
    println!("cargo::rustc-check-cfg=cfg(own_coefficients)");
    if let Some(file) = &coefficients {
        println!("cargo::rustc-cfg=own_coefficients");
        embed::<AeroData>("aero/own", file);
    }
    let names: Vec<_> =
        [vehicle, coefficients].iter().flatten().filter_map(|file| name(file)).collect();
    println!("cargo::rustc-env=AHV_OWN_FILES={}", names.join(", "));
}

fn name(file: &Path) -> Option<String> {
    Some(file.file_name()?.to_string_lossy().into_owned())
}

fn given(variable: &str) -> Option<PathBuf> {
    println!("cargo::rerun-if-env-changed={variable}");
    env::var_os(variable).map(PathBuf::from)
}

/// Embeds the text of a file and its numbers in packed form: with a TOML parser the library would be half as
/// large again.
fn embed<T: Serialize + DeserializeOwned>(name: &str, file: &Path) {
    println!("cargo::rerun-if-changed={}", file.display());
    let text = fs::read_to_string(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let table = text.parse().unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    if let Some((key, problem)) = ranges::first_problem(&table) {
        panic!("{}: {key}: {problem}", file.display());
    }
    let data: T = toml::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let out = Path::new(&env::var_os("OUT_DIR").expect("Cargo says where")).join(name);
    fs::create_dir_all(out.parent().expect("a file has a folder")).expect("the folder is ours");
    fs::write(out.with_extension("toml"), text).expect("the folder is ours");
    let packed = postcard::to_stdvec(&data).expect("numbers and texts can be packed");
    fs::write(out.with_extension("packed"), packed).expect("the folder is ours");
}
