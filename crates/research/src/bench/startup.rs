//! Start-up time, and the time of the eigenproblem.

use super::Effort;
use super::other_integrators::lines;
use super::report::Report;
use super::timing::{Spread, seconds};
use ahv::data::Data;
use ahv::dynamics::trim::trim;
use ahv::flight::{DEFAULT_TOLERANCE, Setup};
use ahv::structure::Modes;
use ahv::vehicle::{Configuration, structure};
use ahv_tool::fmu::Fmu;
use ahv_tool::master::Instance;
use ahv_tool::modes::eigenproblem_json;
use ahv_tool::package::{self, Targets};
use ahv_tool::python::python;
use ahv_tool::workspace::{root, target, write};
use anyhow::Result;
use std::process::Command;
use std::time::Instant;

/// Numbers of elements of the eigenproblems.
const ELEMENTS: [u32; 5] = [125, 250, 500, 1000, 2000];
/// Number of elements for the comparison with SciPy, as in the vehicle.
const PEERS: u32 = 500;

pub fn measure(effort: &Effort, report: &mut Report) -> Result<()> {
    let fmu = Fmu::open(&package::build_default(Targets::AsExisting)?)?;
    let mut parts: [Vec<f64>; 3] = Default::default();
    for _ in 0..10 * effort.repeats {
        let started = Instant::now();
        let mut instance = Instance::new(&fmu)?;
        let loaded = started.elapsed().as_secs_f64();
        instance.set_up(0.0, 1.0, DEFAULT_TOLERANCE)?;
        instance.initialise()?;
        let all = started.elapsed().as_secs_f64();
        for (part, value) in parts.iter_mut().zip([loaded, all - loaded, all]) {
            part.push(value);
        }
    }
    let [loaded, initialised, all] = parts.map(|part| Spread::of(part).scaled(1e3));
    report.line("start: load the library, instantiate", loaded, "ms", "");
    report.line("start: initialise (modes, trim)", initialised, "ms", "");
    report.line("start, all", all, "ms", "aim 3");

    for (configuration, name) in
        [(Configuration::EvenMassBeam, "EvenMassBeam"), (Configuration::SloshBeam, "SloshBeam")]
    {
        let mut burning = Setup::new()?;
        burning.parameters.options.configuration = configuration;
        burning.parameters.options.fuel_burn = true;
        let time = seconds(effort, || burning.fly()).scaled(1e3);
        report.line(format!("initialise with fuel_burn, {name}"), time, "ms", "aim 10");
    }
    let setup = Setup::new()?;
    let flight = setup.fly()?;
    let options = setup.parameters.options;
    let vehicle = flight.vehicle();
    let trimmed = seconds(effort, || trim(vehicle, &options.condition));
    report.line("trim", trimmed.scaled(1e3), "ms", "");
    let mut data = Data::embedded()?;
    let (mut first, mut ours) = (None, f64::NAN);
    for elements in ELEMENTS {
        data.vehicle.beam.elements.value = elements;
        let (beam, oscillators) = structure(&data, &options)?;
        let time = seconds(effort, || Modes::solve(&beam, &oscillators));
        let per = time.median / f64::from(elements);
        let growth = per / *first.get_or_insert(per);
        if elements == PEERS {
            ours = time.median;
        }
        let note = format!("{growth:.2} x the time per element of 125");
        report.line(format!("modes, {elements} elements"), time.scaled(1e3), "ms", note);
    }
    if let Err(why) = peers(report, &eigenproblem_json(setup.data(), &options)?, ours) {
        report.left_out("eigsh and LAPACK", &why);
    }
    Ok(())
}

/// Times SciPy on the same matrices; `ours` is our time, s.
fn peers(report: &mut Report, problem: &serde_json::Value, ours: f64) -> Result<()> {
    let file = target().join("bench/beam.json");
    write(&file, problem.to_string())?;
    let script = root().join("crates/research/bench/modes_vs_eigsh.py");
    let output = Command::new(python()?).arg(script).arg(&file).output()?;
    for cells in lines(output)? {
        let seconds = super::other_integrators::spread(&cells[1..4])?;
        let note = format!("{:.0} x ours; error {}", seconds.median / ours, cells[4]);
        report.line(format!("modes, 500 elements, {}", cells[0]), seconds.scaled(1e3), "ms", note);
    }
    Ok(())
}
