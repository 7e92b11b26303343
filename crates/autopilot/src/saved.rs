//! The running autopilot as plain numbers.

use crate::law::{COMMANDS, MOST_STATES, WANTED};
use crate::running::{FUEL, INPUTS, Running};
use fmi_model::instance::LARGEST;

/// Time, start, fuel of the gains; estimate, integrals, next command; command in force; two counts; inputs,
/// their rates, and whether these are for the next step.
pub const COUNT: usize = 3 + MOST_STATES + WANTED + 2 * COMMANDS + 2 + 2 * INPUTS + 1;
const COUNTS_AT: usize = 3 + MOST_STATES + WANTED + 2 * COMMANDS;
const INPUTS_AT: usize = COUNTS_AT + 2;
const AHEAD_AT: usize = COUNT - 1;

/// Writes the numbers.
pub fn save(running: &Running, numbers: &mut Vec<f64>) {
    let Running { memory, .. } = running;
    numbers.extend([running.time_s, running.start_s, running.pilot.fuel_mass_kg_per_m()]);
    numbers.extend(memory.estimate);
    numbers.extend(memory.integrals);
    numbers.extend(memory.command);
    numbers.extend(running.command);
    numbers.extend([memory.missed, memory.saturated]);
    numbers.extend(running.inputs);
    numbers.extend(running.rates);
    numbers.push(f64::from(running.ahead));
}

/// Whether an autopilot can have these numbers: only a measurement can be no number, and other inputs have no limit.
pub fn check(numbers: &[f64]) -> bool {
    let possible = |(i, value): (usize, &f64)| match i.checked_sub(INPUTS_AT) {
        Some(input) if input <= FUEL => true,
        Some(input) if input < INPUTS => value.is_finite(),
        _ => value.abs() <= LARGEST,
    };
    numbers.iter().enumerate().all(possible)
        && numbers[0] >= numbers[1]
        && numbers[2] >= 0.0
        && numbers[COUNTS_AT..INPUTS_AT].iter().all(|count| *count >= 0.0)
        && [0.0, 1.0].contains(&numbers[AHEAD_AT])
}

/// Continues from checked numbers.
pub fn load(running: &mut Running, numbers: &[f64]) {
    let mut numbers = numbers.iter().copied();
    let mut next = || numbers.next().unwrap_or_default();
    (running.time_s, running.start_s) = (next(), next());
    running.pilot.move_to(next());
    running.memory.estimate = std::array::from_fn(|_| next());
    running.memory.integrals = std::array::from_fn(|_| next());
    running.memory.command = std::array::from_fn(|_| next());
    running.command = std::array::from_fn(|_| next());
    (running.memory.missed, running.memory.saturated) = (next(), next());
    running.inputs = std::array::from_fn(|_| next());
    running.rates = std::array::from_fn(|_| next());
    running.ahead = next() != 0.0;
}
