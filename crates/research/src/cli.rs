//! Command line of the research commands of `cargo ahv`.

use crate::reproduce::Part;
use ahv_tool::cli::Set;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Derives the numbers of ahv, and compares them.
#[derive(Debug, Parser)]
#[command(name = "cargo ahv", bin_name = "cargo ahv", version, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    Reproduce(Reproduce),
    Identify(Identify),
    Fit(Fit),
    Methods(Compare),
    Bench(Bench),
}

/// Compare every table, claim and computed figure of the paper with ours; write a report
#[derive(Debug, Args)]
#[command(after_help = "\
Output files: report.html (self-contained), report.md, report.json, figures/*.svg, figures/*.png.

Examples:
  cargo ahv reproduce
  cargo ahv reproduce --only table2,claims
  cargo ahv reproduce --only fig6 --only fig8 --output target/sweeps
  cargo ahv reproduce --aero all")]
pub struct Reproduce {
    /// Only this part (repeatable, or separated by commas)
    #[arg(long, value_name = "PART", value_enum, value_delimiter = ',')]
    pub only: Vec<Part>,
    /// Coefficient set, or `all` (repeatable, or separated by commas) [default: that of the FMU]
    #[arg(long, value_name = "SET", value_delimiter = ',')]
    pub aero: Vec<String>,
    /// Directory for the report [default: target/report]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Identify unpublished numbers from published results; write their data file
#[derive(Debug, Args)]
#[command(after_help = "\
What can be identified:
  beam     stiffness and tanks: those nearest to a prior that give Table 1 and the growth of
           the short period from even to sloshing mass in Table 2; writes them to
           src/data/vehicle.toml
  xu2015   coefficient set: parker2007, changed as little as possible to approach Tables 2
           and 3; writes src/data/aero/xu2015.toml

Examples:
  cargo ahv identify beam --check      fail if the committed numbers are out of date
  cargo ahv identify xu2015            write the file; print trade-off, numbers and cells
  cargo ahv identify xu2015 --check    fail if the committed file is out of date
  cargo ahv identify xu2015 --json     print JSON")]
pub struct Identify {
    /// What to identify
    pub what: Identified,
    /// Compare with the file instead of writing it; fail if they differ
    #[arg(long)]
    pub check: bool,
    /// Print JSON in SI units and radians
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Identified {
    #[value(help = "Stiffness of the beam, positions and sizes of the tanks")]
    Beam,
    #[value(help = "Coefficient set of eq. (4)")]
    Xu2015,
}

/// Fit the curves of eq. (4) to the first-principles model; write src/data/aero/shock_expansion.toml
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv fit            write the file and print the errors of the fit
  cargo ahv fit --check    fail if the committed file is out of date

The numbers are part of the library: run `cargo ahv describe` after a change.")]
pub struct Fit {
    /// Compare with the file instead of writing it; fail if they differ
    #[arg(long)]
    pub check: bool,
}

/// Compare integration methods on the vehicle: right-hand sides and instructions for an error
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv methods
  cargo ahv methods --set configuration=Rigid")]
pub struct Compare {
    #[command(flatten)]
    pub set: Set,
    /// Fly with this method under callgrind, `calls` times
    #[arg(long, hide = true)]
    pub probe: Option<String>,
    #[arg(long, hide = true, default_value_t = 1)]
    pub calls: usize,
}

/// Measure speed and size against other integrators, Python and SciPy; write a table and a figure
#[derive(Debug, Args)]
#[command(after_help = "\
Output files: bench.json, precision.svg, precision.png. What is not installed is skipped: valgrind,
libsundials-dev, the Python environment of `cargo ahv test`; PythonFMU is installed into target/bench.

Examples:
  cargo ahv bench                       a few minutes
  cargo ahv bench --only precision,instructions
  cargo ahv bench --quick               rough numbers, to check that everything runs")]
pub struct Bench {
    /// Only this part (repeatable, or separated by commas)
    #[arg(long, value_name = "PART", value_enum, value_delimiter = ',')]
    pub only: Vec<BenchPart>,
    /// Few repetitions, 100 flights and instances instead of 10,000
    #[arg(long)]
    pub quick: bool,
    /// Directory for the results [default: target/bench]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Run this under callgrind, `calls` times
    #[arg(long, hide = true)]
    pub probe: Option<Probe>,
    #[arg(long, hide = true, default_value_t = 1)]
    pub calls: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BenchPart {
    /// Error against time, compared with SUNDIALS and SciPy
    Precision,
    /// Instructions of a right-hand side, of a step, and of a start with fuel_burn
    Instructions,
    /// Steps in FMPy, compared with empty steps and a PythonFMU
    Masters,
    /// From loading the library to the first step; the modes compared with SciPy
    Start,
    /// Size of library, instance and saved state
    Size,
    /// Many flights on all cores
    Ensemble,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Probe {
    Rates,
    Outputs,
    Steps,
    Burning,
}
