//! The rows of an input file.

use super::columns::{Column, Role, columns, example};
use super::{Manoeuvre, Row};
use crate::model_description::{ModelDescription, Variable};
use ahv::short::short;
use anyhow::{Context, Result, bail};

/// Longest part of a field quoted in a message, characters.
const MAX_QUOTED_CHARACTERS: usize = 40;

/// Parses the text of an input file; `file` is its name in messages. Empty lines and lines that start with
/// `#` are ignored.
pub fn parse<'a>(text: &str, file: &str, model: &'a ModelDescription) -> Result<Manoeuvre<'a>> {
    let text = text.replace("\r\n", "\n");
    let counts = |line: &str| !line.trim_matches([' ', '\t', ',', ';']).is_empty();
    let (numbers, lines): (Vec<usize>, Vec<&str>) = (1..)
        .zip(text.split(['\n', '\r']))
        .filter(|(_, line)| counts(line) && !line.trim_start().starts_with('#'))
        .unzip();
    let Some(header) = lines.first() else {
        bail!("{file}: no header; the first line must be a header such as `{}`", example(model));
    };
    let joined = lines.join("\n");
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(delimiter(header))
        .trim(csv::Trim::All)
        .from_reader(joined.as_bytes());
    let mut records = reader.records().zip(numbers).map(|(record, number)| {
        let at = format!("{file}, line {number}");
        let record = record.with_context(|| at.clone())?;
        if record.iter().any(|field| field.contains('\n')) {
            bail!("{at}: a quotation decimal_mark opens and is not closed on this line");
        }
        Ok((record, at))
    });
    let Some(first) = records.next() else { bail!("{file}: no header") };
    let (header, at) = first?;
    let columns = columns(header.iter(), &at, model)?;

    let inputs = columns.iter().filter_map(|column| match column.role {
        Role::Input { variable, .. } => Some(variable),
        _ => None,
    });
    let inputs: Vec<_> = inputs.collect();
    let mut rows: Vec<Row> = Vec::new();
    let mut decimal_mark = None;
    for record in records {
        let (record, at) = record?;
        let row = row(&record, &at, &columns, &mut decimal_mark)?;
        check_sequence(&row, &rows, &inputs, &at)?;
        rows.push(row);
    }
    let ignored = columns.iter().filter(|column| matches!(column.role, Role::Ignored));
    let name = |column: &Column| match column.name.as_str() {
        "" => "one without a name".to_string(),
        name => name.to_string(),
    };
    Ok(Manoeuvre { inputs, rows, ignored: ignored.map(name).collect() })
}

/// The delimiter of a header: tab, semicolon or comma, whichever is most frequent outside quotes.
fn delimiter(header: &str) -> u8 {
    let count = |wanted: &u8| {
        let mut inside = false;
        let bytes = header.bytes().filter(|byte| {
            inside ^= *byte == b'"';
            !inside && byte == wanted
        });
        bytes.count()
    };
    // If several are equally frequent, `max_by_key` takes the last.
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}

/// Checks a row against the rows before it: times do not decrease, at most two rows have the same time, and
/// slopes are finite.
fn check_sequence(row: &Row, rows: &[Row], inputs: &[&Variable], at: &str) -> Result<()> {
    let time = row.time;
    match rows {
        [.., last] if time < last.time => bail!(
            "{at}, column time: {} s follows {} s; times must increase, or occur twice for a jump",
            short(time),
            short(last.time)
        ),
        [.., first, _] if time == first.time => bail!(
            "{at}, column time: a third row for {} s; a jump has two, the values before and after it",
            short(time)
        ),
        [.., last] if time > last.time => {
            let span = time - last.time;
            let mut changes = inputs.iter().zip(last.values.iter().zip(&row.values));
            // The slope over an infinite span would be zero.
            let lost =
                changes.find(|(_, (a, b))| !span.is_finite() || !((*b - *a) / span).is_finite());
            match lost {
                None => Ok(()),
                Some((input, _)) => bail!(
                    "{at}, column {}: the slope since the row for {} s is not finite: values or times \
                     are too far apart, or times too close; a jump is two rows with the same time",
                    input.name,
                    short(last.time)
                ),
            }
        }
        _ => Ok(()),
    }
}

