//! Flies an FMU in fmi-rs: `fly 2|3 cs|me FMU INPUT.csv RESULT.csv STEP STOP VARIABLES [NAME=VALUE ...]`, with the version
//! of the standard first.

mod solver;

use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// Two times are one if they differ relatively by less.
const TIME_TOLERANCE: f64 = 1e-9;

/// What is wanted.
struct Arguments<'a> {
    kind: &'a str,
    fmu: &'a Path,
    input: &'a Path,
    result: &'a Path,
    step: f64,
    stop: f64,
    variables: Vec<&'a str>,
    start_values: Vec<(String, String)>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [version, kind, fmu, input, result, step, stop, variables, start @ ..] =
        arguments.as_slice()
    else {
        return Err("eight arguments and start values".into());
    };
    let start_values = start.iter().filter_map(|given| given.split_once('='));
    let arguments = Arguments {
        kind,
        fmu: Path::new(fmu),
        input: Path::new(input),
        result: Path::new(result),
        step: step.parse()?,
        stop: stop.parse()?,
        variables: variables.split(',').collect(),
        start_values: start_values
            .map(|(name, value)| (name.to_string(), value.to_string()))
            .collect(),
    };
    match version.as_str() {
        "2" => fmi2(arguments),
        "3" => fmi3(arguments),
        other => Err(format!("2 or 3, not {other}").into()),
    }
}

/// A flight: fmi-rs has the same modules for both versions, with types of their own.
macro_rules! flight {
    ($version:ident, $builder:ident, $($more:tt)*) => {
        fn $version(arguments: Arguments) -> Result<(), Box<dyn Error>> {
            use fmi_rs::$version::builder::$builder;
            use fmi_rs::sim::$version::csv::{read_csv, write_csv};
            use fmi_rs::sim::$version::input::StaticInput;
            use fmi_rs::sim::$version::recorder::Recorder;
            use fmi_rs::sim::$version::{SimulationSettings, Trajectories, cs, me};

            let fmu = $builder::new(&arguments.fmu)?;
            let description = Arc::new(fmu.model_description);
            let settings = SimulationSettings {
                unzipdir: fmu.unzipdir.path().to_path_buf(),
                model_description: description.clone(),
                start_time: 0.0,
                stop_time: arguments.stop,
                logging_on: false,
                set_stop_time: false,
                output_interval: arguments.step,
                log_time_scale: false,
                tolerance: TIME_TOLERANCE,
                set_tolerance: false,
                start_values: arguments.start_values,
                log_fmi_calls: false,
                input_file: None,
                early_return_allowed: false,
                event_mode_used: false,
                log_file: None,
                initial_fmu_state_file: None,
                final_fmu_state_file: None,
                $($more)*
            };
            let controls = read_csv(File::open(arguments.input)?, description.clone())?;
            let controls = Some(Arc::new(StaticInput::new(controls, TIME_TOLERANCE)));
            let columns: Result<Vec<_>, _> = arguments
                .variables
                .iter()
                .map(|name| description.variable_index_by_name(name))
                .collect();
            #[allow(clippy::arc_with_non_send_sync, reason = "fmi-rs takes it so")]
            let recorder = Arc::new(Recorder::new(Trajectories::new(description.clone(), columns?)));
            match arguments.kind {
                "cs" => cs::simulate(&settings, controls, recorder.clone())?,
                "me" => me::simulate(&settings, &solver::Extrapolation, controls, recorder.clone())?,
                other => return Err(format!("cs or me, not {other}").into()),
            }
            write_csv(&recorder.trajectories.borrow(), arguments.result)?;
            Ok(())
        }
    };
}

flight!(fmi2, FMU2Builder,);
flight!(fmi3, FMU3Builder,
    library_kind: fmi_rs::fmi3::LibraryKind::Native,
    enable_dae: false,
    visible: false,
    intermediate_update: false,
);
