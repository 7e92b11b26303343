//! Simulates a manoeuvre with an FMU and records the time history.

use crate::manoeuvre::Manoeuvre;
use crate::master::{Instance, Step};
use crate::model_description::Variable;
use crate::record::Record;
use ahv::short::short;
use anyhow::{Result, bail};
use std::time::{Duration, Instant};

/// Limit on recorded steps; each takes about 250 bytes of memory and 600 of the CSV file.
const MAX_STEPS: usize = 1_000_000;
/// Communication points closer than this fraction of a step coincide.
const SAME_INSTANT: f64 = 1e-6;

/// Result of a simulation.
pub struct Simulated {
    pub record: Record,
    /// Wall-clock time in fmi2DoStep.
    pub step_time: Duration,
    /// Why the FMU ended the flight early, if it did.
    pub discard_reason: Option<String>,
}

/// Simulates from initialisation mode to the last of `points` or an early end. The record has a row of the
/// `recorded` variables per communication point; where an input jumps, one before and one after it.
pub fn run<'a>(
    instance: &mut Instance,
    manoeuvre: &Manoeuvre,
    recorded: impl Iterator<Item = &'a Variable>,
    points: &[f64],
) -> Result<Simulated> {
    let recorded: Vec<_> = recorded.collect();
    let names = recorded.iter().map(|variable| variable.name.clone());
    let names = std::iter::once("time".to_string()).chain(names).collect();
    let references: Vec<_> = recorded.iter().map(|variable| variable.value_reference).collect();
    let mut record = Record { names, rows: Vec::new() };
    let mut add = |instance: &mut Instance, time: f64| -> Result<()> {
        record.rows.push([&[time], instance.get(&references)?.as_slice()].concat());
        Ok(())
    };

    let mut step_time = Duration::ZERO;
    let (mut time, mut discard_reason) = (0.0, None);
    set_inputs_before(instance, manoeuvre, time)?;
    instance.initialise()?;
    add(instance, time)?;
    for &next in points {
        if set_inputs_after(instance, manoeuvre, time)? {
            add(instance, time)?;
        }
        let started = Instant::now();
        let outcome = instance.step(time, next - time)?;
        step_time += started.elapsed();
        if let Step::Discarded(reached, reason) = outcome {
            add(instance, reached)?;
            discard_reason = Some(reason);
            break;
        }
        time = next;
        set_inputs_before(instance, manoeuvre, time)?;
        add(instance, time)?;
    }
    Ok(Simulated { record, step_time, discard_reason })
}

/// Sets the inputs at an instant, before a jump.
fn set_inputs_before(instance: &mut Instance, manoeuvre: &Manoeuvre, time: f64) -> Result<()> {
    let values = manoeuvre.before(time).unwrap_or_default();
    manoeuvre.inputs.iter().zip(values).try_for_each(|(input, value)| instance.set(input, value))
}

/// Sets inputs and slopes at an instant, after a jump. Returns whether an input jumps.
fn set_inputs_after(instance: &mut Instance, manoeuvre: &Manoeuvre, time: f64) -> Result<bool> {
    let (Some(before), Some(after)) = (manoeuvre.before(time), manoeuvre.after(time)) else {
        return Ok(false);
    };
    for (input, value) in manoeuvre.inputs.iter().zip(&after.values) {
        instance.set(input, *value)?;
    }
    if after.slopes.iter().any(|slope| *slope != 0.0) {
        instance.set_slopes(&manoeuvre.inputs, &after.slopes)?;
    }
    Ok(before != after.values)
}

/// End times of all steps: multiples of the step, the stop time, and the rows of a manoeuvre, so that
/// inputs are linear within each step. `rows` must not decrease.
pub fn communication_points(
    step: f64,
    stop: f64,
    rows: impl Iterator<Item = f64>,
) -> Result<Vec<f64>> {
    if stop / step > MAX_STEPS as f64 {
        bail!(
            "--step {} s gives {:.0e} steps in {} s; at most {:.0e} can be recorded",
            short(step),
            stop / step,
            short(stop),
            MAX_STEPS as f64
        );
    }
    // 0.01 is not a binary number: n / 100 is the double nearest to the multiple, n * 0.01 is not.
    let rate = (1.0 / step).round();
    let exact = 1.0 / rate == step;
    let multiple = |n: f64| if exact { n / rate } else { n * step };
    let count = (stop / step - SAME_INSTANT).ceil() as usize;
    let same = SAME_INSTANT * step;
    let mut rows: Vec<f64> = rows.filter(|time| *time > 0.0 && *time < stop - same).collect();
    rows.dedup();
    let apart = |time: &f64| {
        let next = rows.partition_point(|row| *row < *time - same);
        rows.get(next).is_none_or(|row| *row > *time + same)
    };
    let grid = (1..count).map(|n| multiple(n as f64)).chain([stop]).filter(apart);
    let mut points: Vec<f64> = grid.chain(rows.iter().copied()).collect();
    if points.len() > 2 * MAX_STEPS {
        bail!("{} rows before {stop} s; the limit is {MAX_STEPS}", rows.len());
    }
    points.sort_by(f64::total_cmp);
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_on_the_grid_on_rows_and_at_the_stop_time() {
        let points = |step, stop, rows: &[f64]| {
            communication_points(step, stop, rows.iter().copied()).unwrap()
        };
        assert_eq!(points(0.1, 0.3, &[]), [0.1, 0.2, 0.3]);
        assert_eq!(points(0.2, 0.5, &[]), [0.2, 0.4, 0.5]);
        assert_eq!(points(0.1, 0.3, &[0.0, 0.15, 0.15, 0.2, 0.3, 7.0]), [0.1, 0.15, 0.2, 0.3]);
        assert_eq!(points(0.1, 0.3, &[0.1 + 1e-9, 0.3 - 1e-9]), [0.1 + 1e-9, 0.2, 0.3]);
        assert_eq!(points(0.01, 2.0, &[]).len(), 200);
        assert_eq!(points(0.01, 2.0, &[])[34], 0.35);
        assert_eq!(points(1.0, 0.5, &[]), [0.5]);
        let error = communication_points(1e-7, 1.0, std::iter::empty()).unwrap_err();
        assert!(
            error.to_string().contains("s gives 1e7 steps in 1 s; at most 1e6 can be recorded"),
            "{error}"
        );
    }
}
