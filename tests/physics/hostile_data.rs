//! Data files that are damaged or made to do harm: none panics, and what is read is what TOML says.

use ahv::data::{AeroData, DataFile, PARKER2007, VEHICLE, VehicleData};
use proptest::prelude::*;
use toml::{Table, Value};

/// The numbers of a file, as the crate toml reads them, by their keys.
fn numbers(table: &Table, path: &str, found: &mut Vec<(String, f64)>) {
    for (key, value) in table {
        let path = format!("{path}.{key}");
        match value {
            Value::Table(number) if number.contains_key("value") => {
                let value = &number["value"];
                let all = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
                let float = |v: &Value| v.as_float().or(v.as_integer().map(|whole| whole as f64));
                found.extend(all.iter().map(|v| (path.clone(), float(v).expect("a number"))));
            }
            Value::Table(inner) => numbers(inner, &path, found),
            Value::Array(rows) => rows.iter().for_each(|row| {
                numbers(row.as_table().expect("a table"), &path, found);
            }),
            _ => {}
        }
    }
}

/// A file that is read has the numbers that TOML says, and is TOML.
fn agrees_with_toml<T: DataFile>(text: &str) {
    let Ok((_, packed)) = T::parse_and_pack("mine.toml", text) else { return };
    let table: Table = text.trim_start_matches('\u{feff}').parse().expect("it is TOML, too");
    let mut found = Vec::new();
    numbers(&table, "", &mut found);
    for (key, number) in found {
        let bytes = number.to_le_bytes();
        assert!(packed.windows(8).any(|window| window == bytes), "{key} = {number}");
    }
}

#[test]
fn verif_what_is_read_of_our_files_is_what_toml_says() {
    agrees_with_toml::<VehicleData>(VEHICLE.text);
    agrees_with_toml::<AeroData>(PARKER2007.text);
    for numbers in ["1_000.5e-1_0", "+0.5", "-0.0", "1e-3", "17976931348623157e-300", "0.1", "3"] {
        let text = PARKER2007.text.replacen("value = 0.0", &format!("value = {numbers}"), 1);
        agrees_with_toml::<AeroData>(&text);
    }
}

#[test]
fn verif_files_are_written_in_many_ways_and_say_the_same() {
    let (_, packed) = VehicleData::parse_and_pack("vehicle.toml", VEHICLE.text).unwrap();
    let text = VEHICLE.text;
    for same in [
        text.replace('\n', "\r\n"),
        format!("\u{feff}{text}"),
        text.replace(" = { value = ", "={value=").replace("\" }", "\"}"),
        text.replace("{ value", "{ # first\n  value").replace("\" }", "\",\n}  # last\n"),
        text.replace("[[tank]]", "[[ tank ]] # next"),
        text.replace("source = \"", "source = \"\\u00e9 \\\\ \\\" "),
        text.trim_end().to_string(),
    ] {
        let (_, again) = VehicleData::parse_and_pack("mine.toml", &same).unwrap();
        assert_eq!(again, packed, "{same}");
        agrees_with_toml::<VehicleData>(&same);
    }
}

#[test]
fn verif_what_is_not_read_of_toml_is_refused_with_its_line() {
    for (line, told) in [
        ("geometry.length_m = 1", "= is expected"),
        ("\"geometry\" = 1", "a key of letters"),
        ("x = \"\"\"a\"\"\"", "end of the line"),
        ("x = true", "true is no number"),
        ("x = 1979-05-27", "1979-05-27 is no number"),
        ("x = 0x10", "0x10 is no number"),
        ("x = 01", "01 is no number"),
        ("x = 1.", "1. is no number"),
        ("x = 1__0", "no number"),
        ("x = \"\\q\"", "a backslash"),
        ("x = \"\\ud800\"", "an escape"),
        ("x = 'a", "no end on its line"),
        ("x = [1, 2", ", or ] is expected"),
        ("x = {a = 1, a = 2}", "a is there twice"),
        ("x = 1 y = 2", "end of the line"),
        ("# \u{1}", "control character"),
        ("[geometry.inner]", "] is expected"),
    ] {
        let text = format!("\n\n{line}\n{}", VEHICLE.text);
        let message = VehicleData::parse("mine.toml", &text).unwrap_err().to_string();
        assert!(message.contains(told), "{line}: {message}");
        let at = if line.ends_with("[1, 2") { "mine.toml: line " } else { "mine.toml: line 3: " };
        assert!(message.starts_with(at), "{line}: {message}");
    }
    for twice in ["[mass]", "[[tank]]\nname = \"third\""] {
        let text = format!("{}\n{twice}\n", VEHICLE.text);
        assert!(VehicleData::parse("mine.toml", &text).is_err(), "{twice}");
    }
}

#[test]
fn verif_bombs_are_refused_at_once() {
    let many = format!("x = [{}]", "0,".repeat(400_000));
    let keys: String = (0..100_000).map(|i| format!("k{i}=1\n")).collect();
    for (bomb, told) in [
        ("x = ".to_string() + &"[".repeat(900_000), "stand in each other"),
        ("x = ".to_string() + &"{a=".repeat(300_000), "stand in each other"),
        (many, "more than 10000 values"),
        (keys, "more than 10000 values"),
        ("[[a]]\n".repeat(150_000), "more than 10000 values"),
        ("#".repeat(900_000), "geometry: is missing"),
        (format!("x = \"{}\"", "a".repeat(900_000)), "x: unknown key"),
        (format!("x = {}", "9".repeat(900_000)), "is no number"),
    ] {
        let message = VehicleData::parse("mine.toml", &bomb).unwrap_err().to_string();
        assert!(message.contains(told), "{told}: {}", &message[..200.min(message.len())]);
    }
}

#[test]
fn verif_a_file_that_ends_early_is_refused_or_read_alike() {
    for end in (0..VEHICLE.text.len()).filter(|end| VEHICLE.text.is_char_boundary(*end)) {
        let cut = &VEHICLE.text[..end];
        let read = VehicleData::parse("mine.toml", cut);
        assert!(read.is_err() || VEHICLE.text[end..].trim().is_empty(), "{end}");
    }
    for end in 0..VEHICLE.packed.len() {
        assert!(VehicleData::unpack("packed", &VEHICLE.packed[..end]).is_err(), "{end}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn verif_no_text_panics(text in "\\PC{0,200}", toml in "[\\[\\]{}=\",.#a-z0-9_ \n'+-]{0,200}") {
        let _ = VehicleData::parse("mine.toml", &text);
        let _ = VehicleData::parse("mine.toml", &toml);
    }

    #[test]
    fn verif_a_damaged_file_is_refused_or_read_as_toml_reads_it(
        edits in prop::collection::vec((0.0..1.0_f64, 0..4_usize, "[\\[\\]{}=\",.#a-z0-9_ \n'+-]{1,2}"), 1..3),
    ) {
        let mut text = VEHICLE.text.to_string();
        for (place, drop, add) in edits {
            let at = (place * text.len() as f64) as usize;
            if text.is_char_boundary(at) && text.is_char_boundary((at + drop).min(text.len())) {
                text.replace_range(at..(at + drop).min(text.len()), &add);
            }
        }
        agrees_with_toml::<VehicleData>(&text);
    }

    #[test]
    fn verif_packed_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let _ = VehicleData::unpack("packed", &bytes);
        let _ = AeroData::unpack("packed", &bytes);
    }
}
