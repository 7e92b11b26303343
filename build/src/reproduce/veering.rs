//! The structure alone while the sloshing frequency moves: which mode is slosh, which is beam.

use ahv::modes::{MODES, Modes};
use ahv::vehicle::{Build, Configuration, Data, structure};
use anyhow::Result;
use serde::Serialize;

/// rad/s: across the first flexible frequency, full and half empty.
const FROM: f64 = 2.0;
const TO: f64 = 40.0;
const STEPS: usize = 190;

/// Two neighbouring modes where they come closest.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Encounter {
    /// Of the liquid in a tank at rest, rad/s.
    pub slosh_frequency: f64,
    pub lower: f64,
    pub upper: f64,
    /// Part of the strain energy that is in the springs of the liquid.
    pub lower_share: f64,
    pub upper_share: f64,
}

/// The five modes, by frequency, at every sloshing frequency.
#[derive(Debug, Clone, Serialize)]
pub struct Veering {
    pub fuel: f64,
    pub steps: Vec<f64>,
    pub omega: [Vec<f64>; MODES],
    /// Part of the strain energy that is in the springs of the liquid.
    pub slosh: [Vec<f64>; MODES],
    /// Of the lowest and the next, and of that and the third.
    pub encounters: [Encounter; 2],
}

impl Veering {
    pub fn new(data: &Data, base: &Build, fuel: f64) -> Result<Self> {
        let mut steps = Vec::with_capacity(STEPS + 1);
        let mut omega: [Vec<f64>; MODES] = Default::default();
        let mut slosh: [Vec<f64>; MODES] = Default::default();
        for step in 0..=STEPS {
            let frequency = FROM + (TO - FROM) * step as f64 / STEPS as f64;
            let build = Build {
                configuration: Configuration::SloshBeam,
                fuel_fraction: fuel,
                slosh_frequency: frequency,
                ..*base
            };
            let (beam, oscillators) = structure(data, &build)?;
            let modes = Modes::solve(&beam, &oscillators)?;
            let mut order: Vec<usize> = (0..MODES).collect();
            let rate = &modes.omega_rad_per_s;
            order.sort_by(|&a, &b| rate[a].total_cmp(&rate[b]));
            steps.push(frequency);
            for (rank, i) in order.into_iter().enumerate() {
                omega[rank].push(rate[i]);
                slosh[rank].push(1.0 - modes.beam_energy_share[i]);
            }
        }
        let encounters = [0, 1].map(|lower| encounter(&steps, &omega, &slosh, lower));
        Ok(Self { fuel, steps, omega, slosh, encounters })
    }

    /// Change of a mode's frequency since the first step, per cent.
    pub fn change(&self, mode: usize) -> Vec<f64> {
        let first = self.omega[mode][0];
        self.omega[mode].iter().map(|omega| 100.0 * (omega / first - 1.0)).collect()
    }

    /// Sloshing frequency from which on the lowest mode is more beam than liquid.
    pub fn exchange(&self) -> Option<f64> {
        let mixed = |share: &[f64]| share[0] > 0.5 && share[1] <= 0.5;
        self.slosh[0].windows(2).position(mixed).map(|step| self.steps[step + 1])
    }
}

/// Where the gap between two neighbours is smallest against their frequency, of the steps at which
/// the upper one is partly beam: two tanks alone are close everywhere.
fn encounter(
    steps: &[f64],
    omega: &[Vec<f64>; MODES],
    slosh: &[Vec<f64>; MODES],
    lower: usize,
) -> Encounter {
    let gap = |i: usize| (omega[lower + 1][i] - omega[lower][i]) / omega[lower][i];
    let beam = |i: usize| f64::max(1.0 - slosh[lower][i], 1.0 - slosh[lower + 1][i]);
    let i = (0..steps.len())
        .filter(|&i| beam(i) > 0.25)
        .min_by(|&a, &b| gap(a).total_cmp(&gap(b)))
        .unwrap_or(0);
    Encounter {
        slosh_frequency: steps[i],
        lower: omega[lower][i],
        upper: omega[lower + 1][i],
        lower_share: slosh[lower][i],
        upper_share: slosh[lower + 1][i],
    }
}
