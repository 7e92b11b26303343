//! What the paper prints, and vehicles seen as its tables see them.

use crate::model::{data, options};
use ahv::data::AeroSet::{self, Parker2007};
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::{Trim, trim};
use ahv::vehicle::{Body, Configuration, Vehicle, VehicleDefinition, VehicleOptions};
use nalgebra::Complex;

/// Pitch inertia, kg m^2/m, with which the published fits give the printed rigid column at 55 ft.
/// The printed 2.224e5 and the published 2.224e6 both fail.
pub const INERTIA: f64 = 6.4e5;

/// Columns with flexible modes.
pub const FLEXIBLE: [(&str, Configuration); 2] =
    [("even", Configuration::EvenMassBeam), ("slosh", Configuration::SloshBeam)];

pub fn published() -> toml::Table {
    include_str!("../../src/data/published.toml").parse().expect("valid TOML")
}

pub fn floats(value: &toml::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|entry| entry.as_float().unwrap()).collect()
}

/// A vehicle in trim.
pub struct Seen {
    pub vehicle: Vehicle,
    pub trim: Trim,
    /// Outputs V and gamma where Table 3 reads it.
    pub linear: LinearModel,
}

impl Seen {
    pub fn new(definition: VehicleDefinition) -> Self {
        let body = Body::new(&definition).expect("the vehicle has a structure");
        let definition = definition.with_imu_of_table_3(body.properties.centre_m);
        let vehicle = Vehicle::with_body(&definition, &body).expect("the vehicle can be built");
        let trim = trim(&vehicle, &definition.options.condition).expect("the vehicle has a trim");
        let linear = LinearModel::with_imu_gamma(&vehicle, &trim.state, &trim.control);
        Self { vehicle, trim, linear }
    }

    /// Outputs V and gamma of the mean axes.
    pub fn mean_axes(&self) -> LinearModel {
        LinearModel::new(&self.vehicle, &self.trim.state, &self.trim.control)
    }
}

/// The default vehicle of a configuration with a set.
pub fn seen(set: AeroSet, configuration: Configuration) -> Seen {
    let options = VehicleOptions { aero: set, ..options(configuration) };
    Seen::new(VehicleDefinition::new(&data(), &options))
}

/// The published set with another inertia, elastic terms and mass centre, m aft.
pub fn moved(configuration: Configuration, inertia: f64, elastic: f64, shift: f64) -> Seen {
    let mut options = VehicleOptions { aero: Parker2007, ..options(configuration) };
    options.factors.mass_centre_shift_m = shift;
    let data = data();
    let mut set = data.parker2007.clone();
    set.inertia.i_yy_kg_m2_per_m.value = inertia;
    set.reference.elastic_scale.value *= elastic;
    Seen::new(VehicleDefinition::with_coefficients(&data, &options, &set))
}

/// Descending.
pub fn real_parts(values: &[Complex<f64>]) -> Vec<f64> {
    let mut real: Vec<_> = values.iter().filter(|v| v.im == 0.0).map(|v| v.re).collect();
    real.sort_by(|a, b| b.total_cmp(a));
    real
}

/// The largest and the smallest real root: short period, or right and left zero.
pub fn ends(values: &[Complex<f64>]) -> [f64; 2] {
    let real = real_parts(values);
    [real[0], real[real.len() - 1]]
}

/// Geometric mean of a pair of opposite sign.
pub fn size([right, left]: [f64; 2]) -> f64 {
    (-right * left).sqrt()
}

/// Imaginary and real parts of the three fastest pairs, by frequency.
pub fn pairs(values: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let upper: Vec<_> = values.iter().copied().filter(|root| root.im > 0.0).collect();
    upper[upper.len() - 3..].to_vec()
}

/// Short period, real zeros and aeroelastic pairs [real, imaginary part] of a printed column.
pub struct Printed {
    pub short_period: [f64; 2],
    pub zeros: [f64; 2],
    pub poles: Vec<[f64; 2]>,
    pub pairs: Vec<[f64; 2]>,
}

pub fn printed(column: &str) -> Printed {
    let table = published();
    let aeroelastic = |name: &str| -> Vec<[f64; 2]> {
        let list = table[name][column].get("aeroelastic").and_then(|list| list.as_array());
        let pair = |value: &toml::Value| {
            let pair = floats(value);
            [pair[0], pair[1]]
        };
        list.map_or_else(Vec::new, |list| list.iter().map(pair).collect())
    };
    let first = |values: Vec<f64>| [values[0], values[1]];
    Printed {
        short_period: first(floats(&table["table2"][column]["short_term"])),
        zeros: first(floats(&table["table3"][column]["real"])),
        poles: aeroelastic("table2"),
        pairs: aeroelastic("table3"),
    }
}
