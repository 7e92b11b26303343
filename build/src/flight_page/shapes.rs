//! Mode shapes, which the FMU tells at the station of its IMU: one instance is asked per station.

use crate::fmu::Fmu;
use crate::master::Instance;
use crate::settings::Setting;
use anyhow::{Context, Result};
use serde_json::{Value, json};

/// Enough for the third mode, which has four nodes; the page interpolates with cubics.
const STATIONS: usize = 21;
const MODES: usize = 3;
const ASKED: [&str; 2 * MODES] =
    ["shape1_imu", "shape2_imu", "shape3_imu", "slope1_imu", "slope2_imu", "slope3_imu"];

/// Displacement and slope of the modes along the body; null if the FMU does not tell them, and then the page draws a
/// straight vehicle.
pub fn sample(fmu: &Fmu, settings: &[Setting], length_m: f64) -> Value {
    let station = |index: usize| length_m * index as f64 / (STATIONS - 1) as f64;
    let stations: Vec<f64> = (0..STATIONS).map(station).collect();
    let asked: Result<Vec<Vec<f64>>> =
        stations.iter().map(|station| ask(fmu, settings, *station)).collect();
    let Ok(columns) = asked else { return Value::Null };
    let row = |row: usize| -> Vec<f64> { columns.iter().map(|column| column[row]).collect() };
    json!({
        "stations": stations,
        "displacement": (0..MODES).map(row).collect::<Vec<_>>(),
        "slope": (MODES..2 * MODES).map(row).collect::<Vec<_>>(),
    })
}

/// The variables of [`ASKED`] with the IMU at a station.
fn ask(fmu: &Fmu, settings: &[Setting], station_m: f64) -> Result<Vec<f64>> {
    let find = |name: &str| fmu.model.find(name).with_context(|| format!("no variable {name}"));
    let asked: Result<Vec<u32>> =
        ASKED.iter().map(|name| Ok(find(name)?.value_reference)).collect();
    let imu = find("imu_station")?;
    let mut instance = Instance::new(fmu)?;
    // Burning changes the modes in flight, and takes long to prepare; these are those at the start.
    let of_the_start = |name: &str| !["imu_station", "fuel_burn"].contains(&name);
    for setting in settings.iter().filter(|setting| of_the_start(&setting.variable.name)) {
        instance.set(setting.variable, setting.value)?;
    }
    instance.set(imu, station_m)?;
    instance.set_up(0.0, 1.0, 1e-8)?;
    instance.initialise()?;
    instance.get(&asked?)
}
