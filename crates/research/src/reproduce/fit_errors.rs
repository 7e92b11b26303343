//! Errors of the fit `shock_expansion`, read from the header of its data file.

use ahv::data::SHOCK_EXPANSION;
use anyhow::{Result, anyhow};
use serde::Serialize;

/// The table of errors that `cargo ahv fit` wrote.
#[derive(Debug, Clone, Serialize)]
pub struct FitErrors {
    /// Sampling grid of the model.
    pub samples: String,
    pub coefficients: Vec<String>,
    pub rows: Vec<Row>,
}

/// One number per coefficient.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    pub what: String,
    pub points: usize,
    pub choked: usize,
    pub values: Vec<f64>,
}

/// Cells are separated by at least two spaces.
fn cells(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

impl FitErrors {
    pub fn embedded() -> Result<Self> {
        Self::parse(SHOCK_EXPANSION.text)
            .ok_or_else(|| anyhow!("shock_expansion.toml: no table of errors in its header"))
    }

    fn parse(text: &str) -> Option<Self> {
        let mut head = text.lines().map_while(|line| line.strip_prefix('#'));
        let first = head.by_ref().skip_while(|line| !line.starts_with(" Least squares"));
        let samples: Vec<_> = first.take_while(|line| !line.is_empty()).map(str::trim).collect();
        let [points, choked, coefficients @ ..] = &cells(head.next()?)[..] else { return None };
        let columns = (*points == "points" && *choked == "choked").then_some(coefficients)?;
        let lines = head.skip(1).take_while(|line| !line.is_empty());
        let rows = lines.map(|line| {
            let [what, points, choked, values @ ..] = &cells(line)[..] else { return None };
            let values: Vec<_> =
                values.iter().map(|value| value.parse().ok()).collect::<Option<_>>()?;
            Some(Row {
                what: what.to_string(),
                points: points.parse().ok()?,
                choked: choked.parse().ok()?,
                values: (values.len() == columns.len()).then_some(values)?,
            })
        });
        Some(Self {
            samples: samples.join(" "),
            coefficients: columns.iter().map(ToString::to_string).collect(),
            rows: rows.collect::<Option<_>>()?,
        })
    }

    /// A row relative to the range of the values, per cent.
    pub fn percent(&self, row: &Row) -> Option<Vec<f64>> {
        let range = self.rows.iter().find(|row| row.what.starts_with("range"))?;
        Some(row.values.iter().zip(&range.values).map(|(v, range)| 100.0 * v / range).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_of_the_data_file_is_understood() {
        let fit = FitErrors::embedded().unwrap();
        assert_eq!(fit.coefficients, ["C_L", "C_D", "C_M", "C_T"]);
        assert!(fit.samples.contains("alpha -2 to 5") && fit.samples.contains("phi 0 to 1"));
        let row = |what: &str| fit.rows.iter().find(|row| row.what == what).unwrap();
        for what in ["range of values", "fit, rms", "held out, rms", "at Mach 9, rms"] {
            assert!(row(what).points > 100 && row(what).values.iter().all(|v| *v > 0.0), "{what}");
        }
        let of_range = fit.percent(row("fit, rms")).unwrap();
        assert!(of_range.iter().all(|percent| *percent < 5.0), "{of_range:?}");
    }

    #[test]
    fn another_head_is_none() {
        let text = SHOCK_EXPANSION.text.replace("0.22844", "much");
        assert!(FitErrors::parse(&text).is_none());
        assert!(FitErrors::parse("# Curve fits\n[reference]\n").is_none());
    }
}
