//! Best fit with one inertia and free stations, and the stations of a set.

use super::l_curve::{Model, Point};
use super::levenberg_marquardt::CONVERGED;
use super::numbers::{GAMMA_OFFSET, MASS_CENTRE, MOVABLE};
use ahv::data::AeroData;
use ahv::vehicle::VehicleDefinition;
use anyhow::{Result, anyhow};
use serde::Serialize;

/// Free numbers: stations, inertia, structural damping and elastic terms. The rigid coefficients are published,
/// except the elevator's arm.
const FREE: [&str; 8] = [
    "inertia.i_yy_kg_m2_per_m",
    MASS_CENTRE,
    GAMMA_OFFSET,
    "moment.delta_e",
    "inertia.structural_damping.0",
    "inertia.structural_damping.1",
    "inertia.structural_damping.2",
    "reference.elastic_scale",
];
/// A negligible weight, which keeps the normal equations regular.
const WEIGHT: f64 = 1e-4;

const FOOT: f64 = 0.3048;

/// Stations of a set, ft from the nose; columns are rigid, even mass, sloshing mass.
#[derive(Debug, Clone, Serialize)]
pub struct Stations {
    pub i_yy_kg_m2_per_m: f64,
    pub mass_centre_ft: [f64; 3],
    /// Station of gamma in Table 3.
    pub gamma_ft: [f64; 3],
    /// Station at which the elevator's lift gives its moment.
    pub elevator_ft: f64,
}

impl Model {
    /// The best fit, starting from a chosen point, with all other numbers published.
    pub fn best(&self, chosen: &Point) -> Result<Point> {
        let held = MOVABLE.map(|(key, _)| !FREE.contains(&key));
        let mut start = chosen.fit.point.clone();
        start.iter_mut().zip(held).filter(|(_, held)| *held).for_each(|(x, _)| *x = 0.0);
        self.fit(&start, &held, WEIGHT, CONVERGED)
    }

    /// The stations of a set.
    pub fn stations(&self, set: &AeroData) -> Result<Stations> {
        let (mut mass_centre_ft, mut gamma_ft) = ([0.0; 3], [0.0; 3]);
        for ((centre, gamma), options) in
            mass_centre_ft.iter_mut().zip(&mut gamma_ft).zip(&self.columns)
        {
            let definition = VehicleDefinition::with_coefficients(&self.data, options, set);
            let centre_m = self.bodies.of(&definition)?.properties.centre_m;
            *centre = centre_m / FOOT;
            *gamma = definition.with_imu_of_table_3(centre_m).options.stations.imu / FOOT;
        }
        let of = |fit: &ahv::data::PolynomialData| fit.delta_e.as_ref().map(|slope| slope.value);
        let (Some(lift), Some(moment)) = (of(&set.lift), of(&set.moment)) else {
            return Err(anyhow!("an elevator without lift or moment"));
        };
        let arm = -moment / lift * set.reference.chord_m.value;
        let elevator_ft = (set.reference.moment_centre_m.value + arm) / FOOT;
        let i_yy_kg_m2_per_m = set.inertia.i_yy_kg_m2_per_m.value;
        Ok(Stations { i_yy_kg_m2_per_m, mass_centre_ft, gamma_ft, elevator_ft })
    }
}

impl Stations {
    /// Text of the stations.
    pub fn text(&self) -> String {
        let [_, even, slosh] = self.mass_centre_ft;
        let [_, even_gamma, slosh_gamma] = self.gamma_ft;
        format!(
            "inertia {:.3e} kg m^2/m; mass centre {:.1} (rigid), {even:.1} (even mass), {slosh:.1} ft \
             (sloshing mass); gamma at {even_gamma:.1} and {slosh_gamma:.1} ft; elevator's lift at \
             {:.1} ft",
            self.i_yy_kg_m2_per_m, self.mass_centre_ft[0], self.elevator_ft
        )
    }
}
