//! The unstable pole from full to empty tanks under several laws of inertia and mass centre: claim (b).

use super::operating_point::OperatingPoint;
use super::tables::short_period;
use ahv::data::Data;
use ahv::structure::MassProperties;
use ahv::vehicle::{Configuration, VehicleOptions, structure};
use anyhow::{Result, anyhow};
use serde::Serialize;

/// Fuel levels after the first.
const LEVELS: usize = 20;
/// Bisection steps; enough for three digits.
const HALVINGS: usize = 16;

/// Whether inertia and mass centre are constant as fuel burns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Held {
    inertia: bool,
    centre: bool,
}

const LAWS: [(&str, Held); 3] = [
    ("inertia of the densities", Held { inertia: false, centre: false }),
    ("constant inertia", Held { inertia: true, centre: false }),
    ("constant inertia and mass centre", Held { inertia: true, centre: true }),
];

/// The unstable short-period pole under one law.
#[derive(Debug, Clone, Serialize)]
pub struct Law {
    pub name: &'static str,
    /// At every level, from full to empty, rad/s.
    pub poles: Vec<f64>,
}

impl Law {
    pub fn change(&self) -> f64 {
        let (start, end) = (self.poles[0], self.poles[self.poles.len() - 1]);
        end / start - 1.0
    }
}

#[derive(Debug, Clone, Serialize)]
pub struct Laws {
    pub laws: Vec<Law>,
    /// Inertia of the empty vehicle over that of the full one, by the densities.
    pub empty_over_full: f64,
    /// The same ratio for a pole that does not move, and for one that moves as far as "slightly" allows;
    /// `None` if no inertia up to twice the full one gives it.
    pub still: Option<f64>,
    pub slight: Option<f64>,
}

struct Vehicle<'a> {
    data: &'a Data,
    base: VehicleOptions,
    full: MassProperties,
}

fn properties(data: &Data, options: &VehicleOptions) -> Result<MassProperties> {
    let (beam, oscillators) = structure(data, options)?;
    Ok(beam.mass_properties(&oscillators))
}

impl Vehicle<'_> {
    /// The pole at a fuel level; `inertia` is the ratio to full tanks, by default that of the densities.
    fn pole(&self, fuel: f64, inertia: Option<f64>, centre: bool) -> Result<f64> {
        let mut options = VehicleOptions { fuel_fraction: fuel, ..self.base };
        let own = properties(self.data, &options)?;
        if let Some(ratio) = inertia {
            options.factors.inertia *= ratio * self.full.inertia / own.inertia;
        }
        if centre {
            options.factors.mass_centre_shift_m += self.full.centre_m - own.centre_m;
        }
        let [unstable, _] = short_period(&OperatingPoint::new(self.data, &options)?.poles)
            .ok_or_else(|| anyhow!("the short period oscillates"))?;
        Ok(unstable)
    }

    /// The inertia of the empty vehicle over that of the full one at which the pole has this value.
    fn inertia_for(&self, pole: f64) -> Option<f64> {
        // The pole is faster with less inertia. Below some inertia no body exists.
        let above = |ratio: f64| self.pole(0.0, Some(ratio), false).is_ok_and(|found| found > pole);
        let (mut small, mut large) = (self.own_ratio().ok()?, 2.0);
        if above(large) || !above(small) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (small + large);
            if above(middle) { small = middle } else { large = middle }
        }
        Some(0.5 * (small + large))
    }

    fn own_ratio(&self) -> Result<f64> {
        let empty = properties(self.data, &VehicleOptions { fuel_fraction: 0.0, ..self.base })?;
        Ok(empty.inertia / self.full.inertia)
    }
}

impl Laws {
    /// `slight` is the largest change that counts as "slightly".
    pub fn new(data: &Data, base: &VehicleOptions, slight: f64) -> Result<Self> {
        let base =
            VehicleOptions { configuration: Configuration::SloshBeam, fuel_fraction: 1.0, ..*base };
        let vehicle = Vehicle { data, base, full: properties(data, &base)? };
        let law = |(name, held): (&'static str, Held)| -> Result<Law> {
            let level = |i| {
                let fuel = 1.0 - i as f64 / LEVELS as f64;
                vehicle.pole(fuel, held.inertia.then_some(1.0), held.centre)
            };
            Ok(Law { name, poles: (0..=LEVELS).map(level).collect::<Result<_>>()? })
        };
        let laws = LAWS.into_iter().map(law).collect::<Result<Vec<_>>>()?;
        let start = laws[0].poles[0];
        Ok(Self {
            empty_over_full: vehicle.own_ratio()?,
            still: vehicle.inertia_for(start),
            slight: vehicle.inertia_for((1.0 + slight) * start),
            laws,
        })
    }
}
