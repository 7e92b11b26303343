//! Commands with the user's own data files.

mod tool;

use ahv::data::VEHICLE;
use std::fs;
use std::io::{Cursor, Read};
use tool::{ahv, scratch};

#[test]
fn an_own_vehicle_is_our_libraries_with_the_files_of_the_user() {
    let (directory, library, fmu) = scratch();
    let mine = directory.path().join("mine.toml");
    let text = VEHICLE.text.replacen("value = 25900", "value = 26500", 1);
    fs::write(&mine, &text).unwrap();
    let [mine_path, fmu_path] = [&mine, &fmu].map(|path| path.to_str().unwrap());
    let package = ["package", "--library", &library, "--vehicle", mine_path, "--output", fmu_path];
    let done = ahv(&package);
    assert!(done.ok, "{}", done.err);
    let bytes = fs::read(&fmu).unwrap();
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut content = |name: &str| {
        let mut text = String::new();
        archive.by_name(name).unwrap().read_to_string(&mut text).unwrap();
        text
    };
    assert_eq!(content("resources/vehicle.toml"), text);
    let xml = content("modelDescription.xml");
    assert!(xml.contains("; data: mine.toml\"") && xml.contains("start=\"26500\""));
    assert!(content("documentation/index.html").contains("from <code>resources</code>"));

    let results = directory.path().join("flight");
    let results = results.to_str().unwrap();
    let fly = ahv(&["fly", "--fmu", fmu_path, "--stop", "0.02", "--output", results]);
    assert!(fly.ok && fly.out.contains("h "), "{}", fly.err);
    let flight = fs::read_to_string(directory.path().join("flight/flight.csv")).unwrap();
    assert!(flight.lines().nth(1).unwrap().contains("26500"), "{flight}");
    let trim = ahv(&["trim", "--vehicle", mine_path]);
    assert!(trim.ok && trim.out.contains("26500"), "{}{}", trim.out, trim.err);

    let before = fs::read(&fmu).unwrap();
    fs::write(&mine, text.replacen("value = 30.48", "value = -1", 1)).unwrap();
    for arguments in
        [&package[..], &["modes", "--vehicle", mine_path], &["poles", "--vehicle", mine_path]]
    {
        let refused = ahv(arguments);
        let told = "mine.toml: geometry.length_m: -1 must lie in [0.001, 1000] m";
        assert!(!refused.ok && refused.err.contains(told), "{}", refused.err);
    }
    assert_eq!(fs::read(&fmu).unwrap(), before);
}

#[test]
fn own_coefficients_can_be_chosen_where_there_are_any() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/data/aero/parker2007.toml");
    let trim = |arguments: &[&str]| ahv(&[&["trim", "--json"], arguments].concat());
    let own = trim(&["--coefficients", file, "--set", "aero=own"]);
    assert!(own.ok, "{}", own.err);
    assert_eq!(own.out, trim(&["--coefficients", file]).out, "own is the default");
    assert_eq!(own.out, trim(&["--set", "aero=parker2007"]).out);
    let none = trim(&["--set", "aero=own"]);
    assert!(!none.ok && none.err.contains("choose one of xu2015 (1)"), "{}", none.err);
}
