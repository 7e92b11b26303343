//! Frequency veering of the structure without air: slosh and bending modes over the sloshing frequency.

use ahv::data::Data;
use ahv::structure::{MODES, Modes};
use ahv::vehicle::{Configuration, VehicleOptions, structure};
use anyhow::Result;
use serde::Serialize;

/// rad/s: across the first flexible frequency, full and half empty.
const FROM: f64 = 2.0;
const TO: f64 = 40.0;
const STEPS: usize = 190;

/// The point where the lowest mode changes from slosh to bending.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Exchange {
    /// Sloshing frequency of the liquid in a fixed tank, rad/s.
    pub slosh_frequency: f64,
    /// The three lowest modes there, rad/s.
    pub omega: [f64; 3],
    /// Share of their strain energy in the springs of the liquid.
    pub slosh: [f64; 3],
}

/// The five modes, by frequency, at every sloshing frequency.
#[derive(Debug, Clone, Serialize)]
pub struct Veering {
    pub fuel: f64,
    pub steps: Vec<f64>,
    pub omega: [Vec<f64>; MODES],
    /// Share of the strain energy in the springs of the liquid.
    pub slosh: [Vec<f64>; MODES],
    pub exchange: Option<Exchange>,
}

impl Veering {
    pub fn new(data: &Data, base: &VehicleOptions, fuel: f64) -> Result<Self> {
        let mut steps = Vec::with_capacity(STEPS + 1);
        let mut omega: [Vec<f64>; MODES] = Default::default();
        let mut slosh: [Vec<f64>; MODES] = Default::default();
        for step in 0..=STEPS {
            let frequency = FROM + (TO - FROM) * step as f64 / STEPS as f64;
            let options = VehicleOptions {
                configuration: Configuration::SloshBeam,
                fuel_fraction: fuel,
                slosh_frequency: frequency,
                ..*base
            };
            let (beam, oscillators) = structure(data, &options)?;
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
        let turns = |share: &[f64]| share[0] > 0.5 && share[1] <= 0.5;
        let exchange = slosh[0].windows(2).position(turns).map(|step| Exchange {
            slosh_frequency: steps[step + 1],
            omega: [0, 1, 2].map(|mode| omega[mode][step + 1]),
            slosh: [0, 1, 2].map(|mode| slosh[mode][step + 1]),
        });
        Ok(Self { fuel, steps, omega, slosh, exchange })
    }

    /// Change of a mode's frequency since the first step, per cent.
    pub fn change(&self, mode: usize) -> Vec<f64> {
        let first = self.omega[mode][0];
        self.omega[mode].iter().map(|omega| 100.0 * (omega / first - 1.0)).collect()
    }
}
