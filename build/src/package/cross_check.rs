//! The files of the FMI cross-check: inputs, options and reference outputs.

use super::Files;
use crate::fly::{STEP, positive};
use crate::fmu::Fmu;
use crate::manoeuvre::Manoeuvre;
use crate::master::Instance;
use crate::model_description::Causality;
use crate::models::VEHICLE;
use crate::simulation;
use crate::workspace::{MAX_TEXT_BYTES, read, root};
use anyhow::{Result, bail};

/// Path of one of the files in the FMU.
pub fn path(ending: &str) -> String {
    format!("documentation/cross-check/{}_{ending}", VEHICLE.identifier)
}

/// Flies the elevator doublet of the examples with an FMU; returns the files by name.
///
/// The jumps of the input are at multiples of the step, so every tool can reproduce the flight.
pub fn fly_reference(fmu: &Fmu) -> Result<Files> {
    let (model, default) = (&fmu.model, &fmu.model.experiment);
    let stop = positive("stop time", default.stop_time)?;
    let tolerance = positive("tolerance", default.tolerance)?;
    let input = root().join("examples/elevator_doublet.csv");
    let manoeuvre = Manoeuvre::read(&input, model)?;

    let mut instance = Instance::new(fmu)?;
    instance.set_up(0.0, stop, tolerance)?;
    let points = simulation::communication_points(STEP, stop, manoeuvre.times())?;
    let outputs = model.with(Causality::Output);
    let mut flown = simulation::run(&mut instance, &manoeuvre, outputs, &points)?;
    if let Some(reason) = flown.discard_reason {
        bail!("the reference flight ends early: {reason}");
    }
    // One row per instant: the outputs at the end of a step, before an input jumps.
    flown.record.rows.dedup_by_key(|row| row[0]);
    instance.terminate()?;

    let options =
        format!("StartTime,0.0\nStopTime,{stop:?}\nStepSize,{STEP:?}\nRelTol,{tolerance:?}\n");
    Ok(Files::from([
        (path("in.csv"), read(&input, MAX_TEXT_BYTES)?),
        (path("ref.csv"), flown.record.csv()?.into_bytes()),
        (path("ref.opt"), options.into_bytes()),
    ]))
}
