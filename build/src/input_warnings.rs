//! Warnings about input files that are valid but probably not what the user meant.

use crate::manoeuvre::Manoeuvre;
use ahv::short::short;

/// One line per warning; `file` is the name of the input file, `stop` the end of the flight, s.
pub fn input_warnings(manoeuvre: &Manoeuvre, file: &str, stop: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    if !manoeuvre.ignored.is_empty() {
        let names = manoeuvre.ignored.join(", ");
        warnings.push(format!("{file}: these columns are not inputs and are ignored: {names}"));
    }
    if manoeuvre.inputs.is_empty() {
        warnings.push(format!("{file} has no input column: all inputs stay zero"));
        return warnings;
    }
    let (Some(first), Some(last)) = (manoeuvre.rows.first(), manoeuvre.rows.last()) else {
        warnings.push(format!("{file} has no row below the header: all inputs stay zero"));
        return warnings;
    };
    let (start, end) = (first.time, last.time);
    let [from, to, until] = [start, end, stop].map(short);
    if start >= stop {
        warnings.push(format!(
            "{file} starts at {from} s, after the end of the flight at {until} s: its first values \
             hold throughout; fly longer with --stop"
        ));
    } else if start > 0.0 && first.values.iter().any(|value| *value != 0.0) {
        warnings.push(format!(
            "{file} starts at {from} s: its first values hold from 0 s on; add a row at 0 s for \
             other values"
        ));
    }
    if start < stop && end > stop {
        warnings.push(format!(
            "{file} ends at {to} s, after the flight at {until} s; fly longer with --stop"
        ));
    }
    if end < 0.0 {
        warnings
            .push(format!("{file} ends at {to} s, before the flight starts: its last values hold"));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model_description::ModelDescription;

    #[test]
    fn a_suspicious_file_gives_one_warning() {
        let model = ModelDescription::parse(
            &crate::describe::committed(
                &crate::models::VEHICLE,
                fmi_model::standard::Standard::Fmi2,
            )
            .unwrap(),
        )
        .unwrap();
        for (text, expected) in [
            ("time,phi\n0,0\n1,1\n", ""),
            ("time,phi\n1,0\n2,1\n", ""),
            ("time,phi\n", "a.csv has no row below the header: all inputs stay zero"),
            ("time\n0\n", "a.csv has no input column"),
            ("time,phi,V,mach\n0,0,1,2\n", "these columns are not inputs and are ignored: V, mach"),
            ("time,phi\n2,1\n", "a.csv starts at 2 s, after the end of the flight at 2 s"),
            ("time,phi\n1,1\n", "a.csv starts at 1 s: its first values hold from 0 s on"),
            ("time,phi\n0,1\n3,1\n", "a.csv ends at 3 s, after the flight at 2 s"),
            ("time,phi\n-2,1\n-1,1\n", "a.csv ends at -1 s, before the flight"),
        ] {
            let manoeuvre = Manoeuvre::parse(text.as_bytes(), "a.csv", &model).unwrap();
            let warnings = input_warnings(&manoeuvre, "a.csv", 2.0);
            assert_eq!(
                warnings.len(),
                usize::from(!expected.is_empty()),
                "{text:?} gave: {warnings:?}"
            );
            assert!(warnings.concat().contains(expected), "{text:?} gave: {warnings:?}");
        }
    }
}
