//! What is legal and probably not meant.

use crate::manoeuvre::Manoeuvre;
use ahv::short::short;

/// A line for each; `file` is the manoeuvre's, `stop` the end of the flight, s.
pub fn input_warnings(manoeuvre: &Manoeuvre, file: &str, stop: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    if !manoeuvre.ignored.is_empty() {
        let names = manoeuvre.ignored.join(", ");
        warnings.push(format!("{file}: these columns are no inputs and are not read: {names}"));
    }
    if manoeuvre.inputs.is_empty() {
        warnings.push(format!("{file} has no column of an input: all inputs stay zero"));
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
             hold all the time; fly longer with --stop"
        ));
    } else if start > 0.0 && first.values.iter().any(|value| *value != 0.0) {
        warnings.push(format!(
            "{file} starts at {from} s: its first values hold from 0 s on; for others put a row \
             there"
        ));
    }
    if start < stop && end > stop {
        warnings.push(format!(
            "{file} goes on to {to} s, the flight ends at {until} s; fly longer with --stop"
        ));
    }
    if end < 0.0 {
        warnings.push(format!("{file} ends at {to} s, before the flight: its last values hold"));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model_description::ModelDescription;

    #[test]
    fn what_is_probably_not_meant_is_said_in_a_line() {
        let model = ModelDescription::parse(&crate::describe::xml().unwrap()).unwrap();
        for (text, expected) in [
            ("time,phi\n0,0\n1,1\n", ""),
            ("time,phi\n1,0\n2,1\n", ""),
            ("time,phi\n", "a.csv has no row below the header: all inputs stay zero"),
            ("time\n0\n", "a.csv has no column of an input"),
            ("time,phi,V,mach\n0,0,1,2\n", "these columns are no inputs and are not read: V, mach"),
            ("time,phi\n2,1\n", "a.csv starts at 2 s, after the end of the flight at 2 s"),
            ("time,phi\n1,1\n", "a.csv starts at 1 s: its first values hold from 0 s on"),
            ("time,phi\n0,1\n3,1\n", "a.csv goes on to 3 s, the flight ends at 2 s"),
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
