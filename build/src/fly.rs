//! `cargo ahv fly`: flies a manoeuvre with the FMU.

use crate::cli::Fly;
use crate::fmu::Fmu;
use crate::input_warnings::input_warnings;
use crate::manoeuvre::Manoeuvre;
use crate::master::{Instance, status_name};
use crate::model_description::{Causality, ModelDescription, Variable};
use crate::package::Targets;
use crate::record::Record;
use crate::settings::{self, Setting};
use crate::table::{number, row, table};
use crate::workspace::{Files, can_write, root, shown, write_together};
use crate::{flight_page, package, plot, simulation};
use ahv::short::short;
use anyhow::{Context, Result, bail};
use std::path::Path;

/// Default communication step, s; short enough to resolve the third mode.
pub const STEP: f64 = 0.01;

pub fn run(options: &Fly) -> Result<()> {
    let own = &options.own_vehicle;
    let file = match &options.fmu {
        Some(file) => file.clone(),
        None => {
            let targets = if options.host_only { Targets::Host } else { Targets::AsExisting };
            match own.is_given() {
                true => package::own_default(own, targets)?,
                false => package::build_default(targets)?,
            }
        }
    };
    let file = match options.fmi {
        Some(version) if options.fmu.is_none() => package::of(version.into(), &file),
        _ => file,
    };
    let fmu = Fmu::open(&file)?;
    let directory = options.output.clone().unwrap_or_else(|| own.results().join("flight"));
    can_write(&directory.join("flight.csv"))?;
    let model = &fmu.model;
    let default = &model.experiment;
    let step = positive("--step", options.step.or(Some(STEP)))?;
    let stop = positive("--stop", options.stop.or(default.stop_time))?;
    let tolerance = positive("--tolerance", options.tolerance.or(default.tolerance))?;
    let settings = settings::parse(model, &options.set.settings)?;
    let input =
        options.input.clone().unwrap_or_else(|| root().join("examples/elevator_doublet.csv"));
    let manoeuvre = Manoeuvre::read(&input, model)?;
    let points = simulation::communication_points(step, stop, manoeuvre.times())?;
    for warning in input_warnings(&manoeuvre, &shown(&input), stop) {
        errln!("warning: {warning}");
    }

    let mut instance = Instance::new(&fmu)?;
    for setting in &settings {
        instance
            .set(setting.variable, setting.value)
            .with_context(|| format!("--set {}", setting.text))?;
    }
    instance.set_up(0.0, stop, tolerance)?;
    let recorded = model.with(Causality::Input).chain(model.with(Causality::Output));
    let flown = simulation::run(&mut instance, &manoeuvre, recorded, &points)?;
    let calculated = values_of(&mut instance, model.with(Causality::CalculatedParameter))?;
    let fuel = model.with(Causality::Parameter).filter(|variable| variable.name == "fuel_fraction");
    let fuel_fraction = values_of(&mut instance, fuel)?.first().map(|(_, value)| *value);
    if flown.discard_reason.is_none() {
        instance.terminate()?;
    }

    let csv = directory.join("flight.csv");
    let title = title(model, &settings, &input);
    let mut files = Files::from([(csv, flown.record.csv()?.into_bytes())]);
    files.extend(plot::figures(&flown.record, &title, &directory)?);
    let [duration, steps] = [stop, step].map(short);
    let experiment = format!("{duration} s in steps of {steps} s, tolerance {tolerance:e}");
    let page = flight_page::html(&flight_page::Flight {
        fmu: &fmu,
        record: &flown.record,
        settings: &settings,
        calculated: &calculated,
        fuel_fraction,
        title: &title,
        summary: &experiment,
        ended: flown.discard_reason.as_deref().unwrap_or_default(),
    })?;
    files.extend(page.map(|page| (directory.join("flight.html"), page.into_bytes())));
    write_together(&files)?;
    outln!("FMU          {}", shown(&file))?;
    outln!("inputs       {}", shown(&input))?;
    outln!("experiment   {experiment}")?;
    outln!("set          {}", set_summary(&settings))?;
    outln!("\nCalculated at initialisation")?;
    out!("{}", values_table(model, &calculated))?;
    outln!("\nLargest deviations from the initial values")?;
    out!("{}", deviations(model, &flown.record))?;
    print_messages(&instance)?;
    outln!("")?;
    for file in files.keys() {
        outln!("wrote        {}", shown(file))?;
    }
    let end = flown.record.rows.last().map_or(0.0, |row| row[0]);
    outln!("speed        {:.0} times real time", end / flown.step_time.as_secs_f64())?;
    match flown.discard_reason {
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

/// Title of the figure: configuration, coefficient set, other settings, input file.
fn title(model: &ModelDescription, settings: &[Setting], input: &Path) -> String {
    let set = |name: &str| settings.iter().find(|setting| setting.variable.name == name);
    let vehicle = ["configuration", "aero"].into_iter().filter_map(|name| {
        let variable = model.find(name)?;
        let value = set(name).map_or(variable.start()?, |setting| setting.value);
        let items = model.items(variable);
        Some(items.iter().find(|item| f64::from(item.value) == value)?.name.clone())
    });
    let other =
        |setting: &&Setting| !["configuration", "aero"].contains(&setting.variable.name.as_str());
    let others = settings.iter().filter(other).map(|setting| setting.text.to_string());
    let file = input.file_name().map(|name| name.to_string_lossy().into_owned());
    vehicle.chain(others).chain(file).collect::<Vec<_>>().join(", ")
}

fn set_summary(settings: &[Setting]) -> String {
    match settings {
        [] => "nothing: all parameters at their defaults".to_string(),
        some => some.iter().map(|setting| setting.text).collect::<Vec<_>>().join(", "),
    }
}

/// Values of real variables.
fn values_of<'a>(
    instance: &mut Instance,
    variables: impl Iterator<Item = &'a Variable>,
) -> Result<Vec<(&'a Variable, f64)>> {
    let variables: Vec<_> = variables.collect();
    let references: Vec<_> = variables.iter().map(|variable| variable.value_reference).collect();
    Ok(variables.into_iter().zip(instance.get(&references)?).collect())
}

/// Rows of name, value and unit, in display units.
fn values_table(model: &ModelDescription, values: &[(&Variable, f64)]) -> String {
    let mut rows = vec![row(["variable", "value", "unit"])];
    for (variable, value) in values {
        let display = model.display(variable);
        let shown = value * display.factor + display.offset;
        rows.push(vec![variable.name.clone(), number(shown), display.name]);
    }
    table(&rows)
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
        outln!("\nMessages of the FMU")?;
    }
    for message in messages {
        outln!("  {} ({}): {}", status_name(message.status), message.category, message.text)?;
    }
    Ok(())
}
