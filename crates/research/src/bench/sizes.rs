//! Sizes of library, instance and saved state.

use super::Effort;
use super::report::Report;
use super::timing::Spread;
use ahv::flight::{DEFAULT_TOLERANCE, Setup};
use ahv_tool::fmu::Fmu;
use ahv_tool::master::Instance;
use ahv_tool::package::{self, Targets};
use ahv_tool::workspace::{MAX_DATA_BYTES, read_text};
use anyhow::{Context, Result};
use fmi_model::state::FmuState;
use std::path::Path;

/// Resident memory of this process, kB.
fn resident() -> Result<f64> {
    let status = read_text(Path::new("/proc/self/status"), MAX_DATA_BYTES)?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let text = line.context("no VmRSS in /proc/self/status")?;
    Ok(text.trim().trim_end_matches(" kB").trim().parse()?)
}

pub fn measure(effort: &Effort, report: &mut Report) -> Result<()> {
    let fmu = Fmu::open(&package::build_default(Targets::AsExisting)?)?;
    let library = std::fs::metadata(&fmu.binary)?.len() as f64 / 1e6;
    report.line("library", Spread::exact(library), "MB", "aim 1");
    let bytes = FmuState::<Setup>::encoded_len()? as f64 / 1e3;
    report.line("saved state", Spread::exact(bytes), "kB", "aim 1");

    let before = resident()?;
    let mut instances = Vec::with_capacity(effort.many);
    for number in 0..effort.many {
        let mut instance = Instance::new(&fmu)?;
        instance.set_up(0.0, 1.0, DEFAULT_TOLERANCE)?;
        instance.initialise()?;
        instances.push(instance);
        if (number + 1) % 1000 == 0 {
            errln!("  {} of {} instances", number + 1, effort.many);
        }
    }
    let each = (resident()? - before) / instances.len() as f64;
    let note = format!("aim 64; {} initialised in one process", instances.len());
    report.line("instance, resident", Spread::exact(each), "kB", note);
    Ok(())
}
