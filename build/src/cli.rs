//! Command line of `cargo ahv`.

use crate::models::{PackagedModel, named};
use crate::own_vehicle::OwnVehicle;
use clap::{Args, Parser, Subcommand, ValueEnum};
use fmi_model::standard::Standard;
use std::ffi::OsString;
use std::path::PathBuf;

/// Builds, flies, analyses and tests the FMU of a hypersonic vehicle with flexible fuselage and
/// sloshing propellant.
#[derive(Debug, Parser)]
#[command(name = "cargo ahv", bin_name = "cargo ahv", version, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    Describe(Describe),
    Package(Package),
    Fly(Fly),
    Modes(Modes),
    /// Print the trimmed flight: incidence, controls, forces, static deflections
    #[command(after_help = TRIM_HELP)]
    Trim(Analyse),
    Poles(Poles),
    Wheel(Wheel),
    Site(Site),
    Test(Test),
    /// Compare every table, claim and computed figure of the paper with ours; write a report
    Reproduce(Research),
    /// Identify unpublished numbers from published results; write their data file
    Identify(Research),
    /// Fit the curves of eq. (4) to the first-principles model; write their data file
    Fit(Research),
    /// Compare integration methods on the vehicle: right-hand sides against error
    Methods(Research),
    /// Measure speed and size against other integrators, Python and SciPy; write a table and a figure
    Bench(Research),
}

/// Arguments passed on to crates/research, which is compiled at its first command.
#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub struct Research {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
    pub arguments: Vec<OsString>,
}

/// Write the model descriptions from the table of variables
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv describe            write modelDescription/modelDescription.xml for FMI 2.0 and
                                modelDescription/fmi3/modelDescription.xml for FMI 3.0,
                                those of the other models in modelDescription/IDENTIFIER
  cargo ahv describe --check    fail if a committed file is out of date")]
pub struct Describe {
    /// Compare with the files instead of writing them; fail if they differ
    #[arg(long)]
    pub check: bool,
    /// File to write or compare
    #[arg(long, value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Version of the standard [default: both; 2 with --file]
    #[arg(long, value_name = "VERSION")]
    pub fmi: Option<Fmi>,
    /// Describe this model only: vehicle, autopilot, actuator, sensor [default: all; vehicle with --file]
    #[arg(long, value_name = "NAME", value_parser = named)]
    pub model: Option<&'static PackagedModel>,
}

/// A version of the standard, as the user names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Fmi {
    /// FMI 2.0
    #[value(name = "2")]
    Two,
    /// FMI 3.0
    #[value(name = "3")]
    Three,
}

impl From<Fmi> for Standard {
    fn from(version: Fmi) -> Self {
        match version {
            Fmi::Two => Self::Fmi2,
            Fmi::Three => Self::Fmi3,
        }
    }
}

/// Build the libraries and write the FMUs of the vehicle, its autopilot, an actuator and a sensor
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv package
      build for all platforms that this machine has compilers for, and write target/ahv.fmu,
      target/ahv_autopilot.fmu, target/ahv_actuator.fmu and target/ahv_sensor.fmu
  cargo ahv package --model autopilot --host-only
      target/ahv_autopilot-host.fmu alone, for this machine
  cargo ahv package --vehicle mine.toml --coefficients my_air.toml
      the FMU of your own vehicle, target/own/ahv.fmu
  cargo ahv package --library linux64=ahv.so --library win64=ahv.dll
      package libraries that were built elsewhere, for several platforms")]
pub struct Package {
    /// Package this model only: vehicle, autopilot, actuator, sensor [default: all; vehicle with --output, --library
    /// or data of your own]
    #[arg(long, value_name = "NAME", value_parser = named)]
    pub model: Option<&'static PackagedModel>,
    /// FMU to write [default: target/IDENTIFIER.fmu, as target/ahv.fmu]
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Fail if the library for a platform cannot be built
    #[arg(long, conflicts_with = "library")]
    pub all_targets: bool,
    /// Build for this machine and its C library only, which is faster; writes target/ahv-host.fmu and so on
    #[arg(long, conflicts_with_all = ["library", "all_targets"])]
    pub host_only: bool,
    /// Package this library instead of building one (repeatable); platforms: linux64, win64,
    /// darwin64, aarch64-linux, aarch64-windows, aarch64-darwin, or the names of FMI 3.0
    #[arg(long, value_name = "PLATFORM=FILE")]
    pub library: Vec<String>,
    #[command(flatten)]
    pub own_vehicle: OwnVehicle,
}

/// Fly a manoeuvre with the FMU; write the time history as CSV and as figures
#[derive(Debug, Args)]
#[command(after_help = "\
Input file: CSV with the header `time,delta_e,phi` or any other inputs; time in s, delta_e in rad
(or `delta_e[deg]` in degrees), phi without unit. Inputs are linear between rows; a jump is two
rows with the same time, the values before and after it. The first row also holds before its time,
the last row after. With the default input mode delta_e and phi are deviations from trim.

