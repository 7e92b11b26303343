//! Frequencies of Table 1 from the numbers of beam and tanks, and the most ordinary numbers that
//! give them.

use super::numbers::{CENTRES, COORDINATES, Prior, rounded};
use crate::identify::fit::{Fit, minimise};
use ahv::beam::Oscillator;
use ahv::modes::{FLEXIBLE, Modes};
use ahv::parameters::Parameters;
use ahv::params::VehicleData;
use ahv::vehicle::{Build, Configuration, Data, structure};
use anyhow::{Context, Result};
use nalgebra::DVector;
use serde::Deserialize;

/// Frequencies of Table 1: the even column, then the slosh column.
pub const FREQUENCIES: usize = 2 * FLEXIBLE;
/// Half of the last printed digit, rad/s: one unit of misfit.
pub const PRINTED: f64 = 0.005;
/// Weights of the prior against that: first it holds all, at last it is worth what it says.
const WEIGHTS: [f64; 4] = [1e6, 1e4, 1e2, 1.0];
/// Steps that end the search on the way, and at its end: far below the digits that are written.
const NEAR: f64 = 1e-2;
const CONVERGED: f64 = 1e-7;

#[derive(Deserialize)]
struct Published {
    table1: Table1,
}

#[derive(Deserialize)]
struct Table1 {
    even: [f64; FLEXIBLE],
    slosh: [f64; FLEXIBLE],
}

/// Table 1, rad/s.
pub fn printed() -> Result<[f64; FREQUENCIES]> {
    let text = include_str!("../../../../src/data/published.toml");
    let Published { table1 } = toml::from_str(text).context("published.toml")?;
    let mut all = [0.0; FREQUENCIES];
    all[..FLEXIBLE].copy_from_slice(&table1.even);
    all[FLEXIBLE..].copy_from_slice(&table1.slosh);
    Ok(all)
}

/// What is to be met, and with what.
pub struct Model {
    pub prior: Prior,
    pub wanted: [f64; FREQUENCIES],
    data: Data,
    build: Build,
}

/// What came out.
pub struct Solution {
    pub fit: Fit,
    /// With the digits that are written.
    pub vehicle: VehicleData,
}

impl Model {
    pub fn new(data: Data, wanted: [f64; FREQUENCIES]) -> Result<Self> {
        let build = Parameters::new(&data).build;
        let prior = Prior::new(&data.vehicle, wanted[0])?;
        Ok(Self { prior, wanted, data, build })
    }

    /// The six frequencies, rad/s. A sloshing mass hangs on a node; between two nodes the
    /// frequencies are interpolated, so that they follow the centre of a tank without jumps.
    pub fn frequencies(&self, vehicle: &VehicleData) -> Option<[f64; FREQUENCIES]> {
        let data = Data { vehicle: vehicle.clone(), ..self.data.clone() };
        let of = |configuration| structure(&data, &Build { configuration, ..self.build }).ok();
        let (even, _) = of(Configuration::EvenMassBeam)?;
        let (slosh, oscillators) = of(Configuration::SloshBeam)?;
        let mut all = [0.0; FREQUENCIES];
        let modes = Modes::solve(&even, &[]).ok()?;
        all[..FLEXIBLE].copy_from_slice(&modes.omega_rad_per_s[..FLEXIBLE]);
        let places = [0, 1].map(|j| neighbours(vehicle.tank[j].centre_m.value / slosh.element_m));
        for (fore, first) in places[0] {
            for (aft, second) in places[1] {
                if first * second == 0.0 {
                    continue;
                }
                let hung = [(oscillators[0], fore), (oscillators[1], aft)]
                    .map(|(oscillator, node)| Oscillator { node, ..oscillator });
                if fore > slosh.elements() || aft > slosh.elements() {
                    return None;
                }
                let modes = Modes::solve(&slosh, &hung).ok()?;
                for (sum, omega) in all[FLEXIBLE..].iter_mut().zip(modes.omega_rad_per_s) {
                    *sum += first * second * omega;
                }
            }
        }
        Some(all)
    }

    /// Differences from the wanted frequencies over [`PRINTED`].
    pub fn residual(&self, point: &DVector<f64>) -> Option<DVector<f64>> {
        let vehicle = self.prior.vehicle(point);
        let found = self.frequencies(&vehicle)?;
        let off = found.iter().zip(self.wanted).map(|(found, wanted)| (found - wanted) / PRINTED);
        Some(DVector::from_iterator(FREQUENCIES, off))
    }

    /// The most ordinary numbers with the wanted frequencies.
    pub fn solve(&self) -> Result<Solution> {
        let mut point = DVector::zeros(COORDINATES);
        let mut held = [false; COORDINATES];
        for weight in WEIGHTS {
            point = self.minimise(&point, &held, weight, NEAR)?.point;
        }
        // The masses of the vehicle hang on nodes: the centres go there, the rest follows.
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

    fn minimise(
        &self,
        start: &DVector<f64>,
        held: &[bool],
        weight: f64,
        converged: f64,
    ) -> Result<Fit> {
        minimise(&|point| self.residual(point), start, held, weight, converged)
            .with_context(|| format!("weight {weight:.0e}"))
    }
}

/// The nodes on both sides of a place, in elements, and their weights.
fn neighbours(place: f64) -> [(usize, f64); 2] {
    /// A centre on a node, but for rounding.
    const ON: f64 = 1e-9;
    let node = place.round();
    if (place - node).abs() < ON {
        return [(node as usize, 1.0), (node as usize, 0.0)];
    }
    let below = place.floor();
    [(below as usize, below + 1.0 - place), (below as usize + 1, place - below)]
}
