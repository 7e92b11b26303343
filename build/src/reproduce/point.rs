//! The vehicle in one configuration, trimmed and linearised.

use super::roots::{Metric, Root, name_poles, name_zeros, roots};
use ahv::beam::{Beam, Oscillator};
use ahv::dynamics::{RIGID, Vehicle};
use ahv::linear::{Linear, OUTPUT_STATES};
use ahv::modes::{FLEXIBLE, Modes, SLOSH};
use ahv::trim::{Trim, trim};
use ahv::vehicle::{Build, Configuration, Data, structure};
use anyhow::{Context, Result};
use nalgebra::DMatrix;

/// All that the report needs to know of one vehicle.
#[derive(Debug, Clone)]
pub struct Point {
    pub vehicle: Vehicle,
    pub linear: Linear,
    pub metric: Metric,
    pub poles: Vec<Root>,
    pub zeros: Vec<Root>,
}

impl Point {
    pub fn new(data: &Data, build: &Build) -> Result<Self> {
        let failed = || {
            format!(
                "{:?} with {:?}, {:.0} % fuel, sloshing at {} rad/s with damping {}",
                build.configuration,
                build.aero,
                100.0 * build.fuel_fraction,
                build.slosh_frequency,
                build.slosh_damping
            )
        };
        let vehicle = Vehicle::new(data, build).with_context(failed)?;
        let trim = trim(&vehicle, &build.condition).with_context(failed)?;
        let linear = Linear::new(&vehicle, &trim.state, &trim.control);
        let (beam, oscillators) = structure(data, build)?;
        let modes = match build.configuration {
            Configuration::Rigid => Modes::default(),
            _ => Modes::solve(&beam, &oscillators)?,
        };
        let metric = metric(&vehicle, &trim, &beam, &oscillators, &modes);
        let slosh = vehicle.modes.saturating_sub(FLEXIBLE);
        let [poles, zeros] = named_roots(&linear, &metric, slosh, vehicle.modes > 0);
        Ok(Self { vehicle, linear, metric, poles, zeros })
    }

    /// Poles and zeros if the slosh modes are left out of the equations of flight.
    pub fn without_slosh(&self) -> [Vec<Root>; 2] {
        let kept = self.linear.a.nrows().min(RIGID + 2 * FLEXIBLE);
        let linear = Linear {
            a: self.linear.a.view((0, 0), (kept, kept)).into_owned(),
            b: self.linear.b.rows(0, kept).into_owned(),
            c: self.linear.c.columns(0, kept).into_owned(),
        };
        let matrix = self.metric.matrix.columns(0, kept).into_owned();
        let metric = Metric { matrix, sloshing: self.metric.sloshing };
        named_roots(&linear, &metric, 0, true)
    }
}

fn named_roots(linear: &Linear, metric: &Metric, slosh: usize, flexible: bool) -> [Vec<Root>; 2] {
    let all: Vec<usize> = (0..linear.a.nrows()).collect();
    let mut poles = roots(&linear.a, &linear.poles(), &all, metric);
    name_poles(&mut poles, slosh, flexible);
    let mut zeros = Vec::new();
    if let Some(matrix) = linear.zero_dynamics() {
        let hidden: Vec<usize> =
            all.into_iter().filter(|state| !OUTPUT_STATES.contains(state)).collect();
        zeros = roots(&matrix, &linear.zeros(), &hidden, metric);
        name_zeros(&mut zeros, slosh, flexible);
    }
    [poles, zeros]
}

/// The kinetic energy of a motion is half the squared length of metric times state.
fn metric(
    vehicle: &Vehicle,
    trim: &Trim,
    beam: &Beam,
    oscillators: &[Oscillator],
    modes: &Modes,
) -> Metric {
    let elements = beam.elements();
    let rigid = super::roots::RIGID_ROWS;
    let sloshing = oscillators.len().min(SLOSH);
    let mut matrix = DMatrix::zeros(rigid + elements + sloshing, vehicle.states());
    let mass = vehicle.airframe.mass.sqrt();
    matrix[(0, 0)] = mass;
    matrix[(1, 2)] = mass * trim.state[0];
    matrix[(2, 4)] = vehicle.airframe.inertia.sqrt();
    for (i, shape) in modes.shape.iter().enumerate() {
        let rate = RIGID + 2 * i + 1;
        for e in 0..elements {
            let middle = 0.5 * (shape.w[e] + shape.w[e + 1]);
            matrix[(rigid + e, rate)] = (beam.density[e] * beam.element_m).sqrt() * middle;
        }
        for (j, oscillator) in oscillators.iter().enumerate() {
            let moves = shape.w[oscillator.node] + modes.slosh_displacement[j][i];
            matrix[(rigid + elements + j, rate)] = oscillator.mass.sqrt() * moves;
        }
    }
    Metric { matrix, sloshing }
}
