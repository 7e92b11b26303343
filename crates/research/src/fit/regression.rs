//! The polynomials of eq. (4), fitted to the first-principles model by least squares.

use crate::gas::GasError;
use crate::shock_expansion::stream::Stream;
use crate::shock_expansion::{Attitude, ShockExpansion};
use ahv::data::AeroData;
use anyhow::{Result, anyhow};
use nalgebra::{DMatrix, DVector};

/// C_L, C_D, C_M, C_T.
pub const COEFFICIENTS: [&str; 4] = ["C_L", "C_D", "C_M", "C_T"];

/// One term alpha^a delta_e^d phi^f: its table, its key and its powers.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    pub table: &'static str,
    pub key: &'static str,
    powers: [i32; 3],
}

const fn term(table: &'static str, key: &'static str, powers: [i32; 3]) -> Term {
    Term { table, key, powers }
}

/// The terms of each coefficient: those of the published set, C_L,alpha2, and terms for the plume under the aft-body
/// and for an elevator with strong shocks.
pub const TERMS: [&[Term]; 4] = [
    &[
        term("lift", "constant", [0, 0, 0]),
        term("lift", "alpha", [1, 0, 0]),
        term("lift", "alpha2", [2, 0, 0]),
        term("lift", "delta_e", [0, 1, 0]),
        term("lift", "delta_e3", [0, 3, 0]),
        term("lift_phi", "constant", [0, 0, 1]),
        term("lift_phi", "alpha", [1, 0, 1]),
    ],
    &[
        term("drag", "constant", [0, 0, 0]),
        term("drag", "alpha", [1, 0, 0]),
        term("drag", "alpha2", [2, 0, 0]),
        term("drag", "delta_e", [0, 1, 0]),
        term("drag", "delta_e2", [0, 2, 0]),
        term("drag", "alpha_delta_e", [1, 1, 0]),
        term("drag_phi", "alpha", [1, 0, 1]),
    ],
    &[
        term("moment", "constant", [0, 0, 0]),
        term("moment", "alpha", [1, 0, 0]),
        term("moment", "alpha2", [2, 0, 0]),
        term("moment", "delta_e", [0, 1, 0]),
        term("moment", "delta_e3", [0, 3, 0]),
        term("moment_phi", "constant", [0, 0, 1]),
        term("moment_phi", "alpha", [1, 0, 1]),
    ],
    &[
        term("thrust", "constant", [0, 0, 0]),
        term("thrust", "alpha", [1, 0, 0]),
        term("thrust", "alpha2", [2, 0, 0]),
        term("thrust", "alpha3", [3, 0, 0]),
        term("thrust_phi", "constant", [0, 0, 1]),
        term("thrust_phi", "alpha", [1, 0, 1]),
        term("thrust_phi", "alpha2", [2, 0, 1]),
        term("thrust_phi", "alpha3", [3, 0, 1]),
    ],
];

impl Term {
    /// Unit of its coefficient.
    pub fn unit(&self) -> &'static str {
        ["1", "1/rad", "1/rad^2", "1/rad^3"][(self.powers[0] + self.powers[1]) as usize]
    }

    fn at(&self, attitude: &Attitude) -> f64 {
        let [a, d, f] = self.powers;
        attitude.alpha.powi(a) * attitude.delta_e.powi(d) * attitude.phi.powi(f)
    }
}

/// An attitude and the coefficients there.
pub struct Sample {
    attitude: Attitude,
    value: [f64; 4],
}

/// First value, step and number of values; degrees for angles.
pub type Axis = (f64, f64, usize);

/// The coefficients on a grid of alpha, delta_e and phi, and the number of choked points.
pub fn samples(
    model: &ShockExpansion,
    ahead: &Stream,
    reference: &AeroData,
    axes: [Axis; 3],
) -> Result<(Vec<Sample>, usize)> {
    let values = |(first, step, count): Axis| (0..count).map(move |i| first + i as f64 * step);
    let (mut samples, mut choked) = (Vec::new(), 0);
    for alpha in values(axes[0]).map(f64::to_radians) {
        for delta_e in values(axes[1]).map(f64::to_radians) {
            for phi in values(axes[2]) {
                let attitude = Attitude { alpha, delta_e, phi };
                match sample(model, ahead, reference, attitude) {
                    Ok(sample) => samples.push(sample),
                    Err(GasError::ThermallyChoked { .. }) => choked += 1,
                    Err(error) => return Err(error.into()),
                }
            }
        }
    }
    Ok((samples, choked))
}

fn sample(
    model: &ShockExpansion,
    ahead: &Stream,
    reference: &AeroData,
    attitude: Attitude,
) -> Result<Sample, GasError> {
    let loads = model.loads(ahead, &attitude, &|_| 0.0)?;
    let chord = reference.reference.chord_m.value;
    let qbar = model.medium.gas.dynamic_pressure(ahead.mach) * ahead.pressure;
    let force = qbar * reference.reference.area_m2_per_m.value;
    let moment = loads.moment(reference.reference.moment_centre_m.value, model.moment_height);
    let value = [loads.lift(), loads.drag(), moment / chord, loads.thrust].map(|x| x / force);
    Ok(Sample { attitude, value })
}

/// Factors of the terms of one coefficient.
pub fn fit(samples: &[Sample], coefficient: usize) -> Result<Vec<f64>> {
    let terms = TERMS[coefficient];
    // Scaled columns improve the conditioning.
    let columns = DMatrix::from_fn(samples.len(), terms.len(), |row, column| {
        terms[column].at(&samples[row].attitude)
    });
    let scale: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    let scaled = DMatrix::from_fn(samples.len(), terms.len(), |row, column| {
        columns[(row, column)] / scale[column]
    });
    let right = DVector::from_fn(samples.len(), |row, _| samples[row].value[coefficient]);
    let qr = scaled.qr();
    let solution = qr
        .r()
        .solve_upper_triangular(&(qr.q().transpose() * right))
        .ok_or_else(|| anyhow!("the samples do not determine {}", COEFFICIENTS[coefficient]))?;
    Ok(solution.iter().zip(scale).map(|(value, scale)| round(value / scale)).collect())
}

/// Rounds to six digits, the same on every machine.
fn round(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Deviation of a fit: root mean square, largest, and the range of what it fits.
#[derive(Debug, Clone, Copy)]
pub struct Deviation {
    pub rms: f64,
    pub largest: f64,
    pub range: f64,
}

/// Deviation of the fit from samples.
pub fn deviation(samples: &[Sample], coefficient: usize, factors: &[f64]) -> Deviation {
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for sample in samples {
        let terms = TERMS[coefficient].iter().zip(factors);
        let fitted: f64 = terms.map(|(term, factor)| factor * term.at(&sample.attitude)).sum();
        let (value, error) = (sample.value[coefficient], fitted - sample.value[coefficient]);
        sum += error * error;
        largest = largest.max(error.abs());
        (low, high) = (low.min(value), high.max(value));
    }
    let rms = (sum / samples.len() as f64).sqrt();
    Deviation { rms, largest, range: high - low }
}
