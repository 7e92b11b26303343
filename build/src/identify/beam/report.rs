//! What Table 1 says about the numbers, and what it leaves to the prior.

use super::model::{FREQUENCIES, Model, PRINTED, Solution};
use super::numbers::{COORDINATES, Scale, names, values, with_values};
use crate::identify::fit::jacobian;
use crate::table::{number, row, table};
use ahv::params::VehicleData;
use anyhow::{Result, anyhow};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// A number of which the data decide this part or more counts as determined, and as narrowed.
const DETERMINED: f64 = 0.9;
const NARROWED: f64 = 0.3;

/// An identification with all its reasons.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Sum of squares of the coordinates: departures from the prior over their doubts.
    pub distance: f64,
    /// Half of the last printed digit: what the standard errors assume of Table 1.
    pub printed_accuracy_rad_per_s: f64,
    pub numbers: Vec<Number>,
    pub frequencies: Vec<Frequency>,
}

/// One number.
#[derive(Debug, Serialize)]
pub struct Number {
    pub name: String,
    pub unit: &'static str,
    /// Errors are of the natural logarithm, and else in the unit.
    pub errors_of_logarithm: bool,
    pub prior: f64,
    pub prior_error: f64,
    pub value: f64,
    /// Standard error, given the data.
    pub error: f64,
    /// Part of the prior's variance that the data remove.
    pub decided_by_data: f64,
    /// Of the six frequencies: relative change over that of the number, or per unit.
    pub sensitivity: [f64; FREQUENCIES],
}

/// One frequency.
#[derive(Debug, Serialize)]
pub struct Frequency {
    pub column: &'static str,
    pub mode: usize,
    pub printed_rad_per_s: f64,
    /// With the digits that are written.
    pub value_rad_per_s: f64,
}

/// The numbers on the scale of their doubts.
fn scaled(data: &VehicleData) -> DVector<f64> {
    let scaled = values(data).into_iter().zip(names()).map(|(value, (.., scale))| match scale {
        Scale::Ratio => value.ln(),
        Scale::Difference => value,
    });
    DVector::from_iterator(names().len(), scaled)
}

/// Relative changes of the frequencies with each number on the scale of its doubt, one column per
/// number.
pub fn sensitivity(model: &Model, vehicle: &VehicleData) -> Result<DMatrix<f64>> {
    let at = scaled(vehicle);
    let free = vec![false; at.len()];
    let logarithms = |point: &DVector<f64>| {
        let moved = point.iter().zip(names()).map(|(value, (.., scale))| match scale {
            Scale::Ratio => value.exp(),
            Scale::Difference => *value,
        });
        let moved = with_values(vehicle.clone(), &moved.collect::<Vec<_>>());
        Some(DVector::from_row_slice(&model.frequencies(&moved)?.map(f64::ln)))
    };
    jacobian(&logarithms, &at, &free).ok_or_else(|| anyhow!("no derivative at the solution"))
}

