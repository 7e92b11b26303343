//! Regularised nonlinear least squares: minimises r(p)^2 + weight p^2 by the Levenberg-Marquardt method.

use anyhow::{Result, anyhow};
use nalgebra::{DMatrix, DVector};
use std::panic::resume_unwind;
use std::thread;

/// Step of central differences; the truncation error of a smooth residual is below 1e-9.
const STEP: f64 = 1e-5;
/// End of a search: step size, or number of steps.
pub type End = (f64, usize);
/// A step below which no written digit changes.
pub const CONVERGED: End = (1e-9, 200);
/// Damping of the first step, and its factors after success and failure.
const DAMPING: f64 = 1e-3;
const RELAX: f64 = 0.2;
const TIGHTEN: f64 = 5.0;
/// Damping at which the gain of a step is below rounding errors.
const STUCK: f64 = 1e12;

/// Residuals at a point; `None` where the model has no solution (no trim, no such root).
pub type Residual<'a> = dyn Fn(&DVector<f64>) -> Option<DVector<f64>> + Sync + 'a;

/// A minimum.
#[derive(Debug, Clone)]
pub struct Fit {
    pub point: DVector<f64>,
    pub residual: DVector<f64>,
    pub jacobian: DMatrix<f64>,
}

impl Fit {
    /// `None` without a solution or its derivatives, or where the cost is above `limit`.
    fn at(
        residual: &Residual,
        point: DVector<f64>,
        held: &[bool],
        weight: f64,
        limit: f64,
    ) -> Option<Self> {
        let value = residual(&point)?;
        if cost(&value, &point, weight) > limit {
            return None;
        }
        let jacobian = jacobian(residual, &point, held)?;
        Some(Self { point, residual: value, jacobian })
    }

    /// r^2 + `weight` p^2.
    pub fn cost(&self, weight: f64) -> f64 {
        cost(&self.residual, &self.point, weight)
    }
}

fn cost(residual: &DVector<f64>, point: &DVector<f64>, weight: f64) -> f64 {
    residual.norm_squared() + weight * point.norm_squared()
}

/// Jacobian d residual / d point, with columns computed in parallel; columns in `held` are zero.
pub fn jacobian(residual: &Residual, point: &DVector<f64>, held: &[bool]) -> Option<DMatrix<f64>> {
    let count = residual(point)?.len();
    let column = |i: usize| {
        if held[i] {
            return Some(DVector::zeros(count));
        }
        let shifted = |step: f64| {
            let mut point = point.clone();
            point[i] += step;
            residual(&point)
        };
        Some((shifted(STEP)? - shifted(-STEP)?) * (0.5 / STEP))
    };
    let all: Vec<usize> = (0..held.len()).collect();
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let part = |indices: &[usize]| indices.iter().map(|i| column(*i)).collect::<Option<Vec<_>>>();
    #[expect(clippy::disallowed_methods, reason = "the order of the parts is that of the chunks")]
    let parts: Vec<_> = thread::scope(|scope| {
        let chunks = all.chunks(all.len().div_ceil(workers).max(1));
        let running: Vec<_> = chunks.map(|chunk| scope.spawn(|| part(chunk))).collect();
        running.into_iter().map(|worker| worker.join()).collect()
    });
    let mut columns = Vec::with_capacity(all.len());
    for part in parts {
        columns.extend(part.unwrap_or_else(|panic| resume_unwind(panic))?);
    }
    Some(DMatrix::from_columns(&columns))
}

/// Minimises r^2 + `weight` p^2 from `start`; coordinates in `held` are fixed.
pub fn minimise(
    residual: &Residual,
    start: &DVector<f64>,
    held: &[bool],
    weight: f64,
    (converged, steps): End,
) -> Result<Fit> {
    let mut fit = Fit::at(residual, start.clone(), held, weight, f64::INFINITY)
        .ok_or_else(|| anyhow!("the model has no solution at the start of the identification"))?;
    let mut damping = DAMPING;
    for _ in 0..steps {
        let Fit { point, residual: r, jacobian: j } = &fit;
        let normal = j.tr_mul(j);
        let slope = j.tr_mul(r) + point * weight;
        let improved = loop {
            let mut matrix = normal.clone();
            for i in 0..point.len() {
                matrix[(i, i)] += weight + damping * (normal[(i, i)] + weight) + f64::EPSILON;
                if held[i] {
                    matrix[(i, i)] = 1.0;
                }
            }
            let mut step = matrix
                .cholesky()
                .map(|factor| factor.solve(&-&slope))
                .ok_or_else(|| anyhow!("the normal equations are singular"))?;
            step.iter_mut().zip(held).filter(|(_, held)| **held).for_each(|(s, _)| *s = 0.0);
            // A point without derivatives, at the edge of the domain, is not accepted.
            let better = Fit::at(residual, point + &step, held, weight, fit.cost(weight));
            if better.is_some() || damping > STUCK {
                break better.map(|next| (step, next));
            }
            damping *= TIGHTEN;
        };
        let Some((step, next)) = improved else { break };
        fit = next;
        if step.amax() < converged {
            break;
        }
        damping *= RELAX;
    }
    Ok(fit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_valley_of_rosenbrock() {
        let valley = |p: &DVector<f64>| {
            Some(DVector::from_vec(vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]))
        };
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let free = minimise(&valley, &start, &[false, false], 0.0, CONVERGED).unwrap();
        assert!((free.point - DVector::from_element(2, 1.0)).amax() < 1e-6);
        let held = minimise(&valley, &start, &[true, false], 0.0, CONVERGED).unwrap();
        assert_eq!(held.point[0], -1.2);
        assert!((held.point[1] - 1.44).abs() < 1e-6);
    }

    #[test]
    fn a_weight_holds_back() {
        let line = |p: &DVector<f64>| Some(DVector::from_element(1, p[0] - 1.0));
        let fit = minimise(&line, &DVector::zeros(1), &[false], 1.0, CONVERGED).unwrap();
        assert!((fit.point[0] - 0.5).abs() < 1e-8);
    }
}
