//! Every fault of a law file is refused with the design, the key, the value and the limit.
#![allow(missing_docs)]

use ahv_autopilot::error::Error;
use ahv_autopilot::law::{BUILT_IN, Law};
use serde_json::{Value, json};

/// A file with one design of two states for every pair of period (s) and fuel fraction.
fn file(designs: &[(f64, f64)]) -> Value {
    let design = |&(period_s, fuel): &(f64, f64)| {
        json!({
            "period_s": period_s, "fuel_fraction": fuel, "fuel_mass_kg_per_m": 1000.0 * fuel,
            "A": [[1.0, 0.0], [0.0, 1.0]], "B": [[0.0, 0.0], [0.0, 0.0]],
            "C": [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]],
            "K": [[1.0, 0.0], [0.0, 1.0]], "Ki": [[0.0, 0.0], [0.0, 0.0]],
            "L": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            "level": [2000.0, 0.0, 0.0], "trim": [0.2, 0.3],
            "lowest": [-0.3, 0.0], "highest": [0.3, 0.6], "speed_error_m_per_s": 10.0
        })
    };
    json!({ "designs": designs.iter().map(design).collect::<Vec<_>>() })
}

fn refusal(text: &str) -> String {
    Law::parse(text).expect_err("the file is wrong").to_string()
}

/// What the second of two designs with another value of a key is refused with.
fn refused(key: &str, value: Value) -> String {
    let mut file = file(&[(0.01, 0.0), (0.01, 1.0)]);
    file["designs"][1][key] = value;
    refusal(&file.to_string())
}

