//! The L-curve, the trade-off between misfit and distance, and its knee.

use super::body_cache::BodyCache;
use super::cells::{COLUMNS, Cell, cells, values};
use super::levenberg_marquardt::{CONVERGED, End, Fit, jacobian, minimise};
use super::numbers::{MOVABLE, Origin, hardly_moves};
use ahv::data::{AeroData, Data};
use ahv::dynamics::trim::{Trim, trim};
use ahv::flight::Parameters;
use ahv::vehicle::{ALPHA, DELTA_E, PHI, Vehicle, VehicleDefinition, VehicleOptions};
use anyhow::{Context, Result, anyhow};
use nalgebra::{DMatrix, DVector};

/// Weights of the distance along the curve, from no change of the numbers to no regularisation.
const FIRST_WEIGHT: f64 = 1e4;
const LAST_WEIGHT: f64 = 1e-2;
const STEPS_PER_DECADE: i32 = 4;
/// End of a search beyond the knee, where results are shown but not used. A search that does not converge
/// continues at the next weight.
const SHOWN: End = (1e-4, 40);
/// Smallest change of a number; smaller ones are reset.
const STAYS: f64 = 0.01;
/// Share of its range, about the middle, that a trimmed control or incidence uses without penalty, and the excess
/// with the same cost as a cell off by its wanted accuracy.
const ROOM: f64 = 0.75;
const EXCESS: f64 = 0.05;

/// The tables and the vehicle fitted to them.
pub struct Model {
    pub cells: Vec<Cell>,
    pub origin: Origin,
    pub data: Data,
    pub columns: Vec<VehicleOptions>,
    pub(super) bodies: BodyCache,
}

/// One point of the curve.
#[derive(Debug, Clone)]
pub struct Point {
    pub weight: f64,
    pub fit: Fit,
}

impl Point {
    /// Sum over the cells of (relative error / wanted accuracy)^2.
    pub fn misfit(&self) -> f64 {
        self.fit.residual.norm_squared()
    }

    /// Sum over the numbers of (ln ratio / prior standard deviation)^2.
    pub fn distance(&self) -> f64 {
        self.fit.point.norm_squared()
    }

    /// Which numbers are unchanged.
    fn held(&self) -> Vec<bool> {
        self.fit.point.iter().map(|coordinate| *coordinate == 0.0).collect()
    }
}

/// A vehicle without control limits, so that the misfit is smooth there; [`excess`] penalises it.
fn unlimited(mut vehicle: Vehicle) -> Vehicle {
    vehicle.limits = [f64::INFINITY; 2];
    vehicle.aero.envelope.alpha = [f64::NEG_INFINITY, f64::INFINITY];
    vehicle
}

/// Excess of a value beyond its share of a range, over [`EXCESS`].
fn excess(value: f64, [min, max]: [f64; 2]) -> f64 {
    let off_middle = ((2.0 * value - min - max) / (max - min)).abs();
    (off_middle - ROOM).max(0.0) / EXCESS
}

impl Model {
    pub fn new(data: Data) -> Result<Self> {
        let default = Parameters::new(&data).options;
        let columns =
            COLUMNS.map(|configuration| VehicleOptions { configuration, ..default }).to_vec();
        Ok(Self {
            cells: cells()?,
            origin: Origin::new()?,
            data,
            columns,
            bodies: BodyCache::default(),
        })
    }

    fn trimmed(&self, set: &AeroData) -> Option<Vec<(Vehicle, Trim)>> {
        let one = |options: &VehicleOptions| {
            let definition = VehicleDefinition::with_coefficients(&self.data, options, set);
            let body = self.bodies.of(&definition).ok()?;
            let definition = definition.with_imu_of_table_3(body.properties.centre_m);
            let vehicle = unlimited(Vehicle::with_body(&definition, &body).ok()?);
            let trim = trim(&vehicle, &options.condition).ok()?;
            Some((vehicle, trim))
        };
        self.columns.iter().map(one).collect()
    }

    /// Values of the cells with a coefficient set.
    pub fn values(&self, set: &AeroData) -> Option<Vec<f64>> {
        let columns = self.trimmed(set)?;
        let values: Option<Vec<_>> = columns.iter().map(|(v, trim)| values(v, trim)).collect();
        Some(values?.concat())
    }

    /// Incidence (rad), elevator (rad) and fuel ratio in trim, column by column.
    pub fn trims(&self, set: &AeroData) -> Option<Vec<[f64; 3]>> {
        let columns = self.trimmed(set)?;
        Some(
            columns
                .iter()
                .map(|(_, t)| [t.state[ALPHA], t.control[DELTA_E], t.control[PHI]])
                .collect(),
        )
    }

    /// Errors over wanted accuracies of the fitted cells, then the excess of the trims.
    fn residual(&self, point: &DVector<f64>) -> Option<DVector<f64>> {
        let set = self.origin.moved(point)?;
        let actuation = &self.data.vehicle.actuation;
        let elevator = actuation.delta_e_limit_rad.value;
        let ranges =
            [set.envelope.alpha_rad.value, [-elevator, elevator], [0.0, actuation.phi_limit.value]];
        let columns = self.trimmed(&set)?;
        let (mut found, mut room) = (Vec::new(), Vec::new());
        for (vehicle, trim) in &columns {
            found.extend(values(vehicle, trim)?);
            let trimmed = [trim.state[ALPHA], trim.control[DELTA_E], trim.control[PHI]];
            room.extend(trimmed.into_iter().zip(ranges).map(|(value, range)| excess(value, range)));
        }
        let errors = self.cells.iter().zip(found);
        let scaled = errors.filter_map(|(cell, value)| Some(cell.error(value) / cell.wanted?));
        Some(DVector::from_iterator(scaled.clone().count() + room.len(), scaled.chain(room)))
    }

