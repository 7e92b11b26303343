//! The files of the FMI cross-check: inputs, options and what comes out, for whoever imports the FMU.

use super::Files;
use crate::describe::MODEL_IDENTIFIER;
use crate::fly::{STEP, apply, communication_points, positive};
use crate::fmu::Fmu;
use crate::manoeuvre::Manoeuvre;
use crate::master::{Instance, Step};
use crate::model_description::Causality;
use crate::record::Record;
use crate::workspace::{TEXT, read, root};
use anyhow::{Result, bail};

/// Where a file of the set is in the FMU.
pub fn path(ending: &str) -> String {
    format!("documentation/cross-check/{MODEL_IDENTIFIER}_{ending}")
}

/// Flies the example's doublet with an FMU; files by their names.
///
/// The input file is the example itself: it has a row just before each jump, so a tool that
/// interpolates flies the same as one that holds a value.
pub fn fly_reference(fmu: &Fmu) -> Result<Files> {
    let (model, default) = (&fmu.model, &fmu.model.experiment);
    let stop = positive("stop time", default.stop_time)?;
    let tolerance = positive("tolerance", default.tolerance)?;
    let input = root().join("examples/elevator_doublet.csv");
    let manoeuvre = Manoeuvre::read(&input, model)?;

    let mut instance = Instance::new(fmu)?;
    instance.set_up(0.0, stop, tolerance)?;
    apply(&mut instance, &manoeuvre, 0.0)?;
    instance.initialise()?;

    let outputs: Vec<_> = model.with(Causality::Output).collect();
    let references: Vec<_> = outputs.iter().map(|output| output.value_reference).collect();
    let names = outputs.iter().map(|output| output.name.clone());
    let names = std::iter::once("time".to_string()).chain(names).collect();
    let mut record = Record { names, rows: Vec::new() };
    let mut add = |instance: &mut Instance, time: f64| -> Result<()> {
        record.rows.push([&[time], instance.get(&references)?.as_slice()].concat());
        Ok(())
    };
    let mut time = 0.0;
    add(&mut instance, time)?;
    for next in communication_points(STEP, stop, std::iter::empty()) {
        // A row has the outputs at the end of a step, before the inputs of the next.
        apply(&mut instance, &manoeuvre, time)?;
        if let Step::Discarded(reached, reason) = instance.step(time, next - time)? {
            bail!("the reference flight ends at {reached} s: {reason}");
        }
        time = next;
        add(&mut instance, time)?;
    }
    instance.terminate()?;

    let options =
        format!("StartTime,0.0\nStopTime,{stop:?}\nStepSize,{STEP:?}\nRelTol,{tolerance:?}\n");
    Ok(Files::from([
        (path("in.csv"), read(&input, TEXT)?),
        (path("ref.csv"), record.csv()?.into_bytes()),
        (path("ref.opt"), options.into_bytes()),
    ]))
}