/// Parses a row. `decimal_mark` is that of the file, once a number has shown it.
fn row(
    record: &csv::StringRecord,
    at: &str,
    columns: &[Column],
    decimal_mark: &mut Option<char>,
) -> Result<Row> {
    let beyond = record.iter().skip(columns.len()).any(|field| !field.is_empty());
    if record.len() < columns.len() || beyond {
        let names: Vec<_> = columns.iter().map(|column| column.name.as_str()).collect();
        let hint = match beyond {
            true => "; numbers with decimal commas need semicolons between them",
            false => "",
        };
        bail!(
            "{at}: {} values where the header names {} columns ({}){hint}",
            record.len(),
            columns.len(),
            names.join(", ")
        );
    }
    let mut time = 0.0;
    let mut values = Vec::new();
    for (field, column) in record.iter().zip(columns) {
        let number = |decimal_mark: &mut _| {
            let at = format!("{at}, column {}", column.name);
            number(field, decimal_mark).with_context(|| at)
        };
        match column.role {
            Role::Time => time = number(decimal_mark)?,
            Role::Input { variable, factor, offset } => {
                let value = (number(decimal_mark)? - offset) / factor;
                check_range(value, variable)
                    .with_context(|| format!("{at}, column {}", column.name))?;
                values.push(value);
            }
            Role::Ignored => {}
        }
    }
    Ok(Row { time, values })
}

/// Refuses a value at which the FMU would end the flight.
fn check_range(value: f64, variable: &Variable) -> Result<()> {
    let [min, max] = variable.range();
    if !(min..=max).contains(&value) {
        let [value, min, max] = [value, min, max].map(short);
        bail!("{value} {} is outside the range of the FMU, [{min}, {max}]", variable.unit());
    }
    Ok(())
}

