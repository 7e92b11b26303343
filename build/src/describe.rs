//! Writes modelDescription.xml from the table of variables.

use crate::cli::Describe;
use crate::structure::{index, model_structure};
use crate::workspace::{TEXT, read_text, root, shown, write};
use crate::xml::Xml;
use ahv::data::OWN_FILES;
use ahv::flight::{DEFAULT_TOLERANCE, Flight};
use ahv::fmi::exchange::EVENT_INDICATORS;
use ahv::fmi::log::CATEGORIES;
use ahv::variables::{self, Kind, Role, TABLE, Unit, Variable};
use anyhow::{Result, bail};
use std::io;

/// Name of the binary and of its C prefix.
pub const MODEL_IDENTIFIER: &str = "ahv";
/// Time span that the open-loop instability leaves, s.
const STOP_TIME: f64 = 2.0;
/// Half of the longest step, s, at which explicit Euler lets no flexible mode grow, whatever the
/// configuration and coefficient set: masters take it as their integrator's step. To the FMU's own
/// integrator any step is the same.
pub const STEP_SIZE: f64 = 2e-4;

pub fn run(options: &Describe) -> Result<()> {
    let default = root().join("modelDescription/modelDescription.xml");
    let file = options.file.as_ref().unwrap_or(&default);
    let expected = xml()?;
    if !options.check {
        write(file, expected)?;
        say!("{}: {} variables", shown(file), TABLE.len())?;
        return Ok(());
    }
    let found = read_text(file, TEXT)?;
    if found != expected {
        let line = found.lines().zip(expected.lines()).take_while(|(a, b)| a == b).count();
        bail!(
            "{}, line {}: not what the table of variables says; run `cargo ahv describe` and \
             commit the result\n  found:    {}\n  expected: {}",
            shown(file),
            line + 1,
            found.lines().nth(line).unwrap_or("(end of file)").trim(),
            expected.lines().nth(line).unwrap_or("(end of file)").trim(),
        );
    }
    say!("{} is up to date", shown(file))?;
    Ok(())
}

/// The whole file. The same sources give the same bytes: no date, no path, no host.
pub fn xml() -> Result<String> {
    let flight = Flight::new()?;
    let mut xml = Xml::new()?;
    let root = [
        ("fmiVersion", "2.0".to_string()),
        ("modelName", "ahv".to_string()),
        ("guid", variables::guid()),
        ("description", description()),
        ("author", "The ahv authors".to_string()),
        ("version", env!("CARGO_PKG_VERSION").to_string()),
        ("license", env!("CARGO_PKG_LICENSE").to_string()),
        ("generationTool", concat!("cargo ahv ", env!("CARGO_PKG_VERSION")).to_string()),
        ("variableNamingConvention", "flat".to_string()),
        ("numberOfEventIndicators", EVENT_INDICATORS.to_string()),
    ];
    xml.parent("fmiModelDescription", &root, |xml| {
        interfaces(xml)?;
        xml.parent("UnitDefinitions", &[], unit_definitions)?;
        xml.parent("TypeDefinitions", &[], type_definitions)?;
        xml.parent("LogCategories", &[], |xml| {
            CATEGORIES.iter().try_for_each(|category| {
                let attributes = [
                    ("name", category.name().to_string_lossy().into_owned()),
                    ("description", category.description().to_string()),
                ];
                xml.leaf("Category", &attributes)
            })
        })?;
        let experiment = [
            ("startTime", "0".to_string()),
            ("stopTime", STOP_TIME.to_string()),
            ("tolerance", format!("{DEFAULT_TOLERANCE:e}")),
            ("stepSize", STEP_SIZE.to_string()),
        ];
        xml.leaf("DefaultExperiment", &experiment)?;
        xml.parent("ModelVariables", &[], |xml| {
            TABLE.iter().enumerate().try_for_each(|(row, variable)| {
                xml.comment(&format!("index {}", index(row)))?;
                scalar_variable(xml, row, variable, &flight)
            })
        })?;
        xml.parent("ModelStructure", &[], model_structure)
    })?;
    Ok(xml.finish()?)
}

