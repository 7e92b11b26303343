//! The time history of a flight.

use anyhow::Result;
use std::fmt::Write;

/// Rows are communication points, columns are variables; the first column is the time.
#[derive(Debug)]
pub struct Record {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Record {
    /// Position of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Values of a column over time.
    pub fn values(&self, column: usize) -> impl Iterator<Item = f64> {
        self.rows.iter().map(move |row| row[column])
    }

    /// CSV with a header of names. Every number can be read back exactly.
    pub fn csv(&self) -> Result<String> {
        let mut text = self.names.join(",");
        text.push('\n');
        for row in &self.rows {
            for (column, value) in row.iter().enumerate() {
                let comma = if column == 0 { "" } else { "," };
                write!(text, "{comma}{value:?}")?;
            }
            text.push('\n');
        }
        Ok(text)
    }

    /// The largest deviation of a column from its first value, and when it happens.
    pub fn largest_deviation(&self, column: usize) -> (f64, f64) {
        let Some(first) = self.rows.first() else { return (0.0, 0.0) };
        self.rows.iter().map(|row| (row[column] - first[column], row[0])).fold(
            (0.0, first[0]),
            |largest, next| if next.0.abs() > largest.0.abs() { next } else { largest },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_reads_back_bit_for_bit() {
        let row = vec![0.1, 1.0 / 3.0, -2.5e-17, 25900.0];
        let names = ["time", "a", "b", "c"].map(String::from).to_vec();
        let csv = Record { names, rows: vec![row.clone()] }.csv().unwrap();
        let line = csv.lines().nth(1).unwrap();
        let back: Vec<f64> = line.split(',').map(|value| value.parse().unwrap()).collect();
        assert_eq!(back, row);
    }

    #[test]
    fn largest_deviation_keeps_its_sign_and_time() {
        let names = vec!["time".to_string(), "a".to_string()];
        let rows = vec![vec![0.0, 1.0], vec![1.0, -3.0], vec![2.0, 2.0]];
        assert_eq!(Record { names, rows }.largest_deviation(1), (-4.0, 1.0));
    }
}