impl Report {
    pub fn new(model: &Model, solution: &Solution) -> Result<Self> {
        let Solution { fit, vehicle } = solution;
        let lost = || anyhow!("no derivative at the solution");
        let free = [false; COORDINATES];
        // Held coordinates, the centres on their nodes, count as free: the data are asked about them.
        let data = jacobian(&|p| model.residual(p), &fit.point, &free).ok_or_else(lost)?;
        let spread = |p: &DVector<f64>| Some(scaled(&model.prior.vehicle(p)));
        let prior_point = DVector::zeros(COORDINATES);
        let before = jacobian(&spread, &prior_point, &free).ok_or_else(lost)?;
        let after = jacobian(&spread, &fit.point, &free).ok_or_else(lost)?;
        let information = DMatrix::identity(COORDINATES, COORDINATES) + data.tr_mul(&data);
        let covariance = information.cholesky().ok_or_else(lost)?.inverse();
        let sensitivity = sensitivity(model, vehicle)?;
        let prior = values(&model.prior.vehicle(&prior_point));
        let number = |(i, ((name, unit, scale), value)): (usize, ((_, _, _), f64))| {
            let variance = (after.row(i) * &covariance * after.row(i).transpose())[(0, 0)];
            Number {
                name,
                unit,
                errors_of_logarithm: scale == Scale::Ratio,
                prior: prior[i],
                prior_error: before.row(i).norm(),
                value,
                error: variance.sqrt(),
                // Both at the solution: the share follows from the centres, and not linearly.
                decided_by_data: 1.0 - variance / after.row(i).norm_squared(),
                sensitivity: std::array::from_fn(|k| sensitivity[(k, i)]),
            }
        };
        let numbers = names().into_iter().zip(values(vehicle)).enumerate().map(number).collect();
        let found = model.frequencies(vehicle).ok_or_else(|| anyhow!("no modes"))?;
        let frequency = |(i, value_rad_per_s): (usize, f64)| Frequency {
            column: if i < FREQUENCIES / 2 { "even" } else { "slosh" },
            mode: i % (FREQUENCIES / 2) + 1,
            printed_rad_per_s: model.wanted[i],
            value_rad_per_s,
        };
        Ok(Self {
            distance: fit.point.norm_squared(),
            printed_accuracy_rad_per_s: PRINTED,
            numbers,
            frequencies: found.into_iter().enumerate().map(frequency).collect(),
        })
    }

    pub fn text(&self) -> String {
        format!(
            "The most ordinary beam and tanks that give Table 1. Prior: EI of unknown level and tilt\n\
             (a factor of ten), each station within sqrt(2) of the geometric mean of its neighbours;\n\
             a tank in the middle of either beam, half as long as the beam (e^0.5), its centre within\n\
             a quarter of the beam; the shares put the mass centre at the published 55 ft.\n\
             Sum of squared departures over doubts: {}\n\n\
             Numbers; standard errors as factors (x/) or differences (+-)\n{}\n\
             Frequencies of Table 1, rad/s\n{}\n\
             Change of the frequencies, per cent, for 10 % of EI or length, 1 m of centre, 0.1 of share\n{}",
            number(self.distance),
            self.number_table(),
            self.frequency_table(),
            self.sensitivity_table(),
        )
    }

    fn number_table(&self) -> String {
        let mut rows =
            vec![row(["number", "unit", "prior", "", "identified", "", "decided by Table 1", ""])];
        for line in &self.numbers {
            let error = |error: f64| {
                if line.errors_of_logarithm {
                    format!("x/ {:.2}", error.exp())
                } else {
                    format!("+- {error:.2}")
                }
            };
            let verdict = match line.decided_by_data {
                part if part >= DETERMINED => "determined",
                part if part >= NARROWED => "narrowed",
                _ => "guessed",
            };
            rows.push(vec![
                line.name.clone(),
                line.unit.to_string(),
                number(line.prior),
                error(line.prior_error),
                number(line.value),
                error(line.error),
                format!("{:.0} %", 100.0 * line.decided_by_data),
                verdict.to_string(),
            ]);
        }
        table(&rows)
    }

    fn frequency_table(&self) -> String {
        let mut rows = vec![row(["column, mode", "printed", "identified", "error"])];
        for line in &self.frequencies {
            let error = line.value_rad_per_s / line.printed_rad_per_s - 1.0;
            rows.push(vec![
                format!("{}, {}", line.column, line.mode),
                format!("{:.2}", line.printed_rad_per_s),
                format!("{:.4}", line.value_rad_per_s),
                format!("{:+.4} %", 100.0 * error),
            ]);
        }
        table(&rows)
    }

    fn sensitivity_table(&self) -> String {
        let columns = self.frequencies.iter().map(|line| format!("{} {}", line.column, line.mode));
        let mut rows = vec![std::iter::once("number".to_string()).chain(columns).collect()];
        for line in &self.numbers {
            let step = if line.unit == "m" && !line.errors_of_logarithm { 1.0 } else { 0.1 };
            let cells =
                line.sensitivity.iter().map(|slope| format!("{:+.2}", 100.0 * step * slope));
            rows.push(std::iter::once(line.name.clone()).chain(cells).collect());
        }
        table(&rows)
    }
}
