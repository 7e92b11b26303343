//! Printed data on beam and tanks, their values with given numbers, and the numbers nearest to the prior that give
//! the printed data.

use super::numbers::{CENTRES, COORDINATES, Prior, rounded};
use crate::identify::cells::{short_period, size};
use crate::identify::levenberg_marquardt::{End, Fit, minimise};
use crate::published::Published;
use ahv::data::{AeroData, Data, VehicleData};
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::trim;
use ahv::flight::Parameters;
use ahv::structure::FLEXIBLE;
use ahv::vehicle::{Configuration, Vehicle, VehicleDefinition, VehicleOptions};
use anyhow::{Context, Result};
use nalgebra::DVector;

/// Frequencies of Table 1: the even column, then the slosh column.
pub const FREQUENCIES: usize = 2 * FLEXIBLE;
/// The frequencies, then the growth of the short period from even to sloshing mass.
pub const DATA: usize = FREQUENCIES + 1;
/// Index of that growth.
pub const GROWTH: usize = FREQUENCIES;
/// Standard deviations of the data: of a frequency half of the last printed digit, rad/s; of the growth its
/// difference between printed and published coefficients, which are not those of the paper.
pub const DOUBT: [f64; DATA] = [0.005, 0.005, 0.005, 0.005, 0.005, 0.005, 0.01];
/// Weights of the prior, decreasing to 1.
const WEIGHTS: [f64; 4] = [1e6, 1e4, 1e2, 1.0];
/// End of the searches at intermediate weights, and of the last one, far below the written digits.
const NEAR: End = (1e-2, 200);
const CONVERGED: End = (1e-7, 200);

/// The printed data: Table 1, rad/s, and the growth factor of the short period of Table 2 from even to sloshing
/// mass, in geometric means of its two poles. It depends on the position of the liquid and hardly on the
/// coefficients, which are not known.
pub fn printed() -> Result<[f64; DATA]> {
    let Published { table1, table2, .. } = Published::embedded()?;
    let mut all = [0.0; DATA];
    all[..FLEXIBLE].copy_from_slice(&table1.even);
    all[FLEXIBLE..FREQUENCIES].copy_from_slice(&table1.slosh);
    all[GROWTH] = size(table2.slosh.short_term) / size(table2.even.short_term);
    Ok(all)
}

/// Data to be met, and the vehicle.
pub struct Model {
    pub prior: Prior,
    pub wanted: [f64; DATA],
    data: Data,
    options: VehicleOptions,
    set: AeroData,
}

/// Result of the identification.
pub struct Solution {
    pub fit: Fit,
    /// Rounded to the written digits.
    pub vehicle: VehicleData,
}

impl Model {
    pub fn new(data: Data, wanted: [f64; DATA]) -> Result<Self> {
        let options = Parameters::new(&data).options;
        let prior = Prior::new(&data.vehicle, wanted[0])?;
        // The published coefficients, on the body that they were identified for.
        let set = AeroData { inertia: data.xu2015.inertia.clone(), ..(*data.parker2007).clone() };
        Ok(Self { prior, wanted, data, options, set })
    }

    /// Flexible frequencies of a configuration, rad/s, and the size of its short period with the
    /// published coefficients.
    fn column(&self, vehicle: &VehicleData, configuration: Configuration) -> Option<[f64; 4]> {
        let data = Data { vehicle: vehicle.clone().into(), ..self.data.clone() };
        let options = VehicleOptions { configuration, ..self.options };
        let vehicle = Vehicle::from_definition(&VehicleDefinition::with_coefficients(
            &data, &options, &self.set,
        ))
        .ok()?;
        let trim = trim(&vehicle, &options.condition).ok()?;
        let linear = LinearModel::new(&vehicle, &trim.state, &trim.control);
        let [a, b, c, ..] = vehicle.omega;
        Some([a, b, c, size(short_period(&linear)?)])
    }

    /// Values in the order of [`printed`]. A sloshing mass is attached to a node; for a tank between two nodes the
    /// values are interpolated, so that they are continuous in its centre.
    pub fn found(&self, vehicle: &VehicleData) -> Option<[f64; DATA]> {
        let even = self.column(vehicle, Configuration::EvenMassBeam)?;
        let element = vehicle.geometry.length_m.value / f64::from(vehicle.beam.elements.value);
        let places = [0, 1].map(|j| neighbours(vehicle.tank[j].centre_m.value / element));
        let mut slosh = [0.0; 4];
        for (fore, first) in places[0] {
            for (aft, second) in places[1] {
                if first * second == 0.0 {
                    continue;
                }
                let mut hung = vehicle.clone();
                hung.tank[0].centre_m.value = fore * element;
                hung.tank[1].centre_m.value = aft * element;
                let column = self.column(&hung, Configuration::SloshBeam)?;
                slosh.iter_mut().zip(column).for_each(|(sum, x)| *sum += first * second * x);
            }
        }
        let [a, b, c, before] = even;
        let [d, e, f, after] = slosh;
        Some([a, b, c, d, e, f, after / before])
    }

    /// Differences from the data over [`DOUBT`].
    pub fn residual(&self, point: &DVector<f64>) -> Option<DVector<f64>> {
        let found = self.found(&self.prior.vehicle(point))?;
        let off = (0..DATA).map(|i| (found[i] - self.wanted[i]) / DOUBT[i]);
        Some(DVector::from_iterator(DATA, off))
    }

    /// The numbers nearest to the prior that give the data.
    pub fn solve(&self) -> Result<Solution> {
        let mut point = DVector::zeros(COORDINATES);
        let mut held = [false; COORDINATES];
        for weight in WEIGHTS {
            point = self.minimise(&point, &held, weight, NEAR)?.point;
        }
        // Sloshing masses are attached to nodes: centres move to the nearest node, then the rest is fitted again.
        let element = self.data.vehicle.geometry.length_m.value
            / f64::from(self.data.vehicle.beam.elements.value);
        let vehicle = self.prior.vehicle(&point);
        for (j, i) in CENTRES.into_iter().enumerate() {
            let node = (vehicle.tank[j].centre_m.value / element).round();
            point[i] = self.prior.centre_coordinate(j, node * element);
            held[i] = true;
        }
        let fit = self.minimise(&point, &held, 1.0, CONVERGED)?;
        let vehicle = rounded(self.prior.vehicle(&fit.point));
        Ok(Solution { fit, vehicle })
    }

    fn minimise(&self, start: &DVector<f64>, held: &[bool], weight: f64, end: End) -> Result<Fit> {
        minimise(&|point| self.residual(point), start, held, weight, end)
            .with_context(|| format!("weight {weight:.0e}"))
    }
}

/// The nodes on both sides of a position (in elements), and their weights.
fn neighbours(place: f64) -> [(f64, f64); 2] {
    /// Distance from a node that counts as rounding error.
    const ON: f64 = 1e-9;
    let node = place.round();
    if (place - node).abs() < ON {
        return [(node, 1.0), (node, 0.0)];
    }
    let below = place.floor();
    [(below, below + 1.0 - place), (below + 1.0, place - below)]
}
