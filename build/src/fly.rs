//! Flies a manoeuvre with the FMU.

use crate::cli::Fly;
use crate::fmu::Fmu;
use crate::manoeuvre::Manoeuvre;
use crate::master::{Instance, Step, status_name};
use crate::model_description::{Causality, ModelDescription, Variable};
use crate::package::Targets;
use crate::record::Record;
use crate::settings::{self, Setting};
use crate::table::{number, row, table};
use crate::workspace::{Files, can_write, root, shown, target, write_together};
use crate::{package, plot};
use ahv::short::short;
use anyhow::{Context, Result, bail};
use std::time::{Duration, Instant};

/// Steps of which a record is kept; each takes about 200 bytes of memory and of the CSV file.
const MAX_STEPS: f64 = 1e6;
/// Communication points closer than this share of a step are one.
const SAME_INSTANT: f64 = 1e-6;

/// How far a flight came.
struct Flown {
    record: Record,
    /// Time spent in the FMU's steps.
    spent: Duration,
    /// Why it ended early.
    discarded: Option<String>,
}

pub fn run(options: &Fly) -> Result<()> {
    let file = match &options.fmu {
        Some(file) => file.clone(),
        None if options.host_only => package::fresh(Targets::Host)?,
        None => package::fresh(Targets::Present)?,
    };
    let fmu = Fmu::open(&file)?;
    let directory = options.output.clone().unwrap_or_else(|| target().join("flight"));
    can_write(&directory.join("flight.csv"))?;
    let model = &fmu.model;
    let default = &model.experiment;
    let step = positive("--step", options.step.or(default.step_size))?;
    let stop = positive("--stop", options.stop.or(default.stop_time))?;
    let tolerance = positive("--tolerance", options.tolerance.or(default.tolerance))?;
    let settings = settings::parse(model, &options.set.settings)?;
    let input =
        options.input.clone().unwrap_or_else(|| root().join("examples/elevator_doublet.csv"));
    let manoeuvre = Manoeuvre::read(&input, model)?;

    let mut instance = Instance::new(&fmu)?;
    for setting in &settings {
        instance
            .set(setting.variable, setting.value)
            .with_context(|| format!("--set {}", setting.text))?;
    }
    instance.set_up(0.0, stop, tolerance)?;
    apply(&mut instance, &manoeuvre, 0.0)?;
    instance.initialise()?;
    let calculated = values_of(&mut instance, model, Causality::CalculatedParameter)?;
    if stop / step > MAX_STEPS {
        bail!(
            "--step {} s makes {:.0e} steps in {} s; the record holds {MAX_STEPS:.0e}",
            short(step),
            stop / step,
            short(stop)
        );
    }
    let flown = fly(&mut instance, model, &manoeuvre, step, stop)?;
    if flown.discarded.is_none() {
        instance.terminate()?;
    }

    let csv = directory.join("flight.csv");
    let mut files = Files::from([(csv, flown.record.csv()?.into_bytes())]);
    files.extend(plot::figures(&flown.record, &directory)?);
    write_together(&files)?;
    say!("FMU          {}", shown(&file))?;
    say!("inputs       {}", shown(&input))?;
    let [duration, steps] = [stop, step].map(short);
    say!("experiment   {duration} s in steps of {steps} s, tolerance {tolerance:e}")?;
    say!("set          {}", set_summary(&settings))?;
    say!("\nCalculated at initialisation")?;
    put!("{}", table(&calculated))?;
    say!("\nLargest deviations from the start")?;
    put!("{}", deviations(model, &flown.record))?;
    print_messages(&instance)?;
    say!("")?;
    for file in files.keys() {
        say!("wrote        {}", shown(file))?;
    }
    let end = flown.record.rows.last().map_or(0.0, |row| row[0]);
    say!("speed        {:.0} times real time", end / flown.spent.as_secs_f64())?;
    match flown.discarded {
        None => Ok(()),
        Some(reason) => bail!("the flight ended at {} s of {stop} s: {reason}", number(end)),
    }
}

pub fn positive(option: &str, value: Option<f64>) -> Result<f64> {
    match value {
        Some(value) if value.is_finite() && value > 0.0 => Ok(value),
        Some(value) => bail!("{option} {}: a finite number above zero is expected", short(value)),
        None => bail!("{option} is needed: the FMU has no default"),
    }
}

/// Sets the inputs that hold at a time.
pub fn apply(instance: &mut Instance, manoeuvre: &Manoeuvre, time: f64) -> Result<()> {
    let values = manoeuvre.at(time).unwrap_or_default();
    manoeuvre.inputs.iter().zip(values).try_for_each(|(input, value)| instance.set(input, *value))
}

