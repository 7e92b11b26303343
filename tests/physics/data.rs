//! The data files: what they must hold, and how a wrong one is refused.

use ahv::data::{
    AeroData, Data, DataFile, EARTH, EarthData, PARKER2007, SHOCK_EXPANSION, VEHICLE, VehicleData,
    XU2015,
};
use ahv::dynamics::trim::trim;
use ahv::error::Error;
use ahv::flight::Parameters;
use ahv::vehicle::{Configuration, Vehicle, VehicleOptions};

fn for_each_number(table: &toml::Table, path: &str, check: &mut impl FnMut(&str, &toml::Table)) {
    for (key, value) in table {
        let path = format!("{path}.{key}");
        match value {
            toml::Value::Table(inner) if inner.contains_key("value") => check(&path, inner),
            toml::Value::Table(inner) => for_each_number(inner, &path, check),
            toml::Value::Array(rows) => {
                for row in rows {
                    for_each_number(row.as_table().expect("a table"), &path, check);
                }
            }
            other => assert!(other.is_str(), "{path}: a number without unit and source"),
        }
    }
}

#[test]
fn verif_the_files_in_the_library_are_as_a_user_would_have_to_write_them() {
    VehicleData::parse("vehicle.toml", VEHICLE.text).unwrap();
    EarthData::parse("earth.toml", EARTH.text).unwrap();
    for set in [XU2015, PARKER2007, SHOCK_EXPANSION] {
        AeroData::parse(set.name, set.text).unwrap();
    }
}

/// The file as the library carries it: what the FMU's GUID depends on.
fn packed(text: &str) -> Vec<u8> {
    VehicleData::parse_and_pack("vehicle.toml", text).unwrap().1
}

#[test]
fn verif_numbers_identify_the_model_and_comments_and_sources_do_not() {
    let text = VEHICLE.text;
    let bare: String = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.replace("source = \"", "source = \"reworded: ") + "\n")
        .collect();
    assert_ne!(bare, text);
    assert_eq!(packed(&bare), VEHICLE.packed);
    let higher = text.replacen("value = 25900", "value = 25901", 1);
    assert_ne!(higher, text);
    assert_ne!(packed(&higher), VEHICLE.packed);
}

#[test]
fn verif_every_number_has_unit_source_and_status() {
    for text in [VEHICLE.text, EARTH.text, XU2015.text, PARKER2007.text, SHOCK_EXPANSION.text] {
        let mut count = 0;
        for_each_number(&text.parse().unwrap(), "", &mut |path, number| {
            count += 1;
            for field in ["unit", "source", "status"] {
                let text = number.get(field).and_then(toml::Value::as_str).unwrap_or("");
                assert!(!text.is_empty(), "{path}: no {field}");
            }
        });
        assert!(count >= 9, "only {count} numbers found");
    }
}

/// The message that a vehicle file gets after one replacement.
fn refused(from: &str, to: &str) -> String {
    assert!(VEHICLE.text.contains(from), "{from} is not in the file");
    let text = VEHICLE.text.replacen(from, to, 1);
    VehicleData::parse("mine.toml", &text).expect_err(to).to_string()
}

