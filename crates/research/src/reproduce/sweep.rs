//! The sweeps of figs 6 to 8: poles and zeros over one parameter.

use super::operating_point::OperatingPoint;
use super::root_tracking::{assurance, matches};
use super::roots::{Name, Root};
use ahv::data::Data;
use ahv::vehicle::{Configuration, VehicleOptions};
use anyhow::Result;
use nalgebra::Complex;
use serde::{Serialize, Serializer};

/// One pole or zero along a sweep.
#[derive(Debug, Clone, Serialize)]
pub struct Branch {
    /// Its name at the start.
    pub name: Name,
    /// Real and imaginary part at every step, rad/s.
    #[serde(serialize_with = "pairs")]
    pub values: Vec<Complex<f64>>,
    /// Sloshing share of its elastic kinetic energy at every step.
    pub slosh: Vec<f64>,
}

fn pairs<S: Serializer>(values: &[Complex<f64>], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| [value.re, value.im]))
}

impl Branch {
    pub fn first(&self) -> Complex<f64> {
        self.values[0]
    }
}

/// The parameter of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    Fuel,
    Damping,
    Frequency,
}

/// A sweep: the parameter values and all branches.
#[derive(Debug, Clone, Serialize)]
pub struct Sweep {
    pub parameter: Parameter,
    /// Fuel fraction; damping ratio; rad/s.
    pub steps: Vec<f64>,
    pub poles: Vec<Branch>,
    pub zeros: Vec<Branch>,
    /// Lowest modal assurance between neighbouring steps of any elastic branch; near 1 if the tracking is
    /// unambiguous.
    pub weakest_match: f64,
}

impl Parameter {
    /// First and last value, and number of intervals.
    pub fn range(self) -> (f64, f64, usize) {
        match self {
            Self::Fuel => (1.0, 0.0, 400),
            Self::Damping => (0.05, 0.3, 50),
            Self::Frequency => (2.0, 30.0, 140),
        }
    }

    /// Intermediate values marked in the figures.
    pub fn marks(self) -> &'static [f64] {
        match self {
            Self::Fuel => &[0.75, 0.5, 0.25],
            Self::Damping => &[0.1, 0.15, 0.2, 0.25],
            Self::Frequency => &[5.0, 10.0, 15.0, 20.0, 25.0],
        }
    }

    fn options(self, base: &VehicleOptions, value: f64) -> VehicleOptions {
        let slosh = VehicleOptions { configuration: Configuration::SloshBeam, ..*base };
        let half = VehicleOptions { fuel_fraction: 0.5, ..slosh };
        match self {
            Self::Fuel => VehicleOptions { fuel_fraction: value, ..slosh },
            Self::Damping => VehicleOptions { slosh_damping: value, ..half },
            Self::Frequency => VehicleOptions { slosh_frequency: value, ..half },
        }
    }
}

impl Sweep {
    pub fn new(data: &Data, base: &VehicleOptions, parameter: Parameter) -> Result<Self> {
        let (from, to, count) = parameter.range();
        let steps: Vec<f64> =
            (0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect();
        let points = steps
            .iter()
            .map(|&value| OperatingPoint::new(data, &parameter.options(base, value)))
            .collect::<Result<Vec<_>>>()?;
        let mut weakest_match = 1.0;
        let poles = follow(points.iter().map(|point| &point.poles), &mut weakest_match);
        let zeros = follow(points.iter().map(|point| &point.zeros), &mut weakest_match);
        Ok(Self { parameter, steps, poles, zeros, weakest_match })
    }

    pub fn pole(&self, name: Name) -> Option<&Branch> {
        self.poles.iter().find(|branch| branch.name == name)
    }

    pub fn zero(&self, name: Name) -> Option<&Branch> {
        self.zeros.iter().find(|branch| branch.name == name)
    }

    /// The step nearest to a value of the parameter.
    pub fn step_at(&self, value: f64) -> usize {
        let distance = |i: usize| (self.steps[i] - value).abs();
        (0..self.steps.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }
}

/// Tracks every named root of the first step through all others.
fn follow<'a>(
    steps: impl Iterator<Item = &'a Vec<Root>> + Clone,
    weakest: &mut f64,
) -> Vec<Branch> {
    let Some(first) = steps.clone().next() else { return Vec::new() };
    let mut branches: Vec<(usize, Branch)> = first
        .iter()
        .enumerate()
        .filter_map(|(place, root)| {
            let (values, slosh) = (vec![root.value], vec![root.slosh]);
            Some((place, Branch { name: root.name?, values, slosh }))
        })
        .collect();
    for (from, to) in steps.clone().zip(steps.skip(1)) {
        let next = matches(from, to);
        for (place, branch) in &mut branches {
            let Some(k) = next[*place] else { continue };
            if matches!(branch.name, Name::Flexible(_) | Name::Slosh(_)) {
                *weakest = weakest.min(assurance(&from[*place], &to[k]));
            }
            *place = k;
            branch.values.push(to[k].value);
            branch.slosh.push(to[k].slosh);
        }
    }
    branches.into_iter().map(|(_, branch)| branch).collect()
}