#[test]
fn a_wrong_matrix_or_number_is_refused_with_design_key_and_limit() {
    for (key, value, said) in [
        ("A", json!([[1.0]]), "A has 1 rows; 2 to 16 states are possible"),
        ("A", json!(vec![vec![0.0; 17]; 17]), "A has 17 rows; 2 to 16 states are possible"),
        ("A", json!([[1.0, 0.0], [0.0]]), "A has 1 numbers in row 2; 2 are needed"),
        ("B", json!([[1.0, 0.0]]), "B has 1 rows; 2 are needed"),
        ("C", json!([[1.0, 0.0], [0.0, 1.0]]), "C has 2 rows; 3 are needed"),
        ("K", json!([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), "K has 3 numbers in row 1; 2 are needed"),
        ("Ki", json!([[1.0], [0.0]]), "Ki has 1 numbers in row 1; 2 are needed"),
        ("L", json!([[1.0, 0.0, 0.0]]), "L has 1 rows; 2 are needed"),
        ("period_s", json!(0.0), "period_s = 0.0 s must be within 1e-9 and 10"),
        ("period_s", json!(-0.01), "period_s = -0.01 s must be within 1e-9 and 10"),
        ("period_s", json!(1e-300), "period_s = 1e-300 s must be within 1e-9 and 10"),
        ("K", json!([[1.0, 0.0], [0.0, -1e301]]), "K has -1e301; numbers up to 1e30 are possible"),
        ("level", json!([2000.0, 0.0, 1e31]), "level has 1e31; numbers up to 1e30 are possible"),
        ("fuel_fraction", json!(1.5), "fuel_fraction = 1.5 must be within 0 and 1"),
        ("fuel_mass_kg_per_m", json!(-1.0), "fuel_mass_kg_per_m = -1 must not be negative"),
        ("speed_error_m_per_s", json!(0.0), "speed_error_m_per_s = 0 m/s must be positive"),
        ("trim", json!([0.4, 0.3]), "trim has 0.4; its limits are [-0.3, 0.3]"),
        ("lowest", json!([0.3, 0.0]), "trim has 0.2; its limits are [0.3, 0.3]"),
        ("lowest", json!([0.4, 0.0]), "lowest has 0.4, more than 0.3, the highest"),
    ] {
        let found = refused(key, value);
        assert!(found.starts_with(&format!("law.json: design 2: {said}")), "{found}");
    }
}

#[test]
fn designs_that_gains_are_interpolated_between_have_the_same_states() {
    let mut file = file(&[(0.01, 0.0), (0.01, 1.0)]);
    let design = &mut file["designs"][1];
    (design["A"], design["B"]) = (json!(vec![vec![0.0; 3]; 3]), json!(vec![vec![0.0; 2]; 3]));
    (design["C"], design["L"]) = (json!(vec![vec![0.0; 3]; 3]), json!(vec![vec![0.0; 3]; 3]));
    design["K"] = json!(vec![vec![0.0; 3]; 2]);
    let said = "law.json: design 2: A has 3 rows; the design before has 2";
    let refused = refusal(&file.to_string());
    assert!(refused.starts_with(said), "{refused}");
    file["designs"][1]["period_s"] = json!(0.02);
    Law::parse(&file.to_string()).expect("other periods have models of their own");
}

#[test]
fn a_byte_order_mark_is_no_part_of_the_law() {
    Law::parse(&format!("\u{feff}{BUILT_IN}")).expect("the law behind the mark");
}

#[test]
fn a_file_that_is_none_or_too_large_is_not_read() {
    let folder = std::env::temp_dir().join(format!("ahv-law-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("law.json");
    let refused = || Law::in_folder(&folder).unwrap_err().to_string();
    std::fs::File::create(&path).unwrap().set_len(4_000_001).unwrap();
    assert!(refused().contains("cannot be read: it has more than 4 MB"), "{}", refused());
    std::fs::remove_file(&path).unwrap();
    std::fs::create_dir(&path).unwrap();
    assert!(refused().contains("cannot be read: it is no regular file"), "{}", refused());
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn designs_out_of_order_are_refused() {
    for (designs, said) in [
        ([(0.01, 1.0), (0.01, 0.0)].as_slice(), "design 2: fuel_mass_kg_per_m = 0 kg/m must grow"),
        (&[(0.01, 0.5), (0.01, 0.5)], "design 2: fuel_mass_kg_per_m = 500 kg/m must grow"),
        (&[(0.01, 1.0), (0.02, 1.0), (0.01, 1.0)], "design 3: period_s = 0.01 s"),
    ] {
        let found = refusal(&file(designs).to_string());
        assert!(found.contains(said), "{found}");
    }
}

#[test]
fn what_is_no_law_is_refused_with_the_place() {
    for (text, said) in [
        ("", "EOF while parsing a value at line 1 column 0"),
        ("{}", "missing field `designs`"),
        (r#"{"designs": []}"#, "there is no design"),
        (r#"{"designs": [{"period_s": NaN}]}"#, "expected value at line 1 column 27"),
        (r#"{"designs": [{"period_s": 1e999}]}"#, "number out of range"),
        (r#"{"designs": [], "gains": 1}"#, "unknown field `gains`"),
    ] {
        let found = refusal(text);
        assert!(found.contains(said), "{found}");
        assert!(found.ends_with("examples/closed_loop/design.py writes it"), "{found}");
    }
    for half in (0..BUILT_IN.len() - 3).step_by(997) {
        refusal(&BUILT_IN[..half]);
    }
}

#[test]
fn a_period_picks_its_designs_and_another_is_refused_with_those_there_are() {
    let law = Law::parse(&file(&[(0.01, 0.0), (0.01, 1.0), (0.02, 1.0)]).to_string()).unwrap();
    assert_eq!([0.0, 0.01, 0.02].map(|period_s| law.designs(period_s).unwrap().len()), [2, 2, 1]);
    let refused = law.designs(0.05).unwrap_err();
    assert_eq!(refused, Error::Period { period_s: 0.05, known_s: vec![0.01, 0.02] });
    assert!(refused.to_string().contains("has designs for 0.01 s, 0.02 s;"), "{refused}");
}
