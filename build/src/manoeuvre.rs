//! Inputs over time, from a CSV file. They are linear between rows; a jump is two rows with the
//! same time, the values before and after it. The first and last rows hold outside their times. FMPy and other
//! masters interpolate continuous inputs in the same way.

mod columns;
mod rows;
mod text;

use crate::model_description::{ModelDescription, Variable};
use crate::workspace::{MAX_TEXT_BYTES, read, shown};
use anyhow::Result;
use std::path::Path;

/// Inputs of a flight over time.
#[derive(Debug)]
pub struct Manoeuvre<'a> {
    pub inputs: Vec<&'a Variable>,
    /// Times do not decrease; at most two rows have the same time.
    pub rows: Vec<Row>,
    /// Names of columns that are not inputs of the FMU.
    pub ignored: Vec<String>,
}

/// A line of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Time, s.
    pub time: f64,
    /// Values of all inputs, in the units of the FMU.
    pub values: Vec<f64>,
}

/// Inputs at an instant, with their slopes until the next row.
#[derive(Debug, PartialEq)]
pub struct Interpolated {
    pub values: Vec<f64>,
    /// Slopes, input units per s.
    pub slopes: Vec<f64>,
}

impl<'a> Manoeuvre<'a> {
    /// Reads a file.
    pub fn read(path: &Path, model: &'a ModelDescription) -> Result<Self> {
        Self::parse(&read(path, MAX_TEXT_BYTES)?, &shown(path), model)
    }

    /// Reads the bytes of a file; `file` is its name in messages.
    pub fn parse(bytes: &[u8], file: &str, model: &'a ModelDescription) -> Result<Self> {
        rows::parse(&text::decode(bytes, file)?, file, model)
    }

    /// Times of the rows, s.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.rows.iter().map(|row| row.time)
    }

    /// The values at an instant, before a jump. `None` without rows.
    pub fn before(&self, time: f64) -> Option<Vec<f64>> {
        let next = self.rows.partition_point(|row| row.time < time);
        match self.rows.get(next) {
            Some(row) if row.time == time => Some(row.values.clone()),
            _ => self.after(time).map(|course| course.values),
        }
    }

    /// The values at an instant, after a jump, and their slopes. `None` without rows.
    pub fn after(&self, time: f64) -> Option<Interpolated> {
        let next = self.rows.partition_point(|row| row.time <= time);
        let (last, next) = match (next.checked_sub(1), self.rows.get(next)) {
            (Some(last), Some(next)) => (&self.rows[last], next),
            (last, next) => {
                let values = last.map(|last| &self.rows[last]).or(next)?.values.clone();
                return Some(Interpolated { slopes: vec![0.0; values.len()], values });
            }
        };
        let change = |(a, b): (&f64, &f64)| (b - a) / (next.time - last.time);
        let slopes: Vec<_> = last.values.iter().zip(&next.values).map(change).collect();
        let value = |(a, slope): (&f64, &f64)| a + slope * (time - last.time);
        let values = last.values.iter().zip(&slopes).map(value).collect();
        Some(Interpolated { values, slopes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(time: f64, value: f64) -> Row {
        Row { time, values: vec![value] }
    }

    #[test]
    fn inputs_are_linear_between_rows_jump_at_doubled_rows_and_hold_outside() {
        let rows = vec![row(1.0, 2.0), row(3.0, 6.0), row(3.0, -1.0), row(4.0, -1.0)];
        let manoeuvre = Manoeuvre { inputs: Vec::new(), rows, ignored: Vec::new() };
        let before = |time| manoeuvre.before(time).unwrap()[0];
        let after = |time| manoeuvre.after(time).map(|course| (course.values[0], course.slopes[0]));
        assert_eq!((before(0.0), after(0.0)), (2.0, Some((2.0, 0.0))));
        assert_eq!((before(1.0), after(1.0)), (2.0, Some((2.0, 2.0))));
        assert_eq!((before(1.5), after(1.5)), (3.0, Some((3.0, 2.0))));
        assert_eq!((before(3.0), after(3.0)), (6.0, Some((-1.0, 0.0))));
        assert_eq!((before(9.0), after(9.0)), (-1.0, Some((-1.0, 0.0))));
        let empty = Manoeuvre { inputs: Vec::new(), rows: Vec::new(), ignored: Vec::new() };
        assert_eq!((empty.before(0.0), empty.after(0.0)), (None, None));
    }
}
