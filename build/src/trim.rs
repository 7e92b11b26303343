//! `cargo ahv trim`: prints the trimmed flight.

use crate::cli::{Analyse, Set};
use crate::model_description::ModelDescription;
use crate::own_vehicle::OwnVehicle;
use crate::settings;
use crate::table::{number, row, table};
use ahv::flight::{Flight, Setup};
use ahv::fmu::Message;
use ahv::vehicle::{H, eta};
use anyhow::{Result, anyhow};
use fmi_model::describe::model_description_of;
use fmi_model::standard::Standard;
use fmi_model::table::find;
use serde_json::json;

/// A flight of the built-in vehicle with the parameters set on the command line.
pub fn flight(set: &Set) -> Result<Flight> {
    Ok(setup(&OwnVehicle::default(), set)?.fly().map_err(Message)?)
}

/// The set-up with the parameters set on the command line, which are checked against the model description as in
/// `fly`.
pub fn setup(own: &OwnVehicle, set: &Set) -> Result<Setup> {
    let mut setup = own.setup()?;
    let model = ModelDescription::parse(&model_description_of(&setup, Standard::Fmi2)?)?;
    for setting in settings::parse(&model, &set.settings)? {
        let name = &setting.variable.name;
        let variable = find::<Setup>(name).ok_or_else(|| anyhow!("no variable {name}"))?;
        variable.set(&mut setup, setting.value)?;
    }
    Ok(setup)
}

/// Name of the configuration.
pub fn configuration(setup: &Setup) -> String {
    format!("{:?}", setup.parameters.options.configuration)
}

pub fn run(options: &Analyse) -> Result<()> {
    let setup = setup(&options.own_vehicle, &options.set)?;
    let flight = setup.fly().map_err(Message)?;
    let (vehicle, trim) = (flight.vehicle(), flight.trim());
    let loads = vehicle.loads(&trim.state, &trim.control);
    let (_, outputs) = vehicle.derivatives_and_outputs(&trim.state, &trim.control, [0.0; 2]);
    let (gravity, _) = vehicle.atmosphere.gravity(trim.state[H]);
    let [v, h, gamma, alpha, ..] = trim.state;
    let [delta_e, phi] = trim.control;
    let elastic = |mode: usize| trim.state[eta(mode)];

    // Name, SI value, SI unit, displayed unit and its factor.
    let degrees = ("deg", 1f64.to_degrees());
    let millimetres = ("mm", 1e3);
    let mut rows = vec![
        ("mach", loads.mach, "1", ("1", 1.0)),
        ("V", v, "m/s", ("m/s", 1.0)),
        ("h", h, "m", ("m", 1.0)),
        ("gamma", gamma, "rad", degrees),
        ("qbar", loads.qbar, "Pa", ("kPa", 1e-3)),
        ("alpha", alpha, "rad", degrees),
        ("delta_e", delta_e, "rad", degrees),
        ("phi", phi, "1", ("1", 1.0)),
        ("weight", vehicle.airframe.mass * gravity, "N/m", ("kN/m", 1e-3)),
        ("lift", loads.lift, "N/m", ("kN/m", 1e-3)),
        ("drag", loads.drag, "N/m", ("kN/m", 1e-3)),
        ("thrust", loads.thrust, "N/m", ("kN/m", 1e-3)),
        ("moment", loads.moment, "N", ("N", 1.0)),
        ("n_z", outputs.n_z, "1", ("g", 1.0)),
    ];
    let flexible = ["eta1", "eta2", "eta3", "eta_slosh1", "eta_slosh2"];
    for (mode, name) in flexible.into_iter().enumerate().take(vehicle.modes) {
        rows.push((name, elastic(mode), "m", millimetres));
    }
    if options.json {
        let values = rows
            .iter()
            .map(|(name, value, unit, _)| {
                (name.to_string(), json!({ "value": value, "unit": unit }))
            })
            .collect::<serde_json::Map<_, _>>();
        let whole = json!({ "configuration": configuration(&setup), "trim": values });
        outln!("{whole:#}")?;
        return Ok(());
    }
    let mut text = vec![row(["quantity", "value", "unit"])];
    for (name, value, _, (unit, factor)) in rows {
        text.push(vec![name.to_string(), number(value * factor), unit.to_string()]);
    }
    let kind = if setup.parameters.trim { "Trimmed flight" } else { "Initial state, not trimmed" };
    outln!("{kind}, {}; forces per metre of width", configuration(&setup))?;
    out!("{}", table(&text))?;
    Ok(())
}
