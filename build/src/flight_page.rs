//! flight.html: the page of a flight, with the vehicle and its time history at the time of a slider.

mod shapes;

use crate::fmu::Fmu;
use crate::model_description::{Causality, ModelDescription, Variable};
use crate::record::Record;
use crate::settings::Setting;
use ahv::data::{Data, OwnFiles, VehicleData};
use anyhow::Result;
use serde_json::{Value, json};

/// The page without data, from site/src/replay.html: `cargo ahv site` writes it, a test compares.
pub const TEMPLATE: &str = include_str!("../pages/flight.html");
/// Where the data go.
const PLACE: &str = r#"id="data">"#;

/// Most rows in a page, which then has less than 2 MB; of a longer flight every n-th is taken.
const MAX_ROWS: usize = 2500;

/// Outputs without which there is no picture of the vehicle.
const DRAWN: [&str; 12] = [
    "theta",
    "gamma",
    "mach",
    "alpha_probe",
    "eta1",
    "eta2",
    "eta3",
    "slosh1",
    "slosh2",
    "delta_e_effective",
    "phi_effective",
    "fuel_mass",
];

/// What the page says of a flight.
pub struct Flight<'a> {
    pub fmu: &'a Fmu,
    pub record: &'a Record,
    pub settings: &'a [Setting<'a>],
    /// Calculated parameters, in the units of the FMU, by name.
    pub calculated: &'a [(&'a Variable, f64)],
    /// At the start.
    pub fuel_fraction: Option<f64>,
    pub title: &'a str,
    /// About experiment and inputs.
    pub summary: &'a str,
    /// Why the flight ended early, or an empty text.
    pub ended: &'a str,
}

/// The page; none if the FMU is not of a vehicle that can be drawn.
pub fn html(flight: &Flight) -> Result<Option<String>> {
    if DRAWN.iter().any(|name| flight.record.column(name).is_none()) {
        return Ok(None);
    }
    // `<` would end the element that holds the data.
    let data = data(flight)?.to_string().replace('<', "\\u003c");
    Ok(Some(TEMPLATE.replacen(PLACE, &format!("{PLACE}{data}"), 1)))
}

fn data(flight: &Flight) -> Result<Value> {
    let Flight { fmu, record, settings, calculated, fuel_fraction, title, summary, ended } = flight;
    let model = &fmu.model;
    let rows: Vec<&Vec<f64>> = thinned(&record.rows);
    let summary = match rows.len() == record.rows.len() {
        true => (*summary).to_string(),
        false => format!(
            "{summary}. This page has {} of {} rows; flight.csv has all.",
            rows.len(),
            record.rows.len()
        ),
    };
    let columns: Vec<Vec<f64>> = (0..record.names.len())
        .map(|column| rows.iter().map(|row| row[column]).collect())
        .collect();
    let vehicle = Data::with(&OwnFiles::in_folder(&fmu.resources())?)?.vehicle;
    let calculated_value = |name: &str| {
        calculated.iter().find(|(known, _)| known.name == name).map(|(_, value)| *value)
    };
    let fuel = fuel_fraction.filter(|fuel| *fuel > 0.0);
    let fuel_mass = record.column("fuel_mass").and_then(|column| record.values(column).next());
    Ok(json!({
        "title": title,
        "summary": summary,
        "ended": ended,
        "vehicle": drawing(&vehicle),
        "shapes": shapes::sample(fmu, settings, vehicle.geometry.length_m.value),
        "mass_centre_m": calculated_value("mass_centre").unwrap_or_default(),
        "full_tanks_kg_per_m": fuel.zip(fuel_mass).map_or(1.0, |(fuel, mass)| mass / fuel),
        "variables": variables(model),
        "set": set(model, settings, calculated),
        "names": record.names,
        "columns": columns,
    }))
}

/// At most [`MAX_ROWS`] rows at equal distances, and the last.
fn thinned(rows: &[Vec<f64>]) -> Vec<&Vec<f64>> {
    let every = rows.len().div_ceil(MAX_ROWS - 1).max(1);
    let mut kept: Vec<_> = rows.iter().step_by(every).collect();
    if !(rows.len() - 1).is_multiple_of(every) {
        kept.extend(rows.last());
    }
    kept
}

/// What a picture needs of the data file.
fn drawing(vehicle: &VehicleData) -> Value {
    let VehicleData { geometry, outline, engine, tank, .. } = vehicle;
    let tanks = tank.iter().map(|tank| {
        json!({
            "name": tank.name,
            "centre_m": tank.centre_m.value,
            "length_m": tank.length_m.value,
            "depth_full_m": tank.depth_full_m.value,
        })
    });
    json!({
        "geometry": {
            "length_m": geometry.length_m.value,
            "fore_body_m": geometry.fore_body_m.value,
            "nacelle_m": geometry.nacelle_m.value,
        },
        "outline": {
            "lower_angle_rad": outline.lower_angle_rad.value,
            "upper_angle_rad": outline.upper_angle_rad.value,
            "elevator_station_m": outline.elevator_station_m.value,
            "elevator_height_m": outline.elevator_height_m.value,
            "elevator_area_m2_per_m": outline.elevator_area_m2_per_m.value,
        },
        "engine": { "duct_height_m": engine.duct_height_m.value },
        "tank": tanks.collect::<Vec<_>>(),
    })
}

/// Inputs, outputs and the time, as the page shows them.
fn variables(model: &ModelDescription) -> Vec<Value> {
    let time = json!({
        "name": "time", "unit": "s", "display": { "unit": "s", "factor": 1 },
    });
    let recorded = model.with(Causality::Input).chain(model.with(Causality::Output));
    let described = recorded.map(|variable| {
        let display = model.display(variable);
        json!({
            "name": variable.name,
            "unit": display.name,
            "display": { "unit": display.name, "factor": display.factor },
        })
    });
    std::iter::once(time).chain(described).collect()
}

/// Name, value and unit of what was set and of what follows from it.
fn set(
    model: &ModelDescription,
    settings: &[Setting],
    calculated: &[(&Variable, f64)],
) -> Vec<[String; 3]> {
    let given = settings.iter().map(|setting| {
        let (name, value) = setting.text.split_once('=').unwrap_or((setting.text, ""));
        [name.trim().to_string(), value.trim().to_string(), "as set".to_string()]
    });
    let follows = calculated.iter().map(|(variable, value)| {
        let display = model.display(variable);
        let shown = crate::table::number(value * display.factor + display.offset);
        [variable.name.clone(), shown, display.name]
    });
    given.chain(follows).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_flight_is_thinned_and_keeps_its_ends() {
        for count in [1, 2, MAX_ROWS - 1, MAX_ROWS, MAX_ROWS + 1, 1_000_000] {
            let rows: Vec<Vec<f64>> = (0..count).map(|row| vec![row as f64]).collect();
            let kept = thinned(&rows);
            assert!(kept.len() <= MAX_ROWS && kept.len() >= count.min(MAX_ROWS / 2), "{count}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (&rows[0], &rows[count - 1]));
            assert!(count >= MAX_ROWS || kept.len() == count);
        }
    }

    #[test]
    fn the_template_has_one_place_for_the_data() {
        assert_eq!(TEMPLATE.matches(PLACE).count(), 1);
    }
}