#[test]
fn verif_a_wrong_vehicle_is_refused_with_file_key_and_limit() {
    for (from, to, told) in [
        (
            "length_m = { value = 30.48",
            "length_m = { value = -1.0",
            "geometry.length_m: -1 must lie in [0.001, 1000] m",
        ),
        (
            "fore_body_m = { value = 14.3256",
            "fore_body_m = { value = 99.0",
            "geometry.fore_body_m: 99 must lie between 0 and 30.48",
        ),
        (
            "propellant_fraction = { value = 0.65",
            "propellant_fraction = { value = 1.65",
            "mass.propellant_fraction: 1.65 must lie in [0, 1]",
        ),
        (
            "elements = { value = 500",
            "elements = { value = 3",
            "beam.elements: 3 must lie in [8, 2000]",
        ),
        ("[0.0, 3.81,", "[0.0, 33.81,", "beam.stiffness_station_m"),
        ("[0.0, 3.81,", "[3.81,", "must run from 0 to 30.48"),
        // Identified numbers: whatever they are.
        (
            "stiffness_n_m2_per_m = { value = [",
            "stiffness_n_m2_per_m = { value = [-",
            "beam.stiffness_n_m2_per_m: -",
        ),
        (
            "stiffness_n_m2_per_m = { value = [",
            "stiffness_n_m2_per_m = { value = [1e8, ",
            "beam.stiffness_n_m2_per_m: 10 values for 9 stations",
        ),
        ("centre_m = { value = ", "centre_m = { value = 99", "tank.fore.centre_m"),
        ("share = { value = 0.", "share = { value = 0.9", "tank.share: the shares add up to 1."),
        (
            "unit = \"kg/m^2\"",
            "unit = \"lb/ft^2\"",
            "mass.fore_beam_kg_per_m2: the unit is lb/ft^2, must be kg/m^2",
        ),
        (
            "bay_length_m = { value = 0.508, unit = \"m\"",
            "bay_length_m = { value = 0.508, unit = \"ft\"",
            "tank.fore.bay_length_m: the unit is ft, must be m",
        ),
        (
            "status = \"identified\"",
            "status = \"guessed\"",
            "the status is guessed, must be one of published, converted",
        ),
        (
            "[actuation]",
            "[actuators]",
            "actuators: unknown key, must be one of geometry, mass, beam, tank, actuation",
        ),
        (
            "length_m = { value = 30.48",
            "length_m = { value = nan",
            "geometry.length_m: NaN must lie in [0.001, 1000] m",
        ),
        (
            "length_m = {",
            "width_m3 = {",
            "geometry.width_m3: unknown key, must be one of length_m, fore_body_m",
        ),
        (
            "nacelle_m = { value = 6.096",
            "nacelle_m = { value = 26.096",
            "geometry.nacelle_m: 26.096 must lie between 0 and 16.154",
        ),
        (
            "nozzle_area_ratio = { value = 6.35",
            "nozzle_area_ratio = { value = 0.5",
            "engine.nozzle_area_ratio: 0.5 must lie in [1, 1000]",
        ),
    ] {
        let message = refused(from, to);
        assert!(message.starts_with("mine.toml: ") && message.contains(told), "{message}");
    }
}

/// Every number of a file, each of a list by itself, in place of another: key and new text.
fn with_each_number(text: &str, new: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut edited = Vec::new();
    let mut table = String::new();
    for (at, line) in lines.iter().enumerate() {
        if let Some(name) = line.strip_prefix('[') {
            table = name.trim_matches(['[', ']']).to_string();
        }
        if let Some(name) = line.strip_prefix("name = ") {
            table = format!("tank.{}", name.trim_matches('"'));
        }
        let Some((key, rest)) = line.split_once(" = { value = ") else { continue };
        let (numbers, rest) = rest.split_once(", unit").expect("a number with a unit");
        let list = numbers.starts_with('[');
        let numbers: Vec<&str> = numbers.trim_matches(['[', ']']).split(", ").collect();
        for i in 0..numbers.len() {
            let mut numbers = numbers.clone();
            numbers[i] = new;
            let numbers = numbers.join(", ");
            let numbers = if list { format!("[{numbers}]") } else { numbers };
            let mut lines: Vec<String> = lines.iter().map(|line| line.to_string()).collect();
            lines[at] = format!("{key} = {{ value = {numbers}, unit{rest}");
            edited.push((format!("{table}.{key}"), lines.join("\n")));
        }
    }
    edited
}

