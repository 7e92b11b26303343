//! The vehicle in one configuration, trimmed and linearised.

use super::roots::{BODY_ROWS, Metric, RIGID_ROWS, Root, name_poles, name_zeros, roots};
use ahv::data::Data;
use ahv::dynamics::linear::{LinearModel, OUTPUT_STATES};
use ahv::dynamics::trim::{Trim, trim};
use ahv::structure::{FLEXIBLE, RigidMotion, SLOSH};
use ahv::vehicle::{Body, V, Vehicle, VehicleDefinition, VehicleOptions, eta, eta_dot};
use anyhow::{Context, Result};
use nalgebra::DMatrix;

/// The flight-path angle that is the second output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gamma {
    /// That of the point of the body that Table 3 uses.
    Printed,
    /// That of the mean axes, gamma of eq. (3).
    MeanAxes,
}

/// A trimmed and linearised vehicle.
#[derive(Debug, Clone)]
pub struct OperatingPoint {
    pub vehicle: Vehicle,
    pub linear: LinearModel,
    pub metric: Metric,
    pub poles: Vec<Root>,
    pub zeros: Vec<Root>,
}

impl OperatingPoint {
    pub fn new(data: &Data, options: &VehicleOptions) -> Result<Self> {
        Self::of(VehicleDefinition::new(data, options), Gamma::Printed)
    }

    /// With any coefficient set.
    pub fn of(definition: VehicleDefinition, gamma: Gamma) -> Result<Self> {
        let options = definition.options;
        let failed = || {
            format!(
                "{:?} with {:?}, {:.0} % fuel, sloshing at {} rad/s with damping {}",
                options.configuration,
                options.aero,
                100.0 * options.fuel_fraction,
                options.slosh_frequency,
                options.slosh_damping
            )
        };
        let body = Body::new(&definition).with_context(failed)?;
        let definition = definition.with_imu_of_table_3(body.properties.centre_m);
        let vehicle = Vehicle::with_body(&definition, &body).with_context(failed)?;
        let trim = trim(&vehicle, &options.condition).with_context(failed)?;
        let linearise = match gamma {
            Gamma::Printed => LinearModel::with_imu_gamma,
            Gamma::MeanAxes => LinearModel::new,
        };
        let linear = linearise(&vehicle, &trim.state, &trim.control);
        let metric = metric(&vehicle, &trim, &body);
        let slosh = vehicle.modes.saturating_sub(FLEXIBLE);
        let [poles, zeros] = named_roots(&linear, &metric, slosh, vehicle.modes > 0);
        Ok(Self { vehicle, linear, metric, poles, zeros })
    }

    /// Poles and zeros without the slosh modes.
    pub fn without_slosh(&self) -> [Vec<Root>; 2] {
        let kept = self.linear.a.nrows().min(eta(FLEXIBLE));
        let linear = LinearModel {
            a: self.linear.a.view((0, 0), (kept, kept)).into_owned(),
            b: self.linear.b.rows(0, kept).into_owned(),
            c: self.linear.c.columns(0, kept).into_owned(),
        };
        let matrix = self.metric.matrix.columns(0, kept).into_owned();
        let metric = Metric { matrix, sloshing: self.metric.sloshing };
        named_roots(&linear, &metric, 0, true)
    }
}

fn named_roots(
    linear: &LinearModel,
    metric: &Metric,
    slosh: usize,
    flexible: bool,
) -> [Vec<Root>; 2] {
    let mut poles = roots(&linear.a, &linear.poles(), metric);
    name_poles(&mut poles, slosh, flexible);
    let mut zeros = Vec::new();
    if let Some(matrix) = linear.zero_dynamics() {
        let matrix_of = &metric.matrix * held(&linear.c);
        let metric = Metric { matrix: matrix_of, sloshing: metric.sloshing };
        zeros = roots(&matrix, &linear.zeros(), &metric);
        name_zeros(&mut zeros, slosh, flexible);
    }
    [poles, zeros]
}

