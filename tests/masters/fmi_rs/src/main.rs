//! Flies an FMU in fmi-rs: `fly cs|me FMU INPUT.csv RESULT.csv STEP STOP VARIABLES [NAME=VALUE ...]`.

mod solver;

use fmi_rs::fmi2::builder::FMU2Builder;
use fmi_rs::sim::fmi2::csv::{read_csv, write_csv};
use fmi_rs::sim::fmi2::input::StaticInput;
use fmi_rs::sim::fmi2::recorder::Recorder;
use fmi_rs::sim::fmi2::{SimulationSettings, Trajectories, cs, me};
use std::error::Error;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// Two times are one if they differ relatively by less.
const TIME_TOLERANCE: f64 = 1e-9;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, fmu, input, result, step, stop, variables, start @ ..] = arguments.as_slice() else {
        return Err("seven arguments and start values".into());
    };
    let fmu = FMU2Builder::new(&Path::new(fmu))?;
    let description = Arc::new(fmu.model_description);
    let start_values = start
        .iter()
        .filter_map(|given| given.split_once('='))
        .map(|(name, value)| (name.to_string(), value.to_string()))
        .collect();
    let settings = SimulationSettings {
        unzipdir: fmu.unzipdir.path().to_path_buf(),
        model_description: description.clone(),
        start_time: 0.0,
        stop_time: stop.parse()?,
        logging_on: false,
        set_stop_time: false,
        output_interval: step.parse()?,
        log_time_scale: false,
        tolerance: TIME_TOLERANCE,
        set_tolerance: false,
        start_values,
        log_fmi_calls: false,
        input_file: None,
        early_return_allowed: false,
        event_mode_used: false,
        log_file: None,
        initial_fmu_state_file: None,
        final_fmu_state_file: None,
    };
    let controls = read_csv(File::open(input)?, description.clone())?;
    let controls = Some(Arc::new(StaticInput::new(controls, TIME_TOLERANCE)));
    let columns: Result<Vec<_>, _> =
        variables.split(',').map(|name| description.variable_index_by_name(name)).collect();
    #[expect(clippy::arc_with_non_send_sync, reason = "fmi-rs takes it so")]
    let recorder = Arc::new(Recorder::new(Trajectories::new(description.clone(), columns?)));
    match kind.as_str() {
        "cs" => cs::simulate(&settings, controls, recorder.clone())?,
        "me" => me::simulate(&settings, &solver::Extrapolation, controls, recorder.clone())?,
        other => return Err(format!("cs or me, not {other}").into()),
    }
    write_csv(&recorder.trajectories.borrow(), result)?;
    Ok(())
}
