//! What can be typed after `cargo ahv` of what makes the numbers.

use crate::reproduce::Part;
use ahv_tool::cli::Set;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// What makes the numbers of ahv, and what they are measured against.
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

/// Set every table, claim and computed figure of the paper beside ours; write a report
#[derive(Debug, Args)]
#[command(after_help = "\
Output files: report.html (stands alone), report.md, report.json, figures/*.svg, figures/*.png.

Examples:
  cargo ahv reproduce
  cargo ahv reproduce --only table2,claims
  cargo ahv reproduce --only fig6 --only fig8 --output target/sweeps
  cargo ahv reproduce --aero all")]
pub struct Reproduce {
    /// Only this part (may be repeated or separated by commas)
    #[arg(long, value_name = "PART", value_enum, value_delimiter = ',')]
    pub only: Vec<Part>,
    /// Coefficient set, or `all` (may be repeated or separated by commas) [default: that of the FMU]
    #[arg(long, value_name = "SET", value_delimiter = ',')]
    pub aero: Vec<String>,
    /// Directory for the report [default: target/report]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Find numbers that are not published from results that are; write their data file
#[derive(Debug, Args)]
#[command(after_help = "\
What can be identified:
  beam     stiffness and tanks: the most ordinary ones that give Table 1 and, from even to
           sloshing mass, the growth of the short period in Table 2; writes their numbers in
           src/data/vehicle.toml
  xu2015   coefficient set: parker2007 moved as little as possible towards Tables 2 and 3;
           writes src/data/aero/xu2015.toml

Examples:
  cargo ahv identify beam --check      fail if the committed numbers are not what comes out
  cargo ahv identify xu2015            write the file; print trade-off, numbers and cells
  cargo ahv identify xu2015 --check    fail if the committed file is not what comes out
  cargo ahv identify xu2015 --json     the same for a program")]
pub struct Identify {
    /// Which numbers
    pub what: Identified,
    /// Compare instead of writing; fail if they differ
    #[arg(long)]
    pub check: bool,
    /// Print JSON, in SI units and radians
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Identified {
    #[value(help = "Stiffness of the beam, places and sizes of the tanks")]
    Beam,
    #[value(help = "Coefficient set of eq. (4)")]
    Xu2015,
}

/// Fit the curves of eq. (4) to the first-principles model and write src/data/aero/shock_expansion.toml
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv fit            write the file; the errors of the fit are printed
  cargo ahv fit --check    fail if the committed file is not what would be written

The numbers are part of the library: run `cargo ahv describe` after a change.")]
pub struct Fit {
    /// Compare instead of writing; fail if they differ
    #[arg(long)]
    pub check: bool,
}

/// Integration methods compared: right-hand sides against error, on the vehicle itself
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv methods
  cargo ahv methods --set configuration=Rigid")]
pub struct Compare {
    #[command(flatten)]
    pub set: Set,
}

/// Measure speed and size beside other integrators, Python and SciPy; write a table and a picture
#[derive(Debug, Args)]
#[command(after_help = "\
Output files: bench.json, precision.svg, precision.png. What is not installed is left out: valgrind,
libsundials-dev, the Python environment of `cargo ahv test`; PythonFMU is installed into target/bench.

Examples:
  cargo ahv bench                       a few minutes
  cargo ahv bench --only precision,instructions
  cargo ahv bench --quick               rough numbers, to see that everything runs")]
pub struct Bench {
    /// Only this part (may be repeated or separated by commas)
    #[arg(long, value_name = "PART", value_enum, value_delimiter = ',')]
    pub only: Vec<BenchPart>,
    /// Few repetitions, 100 flights and instances instead of 10,000
    #[arg(long)]
    pub quick: bool,
    /// Directory for the results [default: target/bench]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Do this many times, for callgrind to count
    #[arg(long, hide = true)]
    pub probe: Option<Probe>,
    #[arg(long, hide = true, default_value_t = 1)]
    pub calls: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BenchPart {
    /// Error against time, beside SUNDIALS and SciPy
    Precision,
    /// Instructions of a right-hand side and of a step
    Instructions,
    /// Steps in FMPy, beside steps that do nothing and a PythonFMU
    Masters,
    /// From loading the library to the first step; the modes beside SciPy
    Start,
    /// Library, instance, saved state
    Size,
    /// Many flights on all cores
    Ensemble,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Probe {
    Rates,
    Outputs,
    Steps,
}