    pub fn fit(&self, start: &DVector<f64>, held: &[bool], weight: f64, end: End) -> Result<Point> {
        let fit = minimise(&|point| self.residual(point), start, held, weight, end)
            .with_context(|| format!("weight {weight:.1e}"))?;
        Ok(Point { weight, fit })
    }

    /// The branch from the published set: each point starts from the one before. It ends where the knee is known,
    /// or at the last weight. `tell` is called for every point.
    fn branch(&self, until_knee: bool, tell: &dyn Fn(&Point)) -> Result<Vec<Point>> {
        let decades = libm::log10(FIRST_WEIGHT / LAST_WEIGHT).round() as i32;
        let mut start = DVector::zeros(MOVABLE.len());
        let mut path: Vec<Point> = Vec::new();
        for step in 0..=decades * STEPS_PER_DECADE {
            let weight = FIRST_WEIGHT * libm::exp10(-f64::from(step) / f64::from(STEPS_PER_DECADE));
            let end = if knee(&path).is_none() { CONVERGED } else { SHOWN };
            let point = self.fit(&start, &[false; MOVABLE.len()], weight, end)?;
            start.copy_from(&point.fit.point);
            tell(&point);
            path.push(point);
            if until_knee && knee(&path).is_some() {
                break;
            }
        }
        Ok(path)
    }

    /// The chosen point, without points beyond it.
    pub fn chosen(&self) -> Result<Point> {
        let path = self.branch(true, &|_| ())?;
        let knee = knee(&path).ok_or_else(|| anyhow!("the trade-off has no knee"))?;
        self.sparse(&path[knee])
    }

    /// The whole curve and the index of its knee. Beyond the knee it is also followed backwards, and the better of
    /// two points is kept, because there are several local minima far from the published set.
    pub fn path(&self, tell: &dyn Fn(&Point)) -> Result<(Vec<Point>, usize)> {
        let mut path = self.branch(false, tell)?;
        let knee = knee(&path).ok_or_else(|| anyhow!("the trade-off has no knee"))?;
        for i in (knee + 2..path.len() - 1).rev() {
            let start = path[i + 1].fit.point.clone();
            let other = self.fit(&start, &[false; MOVABLE.len()], path[i].weight, SHOWN)?;
            let weight = path[i].weight;
            tell(&other);
            if other.fit.cost(weight) < path[i].fit.cost(weight) {
                path[i] = other;
            }
        }
        Ok((path, knee))
    }

    /// The point fitted again with all changes below [`STAYS`] reset.
    pub fn sparse(&self, point: &Point) -> Result<Point> {
        let mut sparse = point.clone();
        loop {
            let still = |(i, x): (usize, &f64)| hardly_moves(i, *x, STAYS);
            let held: Vec<bool> = sparse.fit.point.iter().enumerate().map(still).collect();
            if held == sparse.held() {
                return Ok(sparse);
            }
            let mut start = sparse.fit.point;
            start.iter_mut().zip(&held).filter(|(_, held)| **held).for_each(|(x, _)| *x = 0.0);
            sparse = self.fit(&start, &held, point.weight, CONVERGED)?;
        }
    }

    /// Sensitivity of the cells to all numbers at a point.
    pub fn sensitivity(&self, point: &Point) -> Result<DMatrix<f64>> {
        jacobian(&|p| self.residual(p), &point.fit.point, &[false; MOVABLE.len()])
            .ok_or_else(|| anyhow!("no derivative at the solution"))
    }
}

/// Curvature of ln misfit over ln distance at each point, from the circle through it and its neighbours; positive
/// where the curve bends up, zero at the ends.
pub fn bends(path: &[Point]) -> Vec<f64> {
    let places: Vec<[f64; 2]> =
        path.iter().map(|point| [point.distance(), point.misfit()].map(libm::log)).collect();
    let mut bends = vec![0.0; path.len()];
    for (bend, window) in bends.iter_mut().skip(1).zip(places.windows(3)) {
        *bend = curvature([window[0], window[1], window[2]]);
    }
    bends
}

/// The knee: the first local maximum of curvature, starting from the published set. Later ones are between local
/// minima.
fn knee(path: &[Point]) -> Option<usize> {
    let bends = bends(path);
    let inner = 1..path.len().saturating_sub(2);
    inner.into_iter().find(|&i| bends[i] > 0.0 && bends[i] > bends[i + 1])
}

fn curvature([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let side = |p: [f64; 2], q: [f64; 2]| libm::hypot(q[0] - p[0], q[1] - p[1]);
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    2.0 * area / (side(a, b) * side(b, c) * side(c, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curvature_of_a_circle_is_one_over_its_radius() {
        let at = |angle: f64| [2.0 * libm::cos(angle), 2.0 * libm::sin(angle)];
        // The lower left of a circle, passed from the left to the right, is a knee.
        let found = curvature([at(3.5), at(4.0), at(4.5)]);
        assert!((found - 0.5).abs() < 1e-12);
    }

    #[test]
    fn room_in_trim_is_free() {
        assert_eq!(excess(0.7, [-1.0, 1.0]), 0.0);
        assert!((excess(-0.8, [-1.0, 1.0]) - 1.0).abs() < 1e-12);
        assert!((excess(9.5, [0.0, 10.0]) - 3.0).abs() < 1e-12);
    }
}