fn description() -> String {
    let whose = if OWN_FILES.is_empty() { String::new() } else { format!("; data: {OWN_FILES}") };
    format!(
        "Longitudinal flight of a flexible air-breathing hypersonic vehicle with sloshing \
         propellant{whose}"
    )
}

/// The schema wants model exchange first.
fn interfaces(xml: &mut Xml) -> io::Result<()> {
    let common = [
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    let owned = |(key, value): (&'static str, &str)| (key, value.to_string());
    let model_exchange: Vec<_> = common
        .into_iter()
        .chain([("completedIntegratorStepNotNeeded", "false")])
        .map(owned)
        .collect();
    xml.leaf("ModelExchange", &model_exchange)?;
    let attributes = [
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", "1"),
    ];
    let co_simulation: Vec<_> = common.into_iter().chain(attributes).map(owned).collect();
    xml.leaf("CoSimulation", &co_simulation)
}

/// The units of the table by name, in order of appearance. Units of the same name (a rate and a
/// frequency, both rad/s) are one unit in the XML; it has a display unit if any of them has.
fn units() -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::new();
    for variable in &TABLE {
        let Kind::Real(unit) = variable.kind else { continue };
        match units.iter_mut().find(|known| known.name == unit.name) {
            Some(known) => known.display = known.display.or(unit.display),
            None => units.push(unit),
        }
    }
    units
}

fn unit_definitions(xml: &mut Xml) -> io::Result<()> {
    for unit in units() {
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

/// Name of the physical quantity that a unit of the table measures; also the name of its type.
fn quantity(unit: Unit) -> Option<&'static str> {
    Some(match (unit.name, unit.display) {
        ("m", _) => "Length",
        ("m/s", _) => "Velocity",
        ("m/s2", _) => "Acceleration",
        ("rad", _) => "Angle",
        ("rad/s", Some(_)) => "AngularVelocity",
        ("rad/s", None) => "AngularFrequency",
        ("rad/s2", _) => "AngularAcceleration",
        ("N/m", _) => "ForcePerWidth",
        ("N", _) => "MomentPerWidth",
        ("kg/m", _) => "MassPerWidth",
        ("kg/(m.s)", _) => "MassFlowPerWidth",
        ("Pa", _) => "Pressure",
        _ => return None,
    })
}

fn type_definitions(xml: &mut Xml) -> io::Result<()> {
    let mut known = Vec::new();
    for variable in &TABLE {
        let name = match variable.kind {
            Kind::Real(unit) => quantity(unit),
            Kind::Enumeration(name, _) => Some(name),
            Kind::Boolean => None,
        };
        let Some(name) = name.filter(|name| !known.contains(name)) else { continue };
        known.push(name);
        xml.parent("SimpleType", &[("name", name.to_string())], |xml| match variable.kind {
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
fn role(role: Role) -> (&'static str, &'static str, Option<&'static str>) {
    match role {
        Role::Input(_) => ("input", "continuous", None),
        Role::Output | Role::OutputState(_) => ("output", "continuous", Some("calculated")),
        Role::LocalState(_) | Role::Derivative(_) => ("local", "continuous", Some("calculated")),
        Role::Parameter => ("parameter", "fixed", Some("exact")),
        Role::Calculated => ("calculatedParameter", "fixed", Some("calculated")),
    }
}

fn scalar_variable(
    xml: &mut Xml,
    row: usize,
    variable: &Variable,
    flight: &Flight,
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
        let start = variable.settable().then(|| variable.get(flight));
        match variable.kind {
            Kind::Real(unit) => {
                let mut attributes = Vec::new();
                attributes.extend(quantity(unit).map(|name| ("declaredType", name.to_string())));
                attributes.push(("unit", unit.name.to_string()));
                attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
                if let Some([min, max]) = variable.range {
                    attributes.extend([("min", min.to_string()), ("max", max.to_string())]);
                }
                attributes.extend(variable.nominal().map(|value| ("nominal", value.to_string())));
                attributes.extend(start.map(|value| ("start", value.to_string())));
                if let Role::Derivative(state) = variable.role {
                    let state = index(variables::known_rows()[state]);
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

#[cfg(test)]
mod tests;