#[test]
fn verif_no_number_may_be_absurd() {
    type Parse = fn(&str) -> Result<(), Error>;
    let vehicle: Parse = |text| VehicleData::parse("mine.toml", text).map(drop);
    let earth: Parse = |text| EarthData::parse("mine.toml", text).map(drop);
    let air: Parse = |text| AeroData::parse("mine.toml", text).map(drop);
    for (file, parse) in [
        (VEHICLE, vehicle),
        (EARTH, earth),
        (XU2015, air),
        (PARKER2007, air),
        (SHOCK_EXPANSION, air),
    ] {
        let mut count = 0;
        for_each_number(&file.text.parse().unwrap(), "", &mut |_, number| {
            count += number["value"].as_array().map_or(1, Vec::len);
        });
        for new in ["nan", "inf", "-inf", "1e30", "-1e30"] {
            let edited = with_each_number(file.text, new);
            assert_eq!(edited.len(), count, "{}", file.name);
            for (key, text) in edited {
                let value = new.replace("nan", "NaN");
                let message = parse(&text).expect_err(&key).to_string();
                let told = format!("mine.toml: {key}: {value} must lie in [");
                assert!(message.starts_with(&told), "{new}: {message}");
            }
        }
    }
}

#[test]
fn verif_a_trim_without_numbers_fails_at_once_and_says_so() {
    let mut data = Data::embedded().unwrap();
    data.xu2015.lift.alpha.as_mut().unwrap().value = f64::NAN;
    let options = Parameters::new(&data).options;
    let vehicle =
        Vehicle::new(&data, &VehicleOptions { configuration: Configuration::Rigid, ..options });
    let error = trim(&vehicle.unwrap(), &options.condition).unwrap_err();
    assert!(matches!(error, Error::NotFinite { .. }), "{error}");
    assert!(error.to_string().contains("no finite accelerations at Mach 8, altitude 25900 m"));
}

#[test]
fn verif_a_syntax_error_names_the_line() {
    let message = refused("[mass]", "[mass");
    let line = VEHICLE.text.lines().position(|line| line == "[mass]").unwrap() + 1;
    assert!(message.contains(&format!("line {line}")), "{message}");
}

#[test]
fn verif_wrong_air_and_coefficients_are_refused() {
    let text = EARTH.text.replacen("11000.0", "31000.0", 1);
    let message = EarthData::parse("earth.toml", &text).unwrap_err().to_string();
    assert!(message.contains("air.layer_base_m"), "{message}");
    let text = PARKER2007.text.replacen("mach = { value = [6.0", "mach = { value = [16.0", 1);
    let message = AeroData::parse("aero.toml", &text).unwrap_err().to_string();
    assert!(message.contains("envelope.mach: [16.0, 11.0] must increase"), "{message}");
}

#[test]
fn verif_a_choking_margin_is_a_plain_number_between_minus_one_and_one() {
    let margin = "choking_margin = { value = 0.0, unit = \"1\"";
    assert!(SHOCK_EXPANSION.text.contains(margin));
    let with = |value: &str, unit: &str| {
        let new = format!("choking_margin = {{ value = {value}, unit = \"{unit}\"");
        AeroData::parse("aero.toml", &SHOCK_EXPANSION.text.replacen(margin, &new, 1))
    };
    for value in ["-1.0", "0.05", "1.0"] {
        let read = with(value, "1").unwrap().envelope.choking_margin.unwrap();
        assert_eq!(read.value, value.parse().unwrap());
    }
    for (value, unit, told) in [
        ("-1.5", "1", "envelope.choking_margin: -1.5 must lie in [-1, 1]"),
        ("1.01", "1", "envelope.choking_margin: 1.01 must lie in"),
        ("nan", "1", "envelope.choking_margin: NaN must lie in"),
        ("inf", "1", "envelope.choking_margin: inf must lie in"),
        ("0.0", "rad", "envelope.choking_margin: the unit is rad, must be 1"),
    ] {
        let message = with(value, unit).unwrap_err().to_string();
        assert!(message.contains(told), "{message}");
    }
    for set in [XU2015, PARKER2007] {
        assert!(
            AeroData::embedded(&set).unwrap().envelope.choking_margin.is_none(),
            "{}",
            set.name
        );
    }
}
