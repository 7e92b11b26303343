//! `cargo ahv bench`: measures speed and size of the vehicle and of alternatives. Not a test, because times depend
//! on the load of the machine.

mod chart;
#[cfg(feature = "diffsol")]
mod diffsol;
mod ensemble;
pub mod instructions;
mod masters;
mod other_integrators;
mod precision;
mod report;
mod rust_crates;
mod sizes;
mod startup;
mod timing;

use crate::cli::{Bench, BenchPart};
use ahv_tool::workspace::{can_write, target};
use anyhow::Result;
use report::Report;
use std::time::Duration;

/// Number of repetitions and flights.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Repetitions, of which the median is taken.
    pub repeats: usize,
    /// Shortest duration of one repetition.
    pub batch: Duration,
    /// Flights of the ensemble, and instances in one process.
    pub many: usize,
}

const FULL: Effort = Effort { repeats: 9, batch: Duration::from_millis(50), many: 10_000 };
/// Enough to check that everything runs.
const QUICK: Effort = Effort { repeats: 3, batch: Duration::from_millis(1), many: 100 };

pub fn run(options: &Bench) -> Result<()> {
    if let Some(probe) = options.probe {
        return instructions::probe(probe, options.calls);
    }
    let directory = options.output.clone().unwrap_or_else(|| target().join("bench"));
    can_write(&directory.join("bench.json"))?;
    let effort = if options.quick { QUICK } else { FULL };
    let mut report = Report::new()?;
    for (part, name, measure) in PARTS {
        if !options.only.is_empty() && !options.only.contains(&part) {
            continue;
        }
        errln!("{name} ...");
        let lines = measure(&effort, &mut report);
        match lines {
            Err(error) if !options.only.is_empty() => return Err(error.context(name)),
            // A part that fails, for lack of a program, does not stop the others.
            Err(error) => report.left_out(name, &error),
            Ok(()) => {}
        }
    }
    report.finish(&directory)
}

type Measure = fn(&Effort, &mut Report) -> Result<()>;

const PARTS: [(BenchPart, &str, Measure); 6] = [
    (BenchPart::Precision, "work and precision", precision::measure),
    (BenchPart::Instructions, "instructions", instructions::measure),
    (BenchPart::Masters, "FMPy", masters::measure),
    (BenchPart::Start, "start-up and modes", startup::measure),
    (BenchPart::Size, "sizes", sizes::measure),
    (BenchPart::Ensemble, "ensemble", ensemble::measure),
];
