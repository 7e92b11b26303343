//! `cargo ahv identify`: identifies unpublished numbers from published results.

mod beam;
mod body_cache;
mod cells;
mod l_curve;
mod levenberg_marquardt;
mod numbers;
mod report;
mod resolution;
mod stations;
mod tradeoff;

use crate::cli::{Identified, Identify};
use ahv::data::{AeroData, Data, DataFile, VehicleData};
use ahv_tool::workspace::{MAX_DATA_BYTES, read_text, root, shown, write};
use anyhow::{Result, bail};
pub use cells::size;
use report::Report;
pub use tradeoff::{Moved, Place, TradeOff};

pub fn run(options: &Identify) -> Result<()> {
    match options.what {
        Identified::Beam => beam(options),
        Identified::Xu2015 => xu2015(options),
    }
}

const VEHICLE: &str = "src/data/vehicle.toml";
const XU2015: &str = "src/data/aero/xu2015.toml";

/// The data files as they are now: each identification uses the result of the other.
fn data() -> Result<Data> {
    Ok(Data {
        vehicle: VehicleData::parse(
            "vehicle.toml",
            &read_text(&root().join(VEHICLE), MAX_DATA_BYTES)?,
        )?
        .into(),
        xu2015: AeroData::parse(
            "aero/xu2015.toml",
            &read_text(&root().join(XU2015), MAX_DATA_BYTES)?,
        )?
        .into(),
        ..Data::embedded()?
    })
}

fn beam(options: &Identify) -> Result<()> {
    let before = read_text(&root().join(VEHICLE), MAX_DATA_BYTES)?;
    let data = data()?;
    let model = beam::Model::new(data, beam::printed()?)?;
    let solution = model.solve()?;
    let report = beam::Report::new(&model, &solution)?;
    let text = beam::file(&before, &solution.vehicle, &report.known())?;
    VehicleData::parse("vehicle.toml", &text)?;
    let settled = write_or_compare(options, "beam", VEHICLE, &text);
    if options.json {
        outln!("{}", serde_json::to_string_pretty(&report)?)?;
    } else if !options.check {
        out!("{}", report.text())?;
    }
    settled
}

fn xu2015(options: &Identify) -> Result<()> {
    let model = l_curve::Model::new(data()?)?;
    let chosen = model.chosen()?;
    let text = model.origin.file(&chosen.fit.point)?;
    let settled = write_or_compare(options, "xu2015", XU2015, &text);
    if options.json || !options.check {
        let (path, knee) = model.path(&|_| ())?;
        let best = model.best(&chosen)?;
        let report = Report::new(&model, &path, knee, [&chosen, &best])?;
        if options.json {
            outln!("{:#}", report.json())?;
        } else {
            out!("{}", report.text()?)?;
        }
    }
    settled
}

/// Writes a file of the repository, or compares it with the result.
fn write_or_compare(options: &Identify, what: &str, name: &str, text: &str) -> Result<()> {
    let file = root().join(name);
    let tell = |done: &str| errln!("{} {done}", shown(&file));
    if !options.check {
        write(&file, text)?;
        tell("is written");
        return Ok(());
    }
    let found = read_text(&file, MAX_DATA_BYTES)?;
    if found == text {
        tell("is up to date");
        return Ok(());
    }
    let line = found.lines().zip(text.lines()).take_while(|(a, b)| a == b).count();
    let at = |text: &str| text.lines().nth(line).unwrap_or("(end of file)").to_string();
    bail!(
        "{}, line {}: out of date; run `cargo ahv identify {what}` and commit the result\n  \
         found:    {}\n  expected: {}",
        shown(&file),
        line + 1,
        at(&found),
        at(text),
    );
}
