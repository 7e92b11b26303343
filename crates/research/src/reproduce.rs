//! `cargo ahv reproduce`: compares every table, claim and computed figure of the paper with ours.

mod claims;
mod claims_page;
mod coefficient_sets;
mod compute;
mod eigenvectors;
mod figures;
mod fit_errors;
mod html;
mod identified;
mod inertia_laws;
mod interaction;
mod interaction_text;
mod markdown;
mod operating_point;
mod origin;
mod origin_page;
mod report;
mod root_tracking;
mod roots;
mod sweep;
mod tables;
mod veering;
mod verdict;

use crate::cli;
use ahv_tool::workspace::{can_write, shown, target, write_together};
use anyhow::Result;
use clap::ValueEnum;

/// Parts of the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Part {
    /// Natural frequencies
    Table1,
    /// Poles
    Table2,
    /// Zeros
    Table3,
    /// Bending stiffness
    Fig3,
    /// Mode shapes
    Fig5,
    /// Poles and zeros over fuel
    Fig6,
    /// Poles and zeros over slosh damping
    Fig7,
    /// Poles and zeros over slosh frequency
    Fig8,
    /// Conclusions of the paper from figs 6 to 8
    Claims,
    /// Interaction of slosh, beam and short period
    Interaction,
    /// Trade-off in the identification of xu2015
    Tradeoff,
    /// Origin of the printed digits
    Origin,
    /// Errors of the fit shock_expansion
    Fit,
    /// Errata of the paper
    Errata,
}

pub fn run(options: &cli::Reproduce) -> Result<()> {
    let started = std::time::Instant::now();
    let sets = coefficient_sets::chosen(&options.aero)?;
    let parts = match options.only.as_slice() {
        [] => Part::value_variants(),
        only => only,
    };
    let directory = options.output.clone().unwrap_or_else(|| target().join("report"));
    can_write(&directory.join("report.html"))?;
    let work = compute::Computation::new(parts, directory.join("figures"))?;
    let report = work.report(&sets)?;
    let mut files = work.drawn.into_inner();

    let markdown = markdown::render(&report);
    let svg = |link: &str| String::from_utf8(files.get(&directory.join(link))?.clone()).ok();
    let html = html::render(&markdown, "The paper's results compared with ours", svg);
    for (name, content) in [
        ("report.html", html),
        ("report.md", markdown),
        ("report.json", format!("{:#}\n", serde_json::to_value(&report)?)),
    ] {
        files.insert(directory.join(name), content.into_bytes());
    }
    write_together(&files)?;
    for file in files.keys() {
        outln!("{}", shown(file))?;
    }
    outln!("done in {:.1} s", started.elapsed().as_secs_f64())?;
    Ok(())
}
