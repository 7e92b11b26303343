//! The trade-off of `xu2015` for the report.

use super::cells::Cell;
use super::l_curve::{Model, Point};
use super::numbers::{MOVABLE, moves_by_difference, written_move};
use super::resolution::Resolution;
use super::stations::Stations;
use ahv::data::{AeroData, Data};
use anyhow::{Result, anyhow};
use nalgebra::DMatrix;
use serde::Serialize;

/// One point of the trade-off between tables and published numbers.
#[derive(Debug, Clone, Serialize)]
pub struct Place {
    /// Weight of the distance relative to the misfit.
    pub weight: f64,
    /// Sum over the numbers of (ln ratio / prior standard deviation)^2.
    pub distance: f64,
    /// Sum over the cells of (relative error / wanted accuracy)^2.
    pub misfit: f64,
}

/// One number of the coefficient set.
#[derive(Debug, Clone, Serialize)]
pub struct Moved {
    pub key: &'static str,
    pub published: f64,
    pub identified: f64,
    /// A factor, or a difference in m.
    pub moved_by: String,
    /// Whether it is adjusted by a difference.
    pub difference: bool,
    /// Prior standard deviation, as a factor or a difference.
    pub doubt: f64,
    /// Formal standard error, as a factor or a difference.
    pub error: f64,
    /// Share determined by the data; the rest is determined by the norm.
    pub decided_by_data: f64,
    /// The most sensitive of the fitted cells.
    pub strongest: String,
    /// Its relative change over that of the number.
    pub slope: f64,
    /// At the far end of the trade-off.
    pub far_moved_by: String,
    /// With one inertia and free stations.
    pub best_moved_by: String,
}

/// The trade-off and the identified set.
#[derive(Debug, Clone, Serialize)]
pub struct TradeOff {
    pub places: Vec<Place>,
    /// Index of the knee.
    pub knee: usize,
    /// The knee with small changes reset, which is the committed set.
    pub chosen: Place,
    pub numbers: Vec<Moved>,
    /// The best fit with one inertia and free stations, and its stations.
    pub best: Place,
    pub best_stations: Stations,
    /// Its smallest and largest relative errors: short period, geometric means of the real zeros.
    pub best_errors: [[f64; 2]; 2],
    /// Stations of the chosen set.
    pub stations: Stations,
    #[serde(skip)]
    pub best_set: AeroData,
}

fn place(point: &Point) -> Place {
    Place { weight: point.weight, distance: point.distance(), misfit: point.misfit() }
}

impl TradeOff {
    /// Computes the trade-off; `tell` is called for every place.
    pub fn new(tell: &dyn Fn(&Place)) -> Result<Self> {
        let model = Model::new(Data::embedded()?)?;
        let (path, knee) = model.path(&|point| tell(&place(point)))?;
        let chosen = model.sparse(&path[knee])?;
        let last = path.last().ok_or_else(|| anyhow!("an empty path"))?;
        let sensitivity = model.sensitivity(&chosen)?;
        let knowledge = Resolution::new(&sensitivity, chosen.weight)?;
        let set = |point: &Point| {
            model.origin.moved(&point.fit.point).ok_or_else(|| anyhow!("no such set"))
        };
        let best = model.best(&chosen)?;
        let best_set = set(&best)?;
        let best_cells = model.values(&best_set).ok_or_else(|| anyhow!("no trim"))?;
        let [far_values, best_values] =
            [last, &best].map(|point| model.origin.values(&point.fit.point));
        let values = model.origin.values(&chosen.fit.point);
        let number = |(i, ((key, doubt), [published, identified])): (usize, (_, [f64; 2]))| {
            let (strongest, slope) = strongest(&model, &sensitivity, i);
            Moved {
                key,
                published,
                identified,
                moved_by: written_move(key, [published, identified]),
                difference: moves_by_difference(key),
                doubt: scale(key, doubt),
                error: scale(key, doubt * knowledge.errors[i]),
                decided_by_data: knowledge.resolution[i],
                strongest,
                slope: slope / doubt,
                far_moved_by: written_move(key, far_values[i]),
                best_moved_by: written_move(key, best_values[i]),
            }
        };
        Ok(Self {
            places: path.iter().map(place).collect(),
            knee,
            chosen: place(&chosen),
            numbers: MOVABLE.into_iter().zip(values).enumerate().map(number).collect(),
            best: place(&best),
            best_errors: ["short-period pole", "real zeros"]
                .map(|name| errors(&model.cells, &best_cells, name)),
            best_stations: model.stations(&best_set)?,
            stations: model.stations(&set(&chosen)?)?,
            best_set,
        })
    }
}

/// A step of a coordinate, as a factor or a difference.
fn scale(key: &str, step: f64) -> f64 {
    if moves_by_difference(key) { step } else { libm::exp(step) }
}

/// Smallest and largest relative error of some cells.
fn errors(cells: &[Cell], values: &[f64], name: &str) -> [f64; 2] {
    let of = cells.iter().zip(values).filter(|(cell, _)| cell.name.starts_with(name));
    let sizes = of.map(|(cell, value)| cell.error(*value).abs());
    sizes.fold([f64::INFINITY, 0.0], |[least, most], size| [least.min(size), most.max(size)])
}

/// The cell that is most sensitive to a number, and its relative change per unit of the coordinate.
fn strongest(model: &Model, sensitivity: &DMatrix<f64>, number: usize) -> (String, f64) {
    let wanted = model.cells.iter().filter_map(|cell| Some((cell, cell.wanted?)));
    let slopes = wanted.enumerate().map(|(row, (cell, wanted))| {
        let what = format!("{} ({:?})", cell.name, cell.column);
        (what, sensitivity[(row, number)] * wanted)
    });
    slopes.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or_default()
}
