//! Writes modelDescription.xml from the table of variables.

mod structure;
pub mod terminals;
mod v2;
mod v3;
mod xml;

use crate::failure::Failure;
use crate::kinds::{Kind, Unit};
use crate::log::CATEGORIES;
use crate::model::{Model, Remedy};
use crate::standard::Standard;
use crate::variable::Role;
use std::env;
use std::io::{self, Write};
use std::process::ExitCode;
pub use xml::Xml;

/// The whole file. The same sources give the same bytes: no date, no path, no host.
///
/// # Errors
/// The model has no defaults.
pub fn model_description<M: Model>(standard: Standard) -> Result<String, Failure> {
    model_description_of(&M::new()?, standard)
}

/// The same of a model with data of its own.
///
/// # Errors
/// None: writing to memory does not fail.
pub fn model_description_of<M: Model>(model: &M, standard: Standard) -> Result<String, Failure> {
    let written = match standard {
        Standard::Fmi2 => v2::written(model),
        Standard::Fmi3 => v3::written(model),
    };
    written.map_err(|error| Failure::Model { text: error.to_string(), remedy: Remedy::Reset })
}

/// The program that prints the description for the version of the standard that is its argument, 2 or 3.
pub fn main<M: Model>() -> ExitCode {
    let standard = match env::args().nth(1).as_deref() {
        Some("2") => Standard::Fmi2,
        Some("3") => Standard::Fmi3,
        _ => return failed("the version of the standard is expected, 2 or 3"),
    };
    match model_description::<M>(standard) {
        Err(error) => failed(&error.to_string()),
        Ok(xml) => match io::stdout().write_all(xml.as_bytes()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => failed(&error.to_string()),
        },
    }
}

fn failed(problem: &str) -> ExitCode {
    // If no one can be told, the code remains.
    let _ = writeln!(io::stderr(), "error: {problem}");
    ExitCode::FAILURE
}

/// The units of the table by name, in order of appearance. Units of the same name (a rate and a
/// frequency, both rad/s) are one unit in the XML; it has a display unit if any of them has.
fn units<M: Model>(others: &[Unit]) -> Vec<Unit> {
    let mut units = others.to_vec();
    for variable in M::VARIABLES {
        let Kind::Real(unit) = variable.kind else { continue };
        if !unit.is_declared() {
            continue;
        }
        match units.iter_mut().find(|known| known.name == unit.name) {
            Some(known) => {
                known.display = known.display.or(unit.display);
                if known.others.is_empty() {
                    known.others = unit.others;
                }
            }
            None => units.push(*unit),
        }
    }
    units
}

/// Both standards write units alike; FMI 3.0 lets a tool choose among several to show.
fn unit_definitions(xml: &mut Xml, units: &[Unit], standard: Standard) -> io::Result<()> {
    if units.is_empty() {
        return Ok(());
    }
    xml.parent("UnitDefinitions", &[], |xml| {
        units.iter().try_for_each(|unit| unit_definition(xml, unit, standard))
    })
}

fn unit_definition(xml: &mut Xml, unit: &Unit, standard: Standard) -> io::Result<()> {
    xml.parent("Unit", &[("name", unit.name.to_string())], |xml| {
        let exponents: Vec<_> = ["kg", "m", "s", "rad"]
            .into_iter()
            .zip(unit.base)
            .filter(|&(_, exponent)| exponent != 0)
            .map(|(base, exponent)| (base, exponent.to_string()))
            .collect();
        xml.leaf("BaseUnit", &exponents)?;
        let others = if standard == Standard::Fmi3 { unit.others } else { &[] };
        unit.display.iter().chain(others).try_for_each(|(name, factor)| {
            let attributes = [("name", name.to_string()), ("factor", factor.to_string())];
            xml.leaf("DisplayUnit", &attributes)
        })
    })
}

/// The types of the table by name, in order of appearance.
fn types<M: Model>(model: &M) -> Vec<(&'static str, Kind)> {
    let mut types: Vec<(&str, Kind)> = Vec::new();
    for variable in M::VARIABLES {
        let name = match variable.kind {
            Kind::Real(unit) => unit.quantity,
            Kind::Enumeration(name, _) => Some(name),
            Kind::Integer | Kind::Boolean => None,
        };
        if let Some(name) = name.filter(|name| types.iter().all(|(known, _)| known != name)) {
            types.push((name, variable.kind_in(model)));
        }
    }
    types
}

/// Attributes of a type of real numbers.
fn real_type(name: &str, unit: &Unit) -> Vec<(&'static str, String)> {
    let mut attributes = vec![("quantity", name.to_string()), ("unit", unit.name.to_string())];
    attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
    attributes
}

/// The items of an enumeration.
fn items(xml: &mut Xml, items: &[(&str, i32, &str)]) -> io::Result<()> {
    items.iter().try_for_each(|(name, value, description)| {
        let attributes = [
            ("name", name.to_string()),
            ("value", value.to_string()),
            ("description", description.to_string()),
        ];
        xml.leaf("Item", &attributes)
    })
}

/// Both standards write log categories and experiment alike.
fn categories_and_experiment<M: Model>(xml: &mut Xml) -> io::Result<()> {
    let about = M::ABOUT;
    xml.parent("LogCategories", &[], |xml| {
        CATEGORIES.iter().try_for_each(|category| {
            let attributes = [
                ("name", category.name().to_string_lossy().into_owned()),
                ("description", category.description(about.events).to_string()),
            ];
            xml.leaf("Category", &attributes)
        })
    })?;
    let tolerance = M::DEFAULT_TOLERANCE;
    let experiment = [
        ("startTime", "0".to_string()),
        ("stopTime", about.stop_s.to_string()),
        ("tolerance", format!("{tolerance:e}")),
        ("stepSize", about.step_s.to_string()),
    ];
    xml.leaf("DefaultExperiment", &experiment)
}

/// Causality, variability and, where the standard lets it be said, initial.
fn role<M: Model>(role: Role<M>) -> Vec<(&'static str, String)> {
    let (causality, variability, initial) = match role {
        Role::Input(_) => ("input", "continuous", None),
        Role::Output(_) | Role::OutputState(_) => ("output", "continuous", Some("calculated")),
        Role::LocalState(_) | Role::Derivative(_) => ("local", "continuous", Some("calculated")),
        Role::Parameter { .. } => ("parameter", "fixed", Some("exact")),
        Role::Calculated(_) => ("calculatedParameter", "fixed", Some("calculated")),
    };
    let mut attributes =
        vec![("causality", causality.to_string()), ("variability", variability.to_string())];
    attributes.extend(initial.map(|initial| ("initial", initial.to_string())));
    attributes
}
