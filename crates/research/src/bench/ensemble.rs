//! Many flights on all cores of one process.

use super::Effort;
use super::report::Report;
use super::timing::Spread;
use ahv::flight::Flight;
use ahv::vehicle::DELTA_E;
use ahv_tool::cli::Set;
use ahv_tool::trim::flight;
use anyhow::{Result, anyhow};
use std::time::Instant;

/// Communication steps of a flight of two seconds.
const STEPS: u32 = 200;
const STEP_S: f64 = 0.01;
/// Largest elevator deflection, rad, for which the open-loop vehicle stays in its envelope.
const LARGEST: f64 = 5e-5;
/// Runs, of which the fastest counts: other processes only add time.
const RUNS: usize = 3;

/// Flies one of the flights, each with a different elevator deflection.
fn fly(mut flight: Flight, number: usize, flights: usize) -> Result<(), ahv::error::Error> {
    flight.set_input(DELTA_E, LARGEST * (2.0 * number as f64 / flights as f64 - 1.0));
    for step in 1..=STEPS {
        flight.advance(STEP_S * f64::from(step))?;
    }
    Ok(())
}

/// Flights per second with this number of threads.
#[expect(clippy::disallowed_methods, reason = "threads are what is measured")]
fn rate(start: &Flight, flights: usize, threads: usize) -> Result<f64> {
    let started = Instant::now();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|thread| {
                scope.spawn(move || {
                    (thread..flights)
                        .step_by(threads)
                        .try_for_each(|number| fly(start.clone(), number, flights))
                })
            })
            .collect();
        workers.into_iter().try_for_each(|worker| {
            worker.join().map_err(|_| anyhow!("a flight panicked"))?.map_err(anyhow::Error::from)
        })
    })?;
    Ok(flights as f64 / started.elapsed().as_secs_f64())
}

pub fn measure(effort: &Effort, report: &mut Report) -> Result<()> {
    let start = flight(&Set { settings: Vec::new() })?;
    let cores = std::thread::available_parallelism()?.get();
    let mut best = [0.0_f64; 2];
    for (best, threads) in best.iter_mut().zip([1, cores]) {
        let mut rates = Vec::new();
        for run in 0..RUNS {
            errln!("  {threads} threads, run {} of {RUNS}", run + 1);
            rates.push(rate(&start, effort.many, threads)?);
        }
        let spread = Spread::of(rates);
        *best = spread.largest;
        let what = format!("{} flights of 2 s, {threads} threads", effort.many);
        report.line(what, spread, "flights/s", "steps of 10 ms");
    }
    let efficiency = 100.0 * best[1] / (best[0] * cores as f64);
    report.line("efficiency of all cores", Spread::exact(efficiency), "%", "aim 95; best of runs");
    Ok(())
}
