//! The commands of the tool, run as a user runs them.

mod tool;

use ahv_tool::models::MODELS;
use std::fs;
use tempfile::TempDir;
use tool::{ahv, library_of, package, package_of, scratch};

#[test]
fn committed_description_is_up_to_date() {
    let check = ahv(&["describe", "--check"]);
    assert!(check.ok, "{}", check.err);
}

#[test]
fn outdated_description_is_refused_with_line_and_remedy() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("modelDescription.xml");
    let path = file.to_str().unwrap();
    assert!(ahv(&["describe", "--file", path]).ok);
    let edited = fs::read_to_string(&file).unwrap().replacen("\"Pitch rate\"", "\"Pitching\"", 1);
    fs::write(&file, edited).unwrap();
    let check = ahv(&["describe", "--check", "--file", path]);
    assert!(!check.ok);
    assert!(check.err.contains("run `cargo ahv describe`"), "{}", check.err);
    assert!(check.err.contains("description=\"Pitching\""), "{}", check.err);
}

#[test]
fn same_library_gives_the_same_fmu() {
    for model in MODELS {
        let directory = TempDir::new().unwrap();
        let fmu = directory.path().join("a.fmu");
        let option = format!("linux64={}", library_of(model).display());
        let first = package_of(model, &option, &fmu);
        assert_eq!(first, package_of(model, &option, &fmu));
        let archive = zip::ZipArchive::new(std::io::Cursor::new(first)).unwrap();
        let names: Vec<_> = archive.file_names().map(|name| name.unwrap().into_owned()).collect();
        for start in [
            "modelDescription.xml",
            "model.png",
            &format!("binaries/linux64/{}.so", model.identifier),
            "documentation/index.html",
            "documentation/licenses/LICENSE-MIT",
            "documentation/licenses/fmi-model-",
            "documentation/licenses/wit-bindgen-",
            "terminalsAndIcons/icon.png",
        ] {
            assert!(names.iter().any(|name| name.starts_with(start)), "{start} is missing");
        }
    }
}

#[test]
fn the_library_of_another_model_is_refused() {
    for (model, other) in MODELS.into_iter().zip(MODELS.into_iter().cycle().skip(1)) {
        let directory = TempDir::new().unwrap();
        let fmu = directory.path().join("a.fmu");
        let option = format!("linux64={}", library_of(other).display());
        let arguments = ["package", "--model", model.name, "--library", &option, "--output"];
        let done = ahv(&[&arguments[..], &[fmu.to_str().unwrap()]].concat());
        assert!(!done.ok && done.err.contains(" is {"), "{}", done.err);
        assert!(!fmu.exists());
    }
}

#[test]
fn a_model_is_named_and_data_are_of_the_vehicle_alone() {
    let refused = ahv(&["package", "--model", "engine"]);
    let told = "there is no model `engine`; choose one of vehicle, ";
    assert!(!refused.ok && refused.err.contains(told), "{}", refused.err);
    let refused = ahv(&["package", "--model", "sensor", "--vehicle", "mine.toml"]);
    let told = "data of the vehicle; sensor has none";
    assert!(!refused.ok && refused.err.contains(told), "{}", refused.err);
}

#[test]
fn settings_are_refused_with_what_would_be_accepted() {
    for (setting, expected) in [
        ("mach_0=8", "there is no variable `mach_0`; did you mean mach0?"),
        ("mach=8", "mach is a result and cannot be set; did you mean mach0?"),
        ("mach0", "name=value is expected"),
        ("mach0=fast", "a finite number is expected"),
        ("mach0=nan", "a finite number is expected"),
        ("mach0=1000", "the range is ["),
        ("gamma0=1grad", "in rad or deg"),
        ("V=2000", "V is a result and cannot be set; choose from configuration, aero,"),
        ("delta_e=0.1", "delta_e is an input"),
        ("configuration=Stiff", "choose one of Rigid (1), EvenMassBeam (2), SloshBeam (3)"),
        ("trim=maybe", "true or false is expected"),
    ] {
        let trim = ahv(&["trim", "--set", setting]);
        assert!(!trim.ok, "{setting} was accepted");
        let start = format!("error: --set {setting}: ");
        assert!(trim.err.starts_with(&start) && trim.err.contains(expected), "{}", trim.err);
    }
}

#[test]
fn a_parameter_that_is_set_twice_is_refused() {
    let trim = ahv(&["trim", "--set", "mach0=8", "--set", "gamma0=0", "--set", "mach0=9"]);
    assert!(!trim.ok);
    let expected = "error: --set mach0=9: mach0 is already set by --set mach0=8";
    assert!(trim.err.starts_with(expected), "{}", trim.err);
}

#[test]
fn impossible_trim_names_the_limit() {
    let trim = ahv(&["trim", "--set", "altitude0=60000"]);
    assert!(!trim.ok);
    assert!(trim.err.contains("altitude0 = 60000 m"), "{}", trim.err);
}

#[test]
fn settings_take_names_units_and_numbers() {
    let value = |setting: &str, name: &str| {
        let trim = ahv(&["trim", "--json", "--set", setting]);
        assert!(trim.ok, "{}", trim.err);
        let json: serde_json::Value = serde_json::from_str(&trim.out).unwrap();
        match name {
            "configuration" => json[name].to_string(),
            _ => json["trim"][name]["value"].to_string(),
        }
    };
    assert_eq!(value("configuration=rigid", "configuration"), "\"Rigid\"");
    assert_eq!(value("configuration=2", "configuration"), "\"EvenMassBeam\"");
    assert_eq!(value("gamma0=1deg", "gamma"), 1f64.to_radians().to_string());
    assert_eq!(value("gamma0=0.01rad", "gamma"), "0.01");
    assert_eq!(value("mach0=9", "mach"), "9.0");
}

#[test]
fn fly_refuses_a_bad_file_before_it_flies() {
    let (directory, option, fmu) = scratch();
    package(&option, &fmu);
    let input = directory.path().join("bad.csv");
    fs::write(&input, "time,phi\n0.1,0\n0.2,full\n").unwrap();
    let fmu = fmu.to_str().unwrap();
    let fly = ahv(&["fly", "--fmu", fmu, "--input", input.to_str().unwrap()]);
    assert!(!fly.ok);
    assert!(fly.err.contains("bad.csv, line 3, column phi: `full`"), "{}", fly.err);

    let fly = ahv(&["fly", "--fmu", fmu, "--step", "0"]);
    assert!(fly.err.contains("--step 0: a finite number above zero"), "{}", fly.err);
    let fly = ahv(&["fly", "--fmu", input.to_str().unwrap()]);
    assert!(fly.err.contains("is not an FMU"), "{}", fly.err);
    let fly = ahv(&["fly", "--fmu", "none.fmu"]);
    assert!(fly.err.contains("cannot read none.fmu"), "{}", fly.err);
}

#[test]
fn poles_stand_side_by_side() {
    let poles = ahv(&["poles", "--all"]);
    assert!(poles.ok, "{}", poles.err);
    for word in ["Rigid", "EvenMassBeam", "SloshBeam", "phugoid", "short period", "height"] {
        assert!(poles.out.contains(word), "{word} is missing in\n{}", poles.out);
    }
    assert!(ahv(&["modes"]).out.contains("3rd flexible"));
}
