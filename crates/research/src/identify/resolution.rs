//! What the data determine at the chosen point, and what the norm decides.

use super::numbers::MOVABLE;
use anyhow::{Result, anyhow};
use nalgebra::DMatrix;

/// Parts of a combination that are smaller are not shown.
const SHOWN: f64 = 0.25;

/// What the data say about the numbers at the chosen point.
pub struct Resolution {
    pub singular_values: Vec<f64>,
    /// Unit combinations of ln ratio / doubt that belong to them, one per column.
    combinations: DMatrix<f64>,
    /// Part of each number that the data decide; the norm decides the rest.
    pub resolution: Vec<f64>,
    /// Formal standard errors of ln ratio / doubt: those of the wanted accuracies and the norm.
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

    /// The larger parts of a combination.
    pub fn combination(&self, column: usize) -> Vec<(&'static str, f64)> {
        let mut parts: Vec<_> = MOVABLE
            .into_iter()
            .zip(self.combinations.column(column).iter())
            .map(|((key, _), part)| (key, *part))
            .filter(|(_, part)| part.abs() > SHOWN)
            .collect();
        parts.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        // The sign of the whole is arbitrary: the largest part is shown positive.
        let sign = parts.first().map_or(1.0, |part| part.1.signum());
        parts.into_iter().map(|(key, part)| (key, sign * part)).collect()
    }
}
