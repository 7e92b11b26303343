//! modelDescription.xml of FMI 2.0.

use super::structure::{Unknown, derivatives, initial_unknowns, list, outputs};
use super::{
    Xml, categories_and_experiment, items, real_type, role, types, unit_definitions, units,
};
use crate::derivatives::OUTPUT_ORDER;
use crate::exchange::EVENT_INDICATORS;
use crate::identity::guid_in_package;
use crate::kinds::Kind;
use crate::model::{Model, Simulation};
use crate::standard::Standard;
use crate::table::known_rows;
use crate::variable::{Role, Variable};
use std::io;

/// The whole file.
pub fn written<M: Model>(model: &M) -> io::Result<String> {
    let about = M::ABOUT;
    let mut xml = Xml::new()?;
    let root = [
        ("fmiVersion", "2.0".to_string()),
        ("modelName", about.identifier.to_string()),
        ("guid", guid_in_package(model)),
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
        unit_definitions(xml, &units::<M>(&[]), Standard::Fmi2)?;
        type_definitions(xml, &types(model))?;
        categories_and_experiment::<M>(xml)?;
        xml.parent("ModelVariables", &[], |xml| {
            M::VARIABLES.iter().enumerate().try_for_each(|(row, variable)| {
                xml.comment(&format!("index {}", index(row)))?;
                scalar_variable(xml, row, variable, model)
            })
        })?;
        xml.parent("ModelStructure", &[], |xml| {
            unknowns(xml, "Outputs", outputs::<M>())?;
            unknowns(xml, "Derivatives", derivatives::<M>())?;
            unknowns(xml, "InitialUnknowns", initial_unknowns::<M>())
        })
    })?;
    xml.finish()
}

/// Index of a row in the ModelStructure, which counts from one.
fn index(row: usize) -> usize {
    row + 1
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

fn type_definitions(xml: &mut Xml, types: &[(&str, Kind)]) -> io::Result<()> {
    if types.is_empty() {
        return Ok(());
    }
    xml.parent("TypeDefinitions", &[], |xml| {
        types.iter().try_for_each(|&(name, kind)| {
            xml.parent("SimpleType", &[("name", name.to_string())], |xml| match kind {
                Kind::Real(unit) => xml.leaf("Real", &real_type(name, unit)),
                Kind::Enumeration(_, of) => xml.parent("Enumeration", &[], |xml| items(xml, of)),
                Kind::Integer | Kind::Boolean => Ok(()),
            })
        })
    })
}

fn scalar_variable<M: Model>(
    xml: &mut Xml,
    row: usize,
    variable: &Variable<M>,
    model: &M,
) -> io::Result<()> {
    let mut attributes = vec![
        ("name", variable.name.to_string()),
        ("valueReference", row.to_string()),
        ("description", variable.description.to_string()),
    ];
    attributes.extend(role(variable.role));
    let mut range = Vec::new();
    if let Some([min, max]) = variable.range {
        range.extend([("min", min.to_string()), ("max", max.to_string())]);
    }
    xml.parent("ScalarVariable", &attributes, |xml| {
        let start = variable.start(model);
        match variable.kind {
            Kind::Real(unit) => {
                let mut attributes = Vec::new();
                attributes.extend(unit.quantity.map(|name| ("declaredType", name.to_string())));
                attributes.extend(unit.is_declared().then(|| ("unit", unit.name.to_string())));
                attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
                attributes.extend(range);
                attributes.extend(variable.nominal.map(|value| ("nominal", value.to_string())));
                attributes.extend(start.map(|value| ("start", value.to_string())));
                if let Role::Derivative(state) = variable.role {
                    let state = index(known_rows::<M>()[state]);
                    attributes.push(("derivative", state.to_string()));
                }
                xml.leaf("Real", &attributes)
            }
            Kind::Integer => {
                range.extend(start.map(|value| ("start", value.to_string())));
                xml.leaf("Integer", &range)
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

/// A list of unknowns; the schema has no empty ones.
fn unknowns(xml: &mut Xml, name: &str, unknowns: impl Iterator<Item = Unknown>) -> io::Result<()> {
    let mut unknowns = unknowns.peekable();
    if unknowns.peek().is_none() {
        return Ok(());
    }
    xml.parent(name, &[], |xml| {
        unknowns.try_for_each(|Unknown { row, dependencies, kinds }| {
            let mut attributes = vec![
                ("index", index(row).to_string()),
                ("dependencies", list(dependencies.into_iter().map(index))),
            ];
            attributes.extend(kinds.map(|kinds| ("dependenciesKind", list(kinds))));
            xml.leaf("Unknown", &attributes)
        })
    })
}