fn number(field: &str, decimal_mark: &mut Option<char>) -> Result<f64> {
    if let Some(found) = field.chars().find(|c| matches!(c, '.' | ',')) {
        let known = *decimal_mark.get_or_insert(found);
        if known != found {
            bail!("`{field}` has a decimal `{found}`, earlier numbers have `{known}`");
        }
    }
    if field.is_empty() {
        bail!("the value is missing");
    }
    match field.replace(',', ".").parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => {
            let start: String = field.chars().take(MAX_QUOTED_CHARACTERS).collect();
            bail!("`{start}` is not a finite number")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model() -> ModelDescription {
        ModelDescription::parse(
            &crate::describe::committed(
                &crate::models::VEHICLE,
                fmi_model::standard::Standard::Fmi2,
            )
            .unwrap(),
        )
        .unwrap()
    }

    #[test]
    fn files_of_all_kinds_of_programs_say_the_same() {
        let model = model();
        let degree = 1f64.to_radians();
        for text in [
            "time,delta_e[deg],phi\n0,0,0\n0.5,0,0\n0.5,1,0.25\n",
            "\"time\",\"delta_e[deg]\",\"phi\"\r\n0,0,0\r\n0.5,0,0\r\n\r\n\"0.5\",1,0.25",
            "time;delta_e[deg];phi\n0;0;0\n0,5;0;0\n0,5;1;0,25\n",
            "Time [s]\tdelta_e [deg]\tphi\n0\t0\t0\n0.5\t0\t0\n0.5\t1\t0.25\n",
            "time,delta_e[deg],phi,\n0,0,0,\n0.5,0,0,\n0.5,1,0.25,\n",
            "phi,delta_e[deg],time\n0,0,0\n0,0,0.5\n0.25,1,5e-1\n",
            "# a; b\ntime , delta_e[deg] , phi\n#\n0,0,0\n  # c\n0.5,0,0\n \n,,\n0.5,1,0.25\n",
            ",time,V,delta_e[deg],phi\n0,0,7,0,0\n1,0.5,NaN,0,0\n2,0.5,,1,0.25\n",
            "time,phi,delta_e[deg]\r0,0,0\r0.5,0,0\r0.5,0.25,1\r",
        ] {
            let read = parse(text, "a.csv", &model).unwrap();
            let column = |name: &str| read.inputs.iter().position(|i| i.name == name).unwrap();
            let (delta_e, phi) = (column("delta_e"), column("phi"));
            let rows: Vec<_> =
                read.rows.iter().map(|r| (r.time, r.values[delta_e], r.values[phi])).collect();
            assert_eq!(rows[..2], [(0.0, 0.0, 0.0), (0.5, 0.0, 0.0)], "{text:?}");
            assert_eq!((rows[2].0, rows[2].2, rows.len()), (0.5, 0.25, 3), "{text:?}");
            assert!((rows[2].1 - degree).abs() < 1e-15, "{text:?}");
            let ignored: &[&str] =
                if text.contains('V') { &["one without a name", "V"] } else { &[] };
            assert_eq!(read.ignored, ignored, "{text:?}");
        }
    }

    #[test]
    fn refusals_name_file_line_and_column() {
        let model = model();
        for (text, expected) in [
            ("", "a.csv: no header; the first line must be a header such as `time,delta_e,phi"),
            ("\n# time,phi\n", "a.csv: no header"),
            ("t,phi\n", "a.csv, line 1: there is no input `t`"),
            ("phi\n1\n", "a.csv, line 1: there is no column `time`"),
            ("0,1\n1,1\n", "a.csv, line 1: numbers instead of column names"),
            ("# time;phi\n0,5;1\n", "a.csv, line 2: numbers instead of column names"),
            ("time,delta\n", "line 1: there is no input `delta`; did you mean delta_e?"),
            ("time,mach0\n", "line 1: mach0 is a parameter, which does not change in flight"),
            ("time,phi,phi\n", "line 1: there are two columns phi"),
            ("time,Time\n", "line 1: there are two columns time"),
            ("time[ms],phi\n", "column time: unit `ms` is unknown; s is expected"),
            ("time,delta_e[grad]\n", "column delta_e: unit `grad` is unknown; rad or deg"),
            ("time,phi[%]\n", "column phi: unit `%` is unknown; 1 is expected"),
            ("time,phi\n0,1,2\n", "line 2: 3 values where the header names 2 columns (time, phi)"),
            ("time,phi\n0\n", "line 2: 1 values where the header names 2 columns (time, phi)"),
            ("time,phi\n0,1,5\n", "numbers with decimal commas need semicolons"),
            ("time,phi\n0,1\n1,x\n", "a.csv, line 3, column phi: `x` is not a finite number"),
            ("time,phi\r\n\r\n0,\r\n", "a.csv, line 3, column phi: the value is missing"),
            ("time,phi\n0,inf\n", "line 2, column phi: `inf` is not a finite number"),
            ("time,phi\n0,NaN\n", "line 2, column phi: `NaN` is not a finite number"),
            (
                "time;phi\n0;0.5\n1;1,5\n",
                "line 3, column phi: `1,5` has a decimal `,`, earlier numbers",
            ),
            ("time;phi\n0;1.000,5\n", "line 2, column phi: `1.000,5` is not a finite number"),
            ("time,phi\n0,\"1\n2,3\n", "line 2: a quotation decimal_mark opens and is not closed"),
            ("time,phi\n1,0\n#\n0.5,0\n", "line 4, column time: 0.5 s follows 1 s"),
            ("time,w_gust\n0,0\n1,201\n", "line 3, column w_gust: 201 m/s is outside the range"),
            ("time,w_gust\n0,-1e200\n", "-1e200 m/s is outside the range of the FMU, [-200, 200]"),
            ("time,delta_e,phi\n0,0,0\n1,0,1e308\n2,0,-1e308\n", "line 4, column phi: the slope"),
            ("time,phi\n0,0\n5e-324,1\n", "the slope since the row for 0 s is not finite"),
            ("time,phi\n-1e308,0\n1e308,0\n", "line 3, column phi: the slope since the row for"),
            ("time,phi\n1,0\n1,1\n1,2\n", "line 4, column time: a third row for 1 s"),
        ] {
            let error = parse(text, "a.csv", &model).unwrap_err();
            let message = format!("{error:#}");
            assert!(message.contains(expected), "{text:?} gave: {message}");
        }
    }
}
