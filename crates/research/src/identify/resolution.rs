//! Resolution at the chosen point: which numbers the data determine, and which the norm.

use super::numbers::MOVABLE;
use anyhow::{Result, anyhow};
use nalgebra::DMatrix;

/// Smallest component of a combination that is shown.
const SHOWN: f64 = 0.25;

/// Singular values, resolution and standard errors at the chosen point.
pub struct Resolution {
    pub singular_values: Vec<f64>,
    /// The right singular vectors, in units of prior standard deviations, one per column.
    combinations: DMatrix<f64>,
    /// Share of each number determined by the data; the rest is determined by the norm.
    pub resolution: Vec<f64>,
    /// Formal standard errors, in prior standard deviations, from wanted accuracies and norm.
    pub errors: Vec<f64>,
}

impl Resolution {
    pub fn new(sensitivity: &DMatrix<f64>, weight: f64) -> Result<Self> {
        let svd = sensitivity.clone().svd(false, true);
        let v_t = svd.v_t.ok_or_else(|| anyhow!("no singular vectors"))?;
        let share = svd.singular_values.map(|s| s * s / (s * s + weight));
        let resolved = |i: usize| (0..share.len()).map(|k| v_t[(k, i)].powi(2) * share[k]).sum();
        let information = sensitivity.tr_mul(sensitivity)
            + DMatrix::identity(MOVABLE.len(), MOVABLE.len()) * weight;
        let covariance = information.cholesky().ok_or_else(|| anyhow!("no covariance"))?.inverse();
        Ok(Self {
            errors: covariance.diagonal().iter().map(|variance| variance.sqrt()).collect(),
            singular_values: svd.singular_values.iter().copied().collect(),
            resolution: (0..MOVABLE.len()).map(resolved).collect(),
            combinations: v_t.transpose(),
        })
    }

    /// The larger components of a combination.
    pub fn combination(&self, column: usize) -> Vec<(&'static str, f64)> {
        let mut parts: Vec<_> = MOVABLE
            .into_iter()
            .zip(self.combinations.column(column).iter())
            .map(|((key, _), part)| (key, *part))
            .filter(|(_, part)| part.abs() > SHOWN)
            .collect();
        parts.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        // The sign is arbitrary: the largest component is shown positive.
        let sign = parts.first().map_or(1.0, |part| part.1.signum());
        parts.into_iter().map(|(key, part)| (key, sign * part)).collect()
    }
}
