//! Writes modelDescription.xml from the table of variables.

mod structure;
pub mod terminals;
mod xml;

use crate::derivatives::OUTPUT_ORDER;
use crate::exchange::EVENT_INDICATORS;
use crate::failure::Failure;
use crate::identity::guid_of;
use crate::kinds::{Kind, Unit};
use crate::log::CATEGORIES;
use crate::model::{Model, Remedy, Simulation};
use crate::table::known_rows;
use crate::variable::{Role, Variable};
use std::io;
use structure::{index, model_structure};
pub use xml::Xml;

/// The whole file. The same sources give the same bytes: no date, no path, no host.
///
/// # Errors
/// The model has no defaults.
pub fn model_description<M: Model>() -> Result<String, Failure> {
    model_description_of(&M::new()?)
}

/// The same of a model with data of its own.
///
/// # Errors
/// None: writing to memory does not fail.
pub fn model_description_of<M: Model>(model: &M) -> Result<String, Failure> {
    written(model)
        .map_err(|error| Failure::Model { text: error.to_string(), remedy: Remedy::Reset })
}

fn written<M: Model>(model: &M) -> io::Result<String> {
    let about = M::ABOUT;
    let mut xml = Xml::new()?;
    let root = [
        ("fmiVersion", "2.0".to_string()),
        ("modelName", about.identifier.to_string()),
        ("guid", guid_of(model.identity())),
        ("description", model.description()),
        ("author", about.author.to_string()),
        ("version", about.version.to_string()),
        ("license", about.license.to_string()),
        ("generationTool", about.tool.to_string()),
        ("variableNamingConvention", "flat".to_string()),
        ("numberOfEventIndicators", EVENT_INDICATORS.to_string()),
    ];
    xml.parent("fmiModelDescription", &root, |xml| {
        interfaces::<M>(xml)?;
        let units = units::<M>();
        if !units.is_empty() {
            xml.parent("UnitDefinitions", &[], |xml| unit_definitions(xml, &units))?;
        }
        let types = types(model);
        if !types.is_empty() {
            xml.parent("TypeDefinitions", &[], |xml| type_definitions(xml, &types))?;
        }
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
        xml.leaf("DefaultExperiment", &experiment)?;
        xml.parent("ModelVariables", &[], |xml| {
            M::VARIABLES.iter().enumerate().try_for_each(|(row, variable)| {
                xml.comment(&format!("index {}", index(row)))?;
                scalar_variable(xml, row, variable, model)
            })
        })?;
        xml.parent("ModelStructure", &[], model_structure::<M>)
    })?;
    xml.finish()
}

/// The schema wants model exchange first.
fn interfaces<M: Model>(xml: &mut Xml) -> io::Result<()> {
    let saves = M::Simulation::SAVING.is_some();
    let tangent = M::Simulation::TANGENT.is_some();
    let flag = |value: bool| value.to_string();
    let common = [
        ("modelIdentifier", M::ABOUT.identifier.to_string()),
        ("canBeInstantiatedOnlyOncePerProcess", flag(false)),
        ("canNotUseMemoryManagementFunctions", flag(true)),
        ("canGetAndSetFMUstate", flag(saves)),
        ("canSerializeFMUstate", flag(saves)),
        ("providesDirectionalDerivative", flag(tangent)),
    ];
    if M::Simulation::EXCHANGE.is_some() {
        let needed = [("completedIntegratorStepNotNeeded", flag(false))];
        xml.leaf("ModelExchange", &[&common[..], &needed].concat())?;
    }
    let output_order = if tangent { OUTPUT_ORDER } else { 0 };
    let only = [
        ("canHandleVariableCommunicationStepSize", flag(true)),
        ("canInterpolateInputs", flag(M::Simulation::INPUT_DERIVATIVES.is_some())),
        ("maxOutputDerivativeOrder", output_order.to_string()),
    ];
    xml.leaf("CoSimulation", &[&common[..], &only].concat())
}

/// The units of the table by name, in order of appearance. Units of the same name (a rate and a
/// frequency, both rad/s) are one unit in the XML; it has a display unit if any of them has.
fn units<M: Model>() -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::new();
    for variable in M::VARIABLES {
        let Kind::Real(unit) = variable.kind else { continue };
        match units.iter_mut().find(|known| known.name == unit.name) {
            Some(known) => known.display = known.display.or(unit.display),
            None => units.push(*unit),
        }
    }
    units
}

