//! The committed numbers are those that the commands write.

use std::process::Command;

struct Outcome {
    ok: bool,
    out: String,
    err: String,
}

fn ahv(arguments: &[&str]) -> Outcome {
    let output = Command::new(env!("CARGO_BIN_EXE_ahv-research")).args(arguments).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    Outcome { ok: output.status.success(), out, err }
}

#[test]
fn committed_stiffness_and_tanks_are_what_the_identification_finds() {
    let check = ahv(&["identify", "beam", "--check", "--json"]);
    assert!(check.ok, "{}", check.err);
    assert!(check.err.contains("src/data/vehicle.toml is up to date"), "{}", check.err);
    let json: serde_json::Value = serde_json::from_str(&check.out).unwrap();
    let data = json["data"].as_array().unwrap();
    assert_eq!(data.len(), 7);
    for datum in data {
        let number = |key: &str| datum[key].as_f64().unwrap();
        assert!((number("value") - number("printed")).abs() < number("doubt"), "{datum}");
    }
    let numbers = json["numbers"].as_array().unwrap();
    assert_eq!(numbers.len(), 14, "nine stiffnesses, two centres and lengths, one share");
    for line in numbers {
        let number = |key: &str| line[key].as_f64().unwrap();
        assert!(number("error") > 0.0 && number("error") <= number("prior_error"), "{line}");
        assert!((0.0..1.0).contains(&number("decided_by_data")), "{line}");
        assert_eq!(line["sensitivity"].as_array().unwrap().len(), 7, "{line}");
    }
}

#[test]
fn committed_coefficients_are_what_the_identification_finds() {
    let check = ahv(&["identify", "xu2015", "--check"]);
    assert!(check.ok, "{}", check.err);
    assert!(check.err.contains("src/data/aero/xu2015.toml is up to date"), "{}", check.err);
}

#[test]
fn committed_fit_is_what_the_model_says() {
    let check = ahv(&["fit", "--check"]);
    assert!(check.ok, "{}", check.err);
    assert!(check.out.contains("held out, rms"), "{}", check.out);
}