Output files: flight.csv (time, all inputs, all outputs; SI units and radians), which is also a
valid input file; flight.svg and flight.png; flight.html, the flight as a page.

Examples:
  cargo ahv fly
  cargo ahv fly --input examples/throttle_step.csv --set configuration=Rigid
  cargo ahv fly --set mach0=9 --set altitude0=27000 --stop 1
  cargo ahv fly --set gamma0=1deg --fmu target/ahv.fmu --output target/climb")]
pub struct Fly {
    /// Input file [default: examples/elevator_doublet.csv]
    #[arg(long, value_name = "FILE.csv")]
    pub input: Option<PathBuf>,
    /// Directory for the results [default: target/flight]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Communication step size, s [default: 0.01]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub step: Option<f64>,
    /// Stop time, s [default: from the FMU]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub stop: Option<f64>,
    /// Relative tolerance of the integration [default: from the FMU]
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    #[command(flatten)]
    pub set: Set,
    /// Fly this FMU instead of building one
    #[arg(long, value_name = "FILE.fmu", conflicts_with_all = ["vehicle", "coefficients"])]
    pub fmu: Option<PathBuf>,
    /// Fly the FMU of this version of the standard [default: 2]
    #[arg(long, value_name = "VERSION", conflicts_with = "fmu")]
    pub fmi: Option<Fmi>,
    /// Build for this machine and its C library only, which is faster; flies target/ahv-host.fmu
    #[arg(long, conflicts_with = "fmu")]
    pub host_only: bool,
    #[command(flatten)]
    pub own_vehicle: OwnVehicle,
}

/// Parameters set on the command line.
#[derive(Debug, Args)]
pub struct Set {
    /// Set a parameter (repeatable); enumerations by name or number, reals in the FMU's unit
    /// or with a unit after the number: gamma0=1deg
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,
}

const TRIM_HELP: &str = "\
Examples:
  cargo ahv trim
  cargo ahv trim --set configuration=Rigid --set mach0=9
  cargo ahv trim --set gamma0=1deg --json";

/// Options of the commands that analyse the model.
#[derive(Debug, Args)]
pub struct Analyse {
    #[command(flatten)]
    pub set: Set,
    /// Print JSON in SI units and radians
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub own_vehicle: OwnVehicle,
}

/// Print frequencies, damping and slosh displacements of the modes
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv modes
  cargo ahv modes --set fuel_fraction=0.5 --set slosh_damping=0.02
  cargo ahv modes --set configuration=EvenMassBeam --json
  cargo ahv modes --elements    input of crates/research/bench/modes_vs_eigsh.py")]
pub struct Modes {
    /// Print the eigenproblem as JSON: beam elements and sloshing masses
    #[arg(long)]
    pub elements: bool,
    #[command(flatten)]
    pub analyse: Analyse,
}

/// Print poles and transmission zeros (delta_e, phi to V, gamma) in trimmed flight
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv poles
  cargo ahv poles --all
  cargo ahv poles --set configuration=Rigid --json")]
pub struct Poles {
    /// Show all configurations side by side
    #[arg(long)]
    pub all: bool,
    #[command(flatten)]
    pub analyse: Analyse,
}

/// Build the Python package with all FMUs inside: target/ahv-VERSION-py3-none-any.whl
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv wheel                                 with target/ahv.fmu, built first if missing or old
  cargo ahv wheel --fmu target/ahv-host.fmu       for this machine only
  pip install target/ahv-*.whl")]
pub struct Wheel {
    /// FMU of the vehicle for FMI 2.0, with the others beside it [default: target/ahv.fmu]
    #[arg(long, value_name = "FILE.fmu")]
    pub fmu: Option<PathBuf>,
}

/// Build the page in which the vehicle flies in a browser: target/site/index.html
#[derive(Debug, Args)]
#[command(after_help = "\
The page is one file and works from a disk. It needs Node 20 or newer; the packages are installed into
target/node.

Examples:
  cargo ahv site
  cargo ahv site --fmu target/ahv.fmu --output public")]
pub struct Site {
    /// FMU of FMI 2.0; that of FMI 3.0 beside it has the component [default: target/ahv.fmu]
    #[arg(long, value_name = "FILE.fmu")]
    pub fmu: Option<PathBuf>,
    /// Folder for the page [default: target/site]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Check format, lints, Rust tests, description, package, and the FMU in FMPy
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  cargo ahv test                             while you work: three minutes once compiled
  cargo ahv test --thorough                  before you submit a change: half an hour
  cargo ahv test --thorough --all-targets    also fail if a platform cannot be built or tested")]
pub struct Test {
    /// Also test examples, the Python package, other masters, 100,000 random call sequences, sanitizer,
    /// valgrind, benchmarks, Windows and ARM
    #[arg(long)]
    pub thorough: bool,
    /// Stop at the first step that fails
    #[arg(long)]
    pub fail_fast: bool,
    /// Fail if the library for a platform or the WebAssembly component cannot be built, or not be tested here
    #[arg(long)]
    pub all_targets: bool,
}