fn unit_definitions(xml: &mut Xml, units: &[Unit]) -> io::Result<()> {
    for unit in units {
        xml.parent("Unit", &[("name", unit.name.to_string())], |xml| {
            let exponents: Vec<_> = ["kg", "m", "s", "rad"]
                .into_iter()
                .zip(unit.base)
                .filter(|&(_, exponent)| exponent != 0)
                .map(|(base, exponent)| (base, exponent.to_string()))
                .collect();
            xml.leaf("BaseUnit", &exponents)?;
            if let Some((name, factor)) = unit.display {
                let attributes = [("name", name.to_string()), ("factor", factor.to_string())];
                xml.leaf("DisplayUnit", &attributes)?;
            }
            Ok(())
        })?;
    }
    Ok(())
}

/// The types of the table by name, in order of appearance.
fn types<M: Model>(model: &M) -> Vec<(&'static str, Kind)> {
    let mut types: Vec<(&str, Kind)> = Vec::new();
    for variable in M::VARIABLES {
        let name = match variable.kind {
            Kind::Real(unit) => unit.quantity,
            Kind::Enumeration(name, _) => Some(name),
            Kind::Boolean => None,
        };
        if let Some(name) = name.filter(|name| types.iter().all(|(known, _)| known != name)) {
            types.push((name, variable.kind_in(model)));
        }
    }
    types
}

fn type_definitions(xml: &mut Xml, types: &[(&str, Kind)]) -> io::Result<()> {
    for &(name, kind) in types {
        xml.parent("SimpleType", &[("name", name.to_string())], |xml| match kind {
            Kind::Real(unit) => {
                let mut attributes =
                    vec![("quantity", name.to_string()), ("unit", unit.name.to_string())];
                attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
                xml.leaf("Real", &attributes)
            }
            Kind::Enumeration(_, items) => xml.parent("Enumeration", &[], |xml| {
                items.iter().try_for_each(|(name, value, description)| {
                    let attributes = [
                        ("name", name.to_string()),
                        ("value", value.to_string()),
                        ("description", description.to_string()),
                    ];
                    xml.leaf("Item", &attributes)
                })
            }),
            Kind::Boolean => Ok(()),
        })?;
    }
    Ok(())
}

/// Causality, variability and, where the standard lets it be said, initial.
fn role<M: Model>(role: Role<M>) -> (&'static str, &'static str, Option<&'static str>) {
    match role {
        Role::Input(_) => ("input", "continuous", None),
        Role::Output(_) | Role::OutputState(_) => ("output", "continuous", Some("calculated")),
        Role::LocalState(_) | Role::Derivative(_) => ("local", "continuous", Some("calculated")),
        Role::Parameter { .. } => ("parameter", "fixed", Some("exact")),
        Role::Calculated(_) => ("calculatedParameter", "fixed", Some("calculated")),
    }
}

fn scalar_variable<M: Model>(
    xml: &mut Xml,
    row: usize,
    variable: &Variable<M>,
    model: &M,
) -> io::Result<()> {
    let (causality, variability, initial) = role(variable.role);
    let mut attributes = vec![
        ("name", variable.name.to_string()),
        ("valueReference", row.to_string()),
        ("description", variable.description.to_string()),
        ("causality", causality.to_string()),
        ("variability", variability.to_string()),
    ];
    attributes.extend(initial.map(|initial| ("initial", initial.to_string())));
    xml.parent("ScalarVariable", &attributes, |xml| {
        let start = variable.start(model);
        match variable.kind {
            Kind::Real(unit) => {
                let mut attributes = Vec::new();
                attributes.extend(unit.quantity.map(|name| ("declaredType", name.to_string())));
                attributes.push(("unit", unit.name.to_string()));
                attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
                if let Some([min, max]) = variable.range {
                    attributes.extend([("min", min.to_string()), ("max", max.to_string())]);
                }
                attributes.extend(variable.nominal.map(|value| ("nominal", value.to_string())));
                attributes.extend(start.map(|value| ("start", value.to_string())));
                if let Role::Derivative(state) = variable.role {
                    let state = index(known_rows::<M>()[state]);
                    attributes.push(("derivative", state.to_string()));
                }
                xml.leaf("Real", &attributes)
            }
            Kind::Boolean => {
                let start = start.map(|value| ("start", (value != 0.0).to_string()));
                xml.leaf("Boolean", start.as_slice())
            }
            Kind::Enumeration(name, _) => {
                let mut attributes = vec![("declaredType", name.to_string())];
                attributes.extend(start.map(|value| ("start", value.to_string())));
                xml.leaf("Enumeration", &attributes)
            }
        }
    })
}