/// Steps from zero to `stop`. Every row holds the inputs from its time on, and the outputs that the
/// FMU shows with them.
fn fly(
    instance: &mut Instance,
    model: &ModelDescription,
    manoeuvre: &Manoeuvre,
    step: f64,
    stop: f64,
) -> Result<Flown> {
    let recorded = || model.with(Causality::Input).chain(model.with(Causality::Output));
    let names = recorded().map(|variable| variable.name.clone());
    let names = std::iter::once("time".to_string()).chain(names).collect();
    let references: Vec<_> = recorded().map(|variable| variable.value_reference).collect();
    let mut record = Record { names, rows: Vec::new() };
    let mut add = |instance: &mut Instance, time: f64| -> Result<()> {
        let mut row = vec![time];
        row.extend(instance.get(&references)?);
        record.rows.push(row);
        Ok(())
    };

    let changes = manoeuvre.changes.iter().map(|(time, _)| *time);
    let mut spent = Duration::ZERO;
    let mut time = 0.0;
    add(instance, time)?;
    for next in communication_points(step, stop, changes) {
        let started = Instant::now();
        let outcome = instance.step(time, next - time)?;
        spent += started.elapsed();
        if let Step::Discarded(reached, reason) = outcome {
            add(instance, reached)?;
            return Ok(Flown { record, spent, discarded: Some(reason) });
        }
        time = next;
        apply(instance, manoeuvre, time)?;
        add(instance, time)?;
    }
    Ok(Flown { record, spent, discarded: None })
}

/// The ends of all steps: multiples of the step, the stop time, and every change of an input, so
/// that the inputs are constant during each step.
pub fn communication_points(step: f64, stop: f64, changes: impl Iterator<Item = f64>) -> Vec<f64> {
    // 0.01 is no binary number: dividing by a whole number of steps per second gives the doubles
    // nearest to 0.01, 0.02, ..., multiplying does not.
    let rate = (1.0 / step).round();
    let exact = 1.0 / rate == step;
    let multiple = |n: f64| if exact { n / rate } else { n * step };
    let count = (stop / step - SAME_INSTANT).ceil() as usize;
    let mut points: Vec<f64> = changes.filter(|time| *time > 0.0 && *time < stop).collect();
    let grid = (1..count).map(|n| multiple(n as f64)).chain([stop]);
    let near = |a: f64, b: f64| (a - b).abs() < SAME_INSTANT * step;
    let changes = points.clone();
    points.extend(grid.filter(|time| !changes.iter().any(|change| near(*time, *change))));
    points.sort_by(f64::total_cmp);
    points
}

fn set_summary(settings: &[Setting]) -> String {
    match settings {
        [] => "nothing: all parameters have their start values".to_string(),
        some => some.iter().map(|setting| setting.text).collect::<Vec<_>>().join(", "),
    }
}

/// Rows of name, value and unit, as they are shown.
fn values_of(
    instance: &mut Instance,
    model: &ModelDescription,
    causality: Causality,
) -> Result<Vec<Vec<String>>> {
    let variables: Vec<&Variable> = model.with(causality).collect();
    let references: Vec<_> = variables.iter().map(|variable| variable.value_reference).collect();
    let values = instance.get(&references)?;
    let mut rows = vec![row(["variable", "value", "unit"])];
    for (variable, value) in variables.into_iter().zip(values) {
        let display = model.display(variable);
        let shown = value * display.factor + display.offset;
        rows.push(vec![variable.name.clone(), number(shown), display.name]);
    }
    Ok(rows)
}

fn deviations(model: &ModelDescription, record: &Record) -> String {
    let mut rows = vec![row(["output", "start", "deviation", "unit", "at, s"])];
    for variable in model.with(Causality::Output) {
        let Some(column) = record.column(&variable.name) else { continue };
        let display = model.display(variable);
        let start = record.values(column).next().unwrap_or(0.0);
        let (deviation, time) = record.largest_deviation(column);
        rows.push(vec![
            variable.name.clone(),
            number(start * display.factor + display.offset),
            number(deviation * display.factor),
            display.name,
            format!("{time:.2}"),
        ]);
    }
    table(&rows)
}

fn print_messages(instance: &Instance) -> Result<()> {
    let messages = instance.messages();
    if !messages.is_empty() {
        say!("\nMessages of the FMU")?;
    }
    for message in messages {
        say!("  {} ({}): {}", status_name(message.status), message.category, message.text)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_on_the_grid_on_changes_and_at_the_stop_time() {
        let points =
            |step, stop, changes: &[f64]| communication_points(step, stop, changes.iter().copied());
        assert_eq!(points(0.1, 0.3, &[]), [0.1, 0.2, 0.3]);
        assert_eq!(points(0.2, 0.5, &[]), [0.2, 0.4, 0.5]);
        assert_eq!(points(0.1, 0.3, &[0.0, 0.15, 0.2, 0.3, 7.0]), [0.1, 0.15, 0.2, 0.3]);
        assert_eq!(points(0.01, 2.0, &[]).len(), 200);
        assert_eq!(points(0.01, 2.0, &[])[34], 0.35);
        assert_eq!(points(1.0, 0.5, &[]), [0.5]);
    }
}
