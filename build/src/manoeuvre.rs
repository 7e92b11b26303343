//! Inputs over time, from a CSV file. A value holds from its time on until the next line.

use crate::model_description::{Causality, ModelDescription, Variable};
use crate::settings::suggest;
use crate::workspace::{TEXT, read_text, shown};
use anyhow::{Result, bail};
use std::path::Path;

/// What the pilot does.
#[derive(Debug)]
pub struct Manoeuvre<'a> {
    pub inputs: Vec<&'a Variable>,
    /// Time (s) and the values of all inputs from then on, in the inputs' units.
    pub changes: Vec<(f64, Vec<f64>)>,
}

/// A column: the input (none for the time), and how its numbers become those of the FMU.
struct Column<'t, 'a> {
    name: &'t str,
    input: Option<&'a Variable>,
    factor: f64,
    offset: f64,
}

impl<'a> Manoeuvre<'a> {
    /// Reads a file.
    pub fn read(path: &Path, model: &'a ModelDescription) -> Result<Self> {
        Self::parse(&read_text(path, TEXT)?, &shown(path), model)
    }

    /// Reads a text; `file` is its name in messages. Empty lines and those that start with `#`
    /// count for nothing.
    pub fn parse(text: &str, file: &str, model: &'a ModelDescription) -> Result<Self> {
        let mut lines = text
            .lines()
            .zip(1..)
            .map(|(line, number)| (line.trim(), number))
            .filter(|(line, _)| !line.is_empty() && !line.starts_with('#'));
        let Some((header, number)) = lines.next() else {
            bail!("{file}: no header; the first line has to be like `{}`", example(model));
        };
        let columns = columns(header, &format!("{file}, line {number}"), model)?;
        let inputs = columns.iter().filter_map(|column| column.input).collect();
        let mut changes: Vec<(f64, Vec<f64>)> = Vec::new();
        for (line, number) in lines {
            let at = format!("{file}, line {number}");
            let (time, values) = change(line, &at, &columns)?;
            match changes.last() {
                Some((before, _)) if time <= *before => bail!(
                    "{at}, column time: {time} s does not follow {before} s; times have to increase"
                ),
                None if time < 0.0 => {
                    bail!("{at}, column time: {time} s is before the start of the flight at 0 s")
                }
                _ => changes.push((time, values)),
            }
        }
        Ok(Self { inputs, changes })
    }

    /// The values that hold at a time; none before the first line.
    pub fn at(&self, time: f64) -> Option<&[f64]> {
        let next = self.changes.partition_point(|(change, _)| *change <= time);
        next.checked_sub(1).map(|last| self.changes[last].1.as_slice())
    }
}

/// What a header looks like.
fn example(model: &ModelDescription) -> String {
    let inputs = model.with(Causality::Input).map(|input| format!(",{}", input.name));
    format!("time{}", inputs.collect::<String>())
}

fn columns<'t, 'a>(
    header: &'t str,
    at: &str,
    model: &'a ModelDescription,
) -> Result<Vec<Column<'t, 'a>>> {
    let mut columns: Vec<Column> = Vec::new();
    for title in header.split(',').map(str::trim) {
        let (name, unit) = match title.strip_suffix(']').and_then(|title| title.split_once('[')) {
            Some((name, unit)) => (name.trim(), Some(unit.trim())),
            None => (title, None),
        };
        if columns.iter().any(|known| known.name == name) {
            bail!("{at}: column {name} is there twice");
        }
        if columns.is_empty() {
            if name != "time" || unit.is_some_and(|unit| unit != "s") {
                bail!("{at}: the first column is `{title}`; `{}` is expected", example(model));
            }
            columns.push(Column { name, input: None, factor: 1.0, offset: 0.0 });
            continue;
        }
        let Some(input) = model.with(Causality::Input).find(|input| input.name == name) else {
            let inputs = model.with(Causality::Input).map(|input| input.name.as_str());
            bail!("{at}: there is no input `{name}`; {}", suggest(name, inputs));
        };
        let display = model.display(input);
        let (factor, offset) = match unit {
            None => (1.0, 0.0),
            Some(unit) if unit == input.unit() => (1.0, 0.0),
            Some(unit) if unit == display.name => (display.factor, display.offset),
            Some(unit) => bail!(
                "{at}, column {name}: unit `{unit}` is unknown; {} or {} is expected",
                input.unit(),
                display.name
            ),
        };
        columns.push(Column { name, input: Some(input), factor, offset });
    }
    Ok(columns)
}

fn change(line: &str, at: &str, columns: &[Column]) -> Result<(f64, Vec<f64>)> {
    let fields: Vec<_> = line.split(',').map(str::trim).collect();
    if fields.len() != columns.len() {
        let names: Vec<_> = columns.iter().map(|column| column.name).collect();
        bail!(
            "{at}: {} values where the header names {} columns ({})",
            fields.len(),
            columns.len(),
            names.join(", ")
        );
    }
    let mut values = Vec::new();
    for (field, column) in fields.into_iter().zip(columns) {
        match field.parse::<f64>() {
            Ok(number) if number.is_finite() => {
                values.push((number - column.offset) / column.factor)
            }
            _ => bail!("{at}, column {}: `{field}` is not a finite number", column.name),
        }
    }
    let time = values.remove(0);
    Ok((time, values))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model() -> ModelDescription {
        ModelDescription::parse(&crate::describe::xml().unwrap()).unwrap()
    }

    #[test]
    fn values_hold_from_their_time_on_and_degrees_become_radians() {
        let model = model();
        let text = "# doublet\ntime, delta_e[deg]\n\n0.1, 1.0\n0.3, -1.0\n";
        let manoeuvre = Manoeuvre::parse(text, "a.csv", &model).unwrap();
        assert_eq!(manoeuvre.at(0.0999), None);
        assert!((manoeuvre.at(0.1).unwrap()[0] - 1f64.to_radians()).abs() < 1e-15);
        assert!((manoeuvre.at(9.0).unwrap()[0] + 1f64.to_radians()).abs() < 1e-15);
    }

    #[test]
    fn refusals_name_file_line_and_column() {
        let model = model();
        for (text, expected) in [
            ("", "a.csv: no header"),
            ("t,phi\n", "a.csv, line 1: the first column is `t`"),
            ("time,delta\n", "line 1: there is no input `delta`; did you mean delta_e?"),
            ("time,V\n", "line 1: there is no input `V`; choose from delta_e, phi"),
            ("time,phi,phi\n", "line 1: column phi is there twice"),
            ("time,delta_e[grad]\n", "column delta_e: unit `grad` is unknown; rad or deg"),
            ("time,phi\n0,1,2\n", "line 2: 3 values where the header names 2 columns (time, phi)"),
            ("time,phi\n0,1\n1,x\n", "a.csv, line 3, column phi: `x` is not a finite number"),
            ("time,phi\n0,inf\n", "line 2, column phi: `inf` is not a finite number"),
            ("time,phi\n1,0\n#\n0.5,0\n", "line 4, column time: 0.5 s does not follow 1 s"),
            ("time,phi\n-1,0\n", "line 2, column time: -1 s is before the start"),
        ] {
            let message = Manoeuvre::parse(text, "a.csv", &model).unwrap_err().to_string();
            assert!(message.contains(expected), "{text:?} gave: {message}");
        }
    }
}
