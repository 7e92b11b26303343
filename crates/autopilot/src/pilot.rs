//! The running law: what it remembers, and one sample.

use crate::gains::{FEEDBACK_COLUMNS, Gains};
use crate::law::{COMMANDS, Design, MEASURED, MOST_STATES, WANTED};
use std::sync::Arc;

/// A measurement beyond this is not believed, in m/s, rad, rad/s, and nothing that is remembered or wanted grows beyond
/// it, whatever a model does without a measurement: nothing overflows.
const LARGEST: f64 = 1e9;
/// A speed below this share of level flight's is not believed: that of a sensor without a signal, which noise moves.
const SLOWEST: f64 = 0.5;

/// What the law remembers from sample to sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// Estimate of the states at the last sample plus a period, as deviations from trim.
    pub estimate: [f64; MOST_STATES],
    /// Integrals of the errors of V (m) and gamma (rad s).
    pub integrals: [f64; WANTED],
    /// Command that acts from the next sample on.
    pub command: [f64; COMMANDS],
    /// Measurements that were not believed.
    pub missed: f64,
    /// Samples with a command at its limit.
    pub saturated: f64,
}

impl Memory {
    /// Level flight.
    pub const LEVEL: Self = Self {
        estimate: [0.0; MOST_STATES],
        integrals: [0.0; WANTED],
        command: [0.0; COMMANDS],
        missed: 0.0,
        saturated: 0.0,
    };
}

/// The law about one level flight.
#[derive(Debug, Clone)]
pub struct Pilot {
    /// Designs by growing fuel.
    designs: Arc<[Design]>,
    /// Gains in force.
    gains: Gains,
    /// Fuel that they are for, kg/m.
    fuel_mass_kg_per_m: f64,
    level: [f64; MEASURED],
    /// Limits of the commands as deviations from trim.
    low: [f64; COMMANDS],
    high: [f64; COMMANDS],
    speed_error: f64,
}

impl Pilot {
    /// The law that starts with a design about a level flight with these measurements and limits; others to
    /// follow the fuel.
    pub fn new(
        designs: &Arc<[Design]>,
        start: Design,
        level: [f64; MEASURED],
        [low, high]: [[f64; COMMANDS]; 2],
    ) -> Self {
        Self {
            designs: Arc::clone(designs),
            gains: start.gains,
            fuel_mass_kg_per_m: start.fuel_mass_kg_per_m,
            level,
            low,
            high,
            speed_error: start.speed_error_m_per_s,
        }
    }

    /// Moves the gains to a measured fuel; one that is no mass is not believed.
    pub fn schedule(&mut self, fuel_mass_kg_per_m: f64) {
        if exceeds(fuel_mass_kg_per_m, 0.0) {
            self.move_to(fuel_mass_kg_per_m);
        }
    }

    /// Moves the gains to a fuel, kg/m.
    pub fn move_to(&mut self, fuel_mass_kg_per_m: f64) {
        if fuel_mass_kg_per_m != self.fuel_mass_kg_per_m {
            self.fuel_mass_kg_per_m = fuel_mass_kg_per_m;
            self.gains = Design::gains_at(&self.designs, fuel_mass_kg_per_m);
        }
    }

    /// Fuel that the gains are for, kg/m.
    pub fn fuel_mass_kg_per_m(&self) -> f64 {
        self.fuel_mass_kg_per_m
    }

    /// Which measurements are believed: a speed of flight, and what is neither NaN nor beyond any flight.
    pub fn believes(&self, measured: &[f64; MEASURED]) -> [bool; MEASURED] {
        let mut believed = measured.map(is_moderate);
        believed[0] = exceeds(measured[0], (SLOWEST * self.level[0]).max(0.0));
        believed
    }

    /// One sample: the command for the next one from what is measured now. A filter in predictor form knows
    /// that a command acts a period later.
    ///
    /// What the estimate lets expect takes the place of a measurement that is not believed. While a command is at
    /// its limit the integrals are held.
    pub fn sample(&self, memory: &mut Memory, measured: &[f64; MEASURED], wanted: [f64; WANTED]) {
        let wanted = wanted.map(bounded);
        let believed = self.believes(measured);
        let mut deviation = [0.0; MEASURED];
        if believed != [true; MEASURED] {
            memory.missed += 1.0;
            add_products(&mut deviation, &self.gains.measurement, &memory.estimate);
        }
        for i in 0..MEASURED {
            if believed[i] {
                deviation[i] = measured[i] - self.level[i];
            }
        }
        let known = memory.estimate.iter().chain(&memory.command);
        let mut estimate = [0.0; MOST_STATES];
        add_products(&mut estimate, &self.gains.filter, known.chain(&deviation));
        let mut integrals = memory.integrals;
        for i in (0..WANTED).filter(|&i| believed[i]) {
            let error = self.limited(i, deviation[i] - wanted[i]);
            integrals[i] = bounded(integrals[i] + self.designs[0].period_s * error);
        }
        let estimate = estimate.map(bounded);
        let mut away = [0.0; FEEDBACK_COLUMNS];
        away[..MOST_STATES].copy_from_slice(&estimate);
        for (i, wanted) in wanted.into_iter().enumerate() {
            away[i] = self.limited(i, estimate[i] - wanted);
        }
        away[MOST_STATES..].copy_from_slice(&integrals);
        let mut feedback = [0.0; COMMANDS];
        add_products(&mut feedback, &self.gains.feedback, &away);
        let free = feedback.map(|value| -value);
        let command = std::array::from_fn(|i| free[i].max(self.low[i]).min(self.high[i]));
        if command == free {
            memory.integrals = integrals;
        } else {
            memory.saturated += 1.0;
        }
        (memory.estimate, memory.command) = (estimate, command);
    }

    /// An error of V (0), which is limited, or gamma.
    fn limited(&self, which: usize, error: f64) -> f64 {
        if which == 0 { error.max(-self.speed_error).min(self.speed_error) } else { error }
    }
}

/// Whether a number is neither NaN nor beyond any flight: as bits, which have the order of positive numbers. A comparison
/// of NaN may be a floating-point exception, which some hosts trap.
fn is_moderate(value: f64) -> bool {
    value.abs().to_bits() <= LARGEST.to_bits()
}

/// Whether a moderate number is larger than one that is not negative.
fn exceeds(value: f64, least: f64) -> bool {
    is_moderate(value) && value.is_sign_positive() && value.to_bits() > least.to_bits()
}

fn bounded(value: f64) -> f64 {
    value.clamp(-LARGEST, LARGEST)
}

/// sum += matrix factors, column by column.
fn add_products<'a, const ROWS: usize>(
    sum: &mut [f64; ROWS],
    columns: &[[f64; ROWS]],
    factors: impl IntoIterator<Item = &'a f64>,
) {
    for (column, factor) in columns.iter().zip(factors) {
        for (sum, value) in sum.iter_mut().zip(column) {
            *sum += value * factor;
        }
    }
}