/// Map from all states but V and gamma to all states with both outputs held: V is constant, and gamma of the
/// mean axes compensates the motion of the sensor relative to them.
fn held(c: &DMatrix<f64>) -> DMatrix<f64> {
    let [_, gamma] = OUTPUT_STATES;
    let hidden: Vec<usize> = (0..c.ncols()).filter(|row| !OUTPUT_STATES.contains(row)).collect();
    let mut held = DMatrix::zeros(c.ncols(), hidden.len());
    for (column, row) in hidden.into_iter().enumerate() {
        held[(row, column)] = 1.0;
        held[(gamma, column)] = -c[(1, row)] / c[(1, gamma)];
    }
    held
}

/// Metric of the kinetic energy, which is half the squared length of metric times state. Its mass matrix is that
/// in which the modes are orthogonal: density for bending; mass, mass centre and inertia of the body
/// ([`ahv::structure`]) for its mean translation and rotation.
fn metric(vehicle: &Vehicle, trim: &Trim, body: &Body) -> Metric {
    let Body { beam, oscillators, modes, .. } = body;
    let elements = beam.elements();
    let sloshing = oscillators.len().min(SLOSH);
    let bent = RIGID_ROWS + BODY_ROWS;
    let mut matrix = DMatrix::zeros(bent + elements + sloshing, vehicle.states());
    let mass = vehicle.airframe.mass.sqrt();
    matrix[(0, 0)] = mass;
    matrix[(1, 2)] = mass * trim.state[V];
    matrix[(2, 4)] = vehicle.airframe.inertia.sqrt();
    let motion = RigidMotion::of(beam);
    // The root of [[mass, first], [first, inertia]].
    let translation = motion.mass.sqrt();
    let coupling = beam.correction.first / translation;
    let rotation = (motion.inertia + beam.correction.second - coupling * coupling).sqrt();
    for (i, shape) in modes.shape.iter().enumerate() {
        let rate = eta_dot(i);
        let [moved, turned] = motion.part(&shape.w, &shape.slope);
        matrix[(RIGID_ROWS, rate)] = translation * moved + coupling * turned;
        matrix[(RIGID_ROWS + 1, rate)] = rotation * turned;
        for e in 0..elements {
            let station = 0.5 * (beam.station(e) + beam.station(e + 1));
            let rigidly = moved + turned * (station - motion.centre_m);
            let middle = 0.5 * (shape.w[e] + shape.w[e + 1]) - rigidly;
            matrix[(bent + e, rate)] = (beam.density[e] * beam.element_m).sqrt() * middle;
        }
        for (j, oscillator) in oscillators.iter().enumerate() {
            let moves = shape.w[oscillator.node] + modes.slosh_displacement[j][i];
            matrix[(bent + elements + j, rate)] = oscillator.mass.sqrt() * moves;
        }
    }
    Metric { matrix, sloshing }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ahv::flight::Parameters;
    use ahv::structure::Modes;
    use ahv::vehicle::Configuration;

    #[test]
    fn the_energy_of_a_mode_is_that_of_the_one_mass_matrix() {
        let data = Data::embedded().unwrap();
        let default = Parameters::new(&data).options;
        for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
            let definition =
                VehicleDefinition::new(&data, &VehicleOptions { configuration, ..default });
            let (beam, oscillators) = definition.structure().unwrap();
            let modes = Modes::solve(&beam, &oscillators).unwrap();
            let metric = OperatingPoint::of(definition, Gamma::Printed).unwrap().metric.matrix;
            let energy = metric.tr_mul(&metric);
            for i in 0..modes.count {
                for k in 0..modes.count {
                    let entry = energy[(eta_dot(i), eta_dot(k))];
                    let scale = (modes.modal_mass[i] * modes.modal_mass[k]).sqrt();
                    let expected = f64::from(i == k);
                    assert!((entry / scale - expected).abs() < 1e-3, "{i}, {k}: {entry}");
                }
            }
        }
    }
}
