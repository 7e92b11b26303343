//! Report of the identification of beam and tanks.

use super::model::{DATA, DOUBT, FREQUENCIES, GROWTH, Model, Solution};
use super::numbers::{COORDINATES, Scale, names, values, with_values};
use crate::identify::levenberg_marquardt::jacobian;
use ahv::data::VehicleData;
use ahv::structure::Beam;
use ahv_tool::table::{number, row, table};
use anyhow::{Result, anyhow};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// Share determined by the data from which a number counts as determined, and as constrained.
const DETERMINED: f64 = 0.9;
const NARROWED: f64 = 0.3;

/// Results of the identification.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Sum of squares of the coordinates: deviations from the prior over its standard deviations.
    pub distance: f64,
    /// Mass centre of the full vehicle: published, identified.
    pub mass_centre_m: [f64; 2],
    pub numbers: Vec<Number>,
    pub data: Vec<Datum>,
}

/// One number.
#[derive(Debug, Serialize)]
pub struct Number {
    pub name: String,
    pub unit: &'static str,
    /// Whether errors are of the natural logarithm rather than in the unit.
    pub errors_of_logarithm: bool,
    pub prior: f64,
    pub prior_error: f64,
    pub value: f64,
    /// Posterior standard error.
    pub error: f64,
    /// Share of the prior variance removed by the data.
    pub decided_by_data: f64,
    /// Relative change of each datum over that of the number, or per unit.
    pub sensitivity: [f64; DATA],
}

/// One printed datum.
#[derive(Debug, Serialize)]
pub struct Datum {
    pub name: String,
    pub unit: &'static str,
    pub printed: f64,
    /// Its standard error in the fit.
    pub doubt: f64,
    /// With the digits that are written.
    pub value: f64,
}

/// The numbers on the scale of their errors: logarithms or values.
fn scaled(data: &VehicleData) -> DVector<f64> {
    let scaled = values(data).into_iter().zip(names()).map(|(value, (.., scale))| match scale {
        Scale::Ratio => libm::log(value),
        Scale::Difference => value,
    });
    DVector::from_iterator(names().len(), scaled)
}

/// Relative changes of the data per number, on the scale of its errors, one column per number.
pub fn sensitivity(model: &Model, vehicle: &VehicleData) -> Result<DMatrix<f64>> {
    let at = scaled(vehicle);
    let free = vec![false; at.len()];
    let logarithms = |point: &DVector<f64>| {
        let moved = point.iter().zip(names()).map(|(value, (.., scale))| match scale {
            Scale::Ratio => libm::exp(*value),
            Scale::Difference => *value,
        });
        let moved = with_values(vehicle.clone(), &moved.collect::<Vec<_>>());
        Some(DVector::from_row_slice(&model.found(&moved)?.map(libm::log)))
    };
    jacobian(&logarithms, &at, &free).ok_or_else(|| anyhow!("no derivative at the solution"))
}

/// Mass centre of the full vehicle with its tanks, m.
fn mass_centre(data: &VehicleData) -> f64 {
    let liquid: f64 = data.tank.iter().map(|tank| tank.share.value * tank.centre_m.value).sum();
    let part = data.mass.propellant_fraction.value;
    part * liquid + (1.0 - part) * Beam::even(data, 1.0).mass_properties(&[]).centre_m
}

impl Number {
    /// An error as a factor or a difference.
    fn within(&self, error: f64) -> String {
        match self.errors_of_logarithm {
            true => format!("x/ {:.2}", libm::exp(error)),
            false => format!("+- {error:.2}"),
        }
    }
}

impl Report {
    /// Standard error of each number, for the file.
    pub fn known(&self) -> Vec<String> {
        self.numbers.iter().map(|number| number.within(number.error)).collect()
    }

    pub fn new(model: &Model, solution: &Solution) -> Result<Self> {
        let Solution { fit, vehicle } = solution;
        let lost = || anyhow!("no derivative at the solution");
        let free = [false; COORDINATES];
        // Centres, fixed to nodes in the last fit, count as free here.
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
                // Both at the solution: the share depends nonlinearly on the centres.
                decided_by_data: 1.0 - variance / after.row(i).norm_squared(),
                sensitivity: std::array::from_fn(|k| sensitivity[(k, i)]),
            }
        };
        let numbers = names().into_iter().zip(values(vehicle)).enumerate().map(number).collect();
        let found = model.found(vehicle).ok_or_else(|| anyhow!("no modes"))?;
        let datum = |(i, value): (usize, f64)| {
            let column = if i < FREQUENCIES / 2 { "even" } else { "slosh" };
            let mode = i % (FREQUENCIES / 2) + 1;
            let (name, unit) = match i {
                GROWTH => ("short period, slosh/even".to_string(), "1"),
                _ => (format!("{column}, mode {mode}"), "rad/s"),
            };
            Datum { name, unit, printed: model.wanted[i], doubt: DOUBT[i], value }
        };
        Ok(Self {
            distance: fit.point.norm_squared(),
            mass_centre_m: [model.prior.mass_centre, mass_centre(vehicle)],
            numbers,
            data: found.into_iter().enumerate().map(datum).collect(),
        })
    }

    pub fn text(&self) -> String {
        format!(
            "Beam and tanks nearest to the prior that give Table 1 and the growth of the short period from\n\
             even to sloshing mass in Table 2, with the published coefficients. Prior: EI of unknown\n\
             level and tilt (a factor of ten), each station within sqrt(2) of the geometric mean of its\n\
             neighbours; a tank in the middle of each beam, half as long as the beam (e^0.5), its\n\
             centre within a quarter of the beam; the mass centre within 1 % of the length of the\n\
             published 55 ft. Sum of squared deviations over prior variances: {}\n\
             Mass centre of the full vehicle, m: published {}, identified {}\n\n\
             Numbers; standard errors as factors (x/) or differences (+-)\n{}\n\
             Printed data\n{}\n\
             Change of the printed data, per cent, for 10 % of EI or length, 1 m of centre, 0.1 of share\n{}",
            number(self.distance),
            number(self.mass_centre_m[0]),
            number(self.mass_centre_m[1]),
            self.number_table(),
            self.data_table(),
            self.sensitivity_table(),
        )
    }

    fn number_table(&self) -> String {
        let mut rows = vec![row([
            "number",
            "unit",
            "prior",
            "",
            "identified",
            "",
            "determined by the data",
            "",
        ])];
        for line in &self.numbers {
            let verdict = match line.decided_by_data {
                part if part >= DETERMINED => "determined",
                part if part >= NARROWED => "constrained",
                _ => "prior",
            };
            rows.push(vec![
                line.name.clone(),
                line.unit.to_string(),
                number(line.prior),
                line.within(line.prior_error),
                number(line.value),
                line.within(line.error),
                format!("{:.0} %", 100.0 * line.decided_by_data),
                verdict.to_string(),
            ]);
        }
        table(&rows)
    }

    fn data_table(&self) -> String {
        let mut rows =
            vec![row(["datum", "unit", "printed", "standard error", "identified", "error"])];
        for line in &self.data {
            rows.push(vec![
                line.name.clone(),
                line.unit.to_string(),
                format!("{:.4}", line.printed),
                number(line.doubt),
                format!("{:.4}", line.value),
                format!("{:+.4} %", 100.0 * (line.value / line.printed - 1.0)),
            ]);
        }
        table(&rows)
    }

    fn sensitivity_table(&self) -> String {
        let columns = self.data.iter().map(|line| line.name.clone());
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
