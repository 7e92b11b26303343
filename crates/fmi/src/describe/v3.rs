//! modelDescription.xml of FMI 3.0.

use super::structure::{Unknown, derivatives, initial_unknowns, list, outputs};
use super::{
    Xml, categories_and_experiment, items, real_type, role, types, unit_definitions, units,
};
use crate::derivatives::OUTPUT_ORDER;
use crate::identity::guid_in_package;
use crate::kinds::{Kind, Unit};
use crate::model::{Model, Simulation};
use crate::standard::Standard;
use crate::table::known_rows;
use crate::values::TIME;
use crate::variable::{Role, Variable};
use std::io;

/// The whole file.
pub fn written<M: Model>(model: &M) -> io::Result<String> {
    let about = M::ABOUT;
    let mut xml = Xml::new()?;
    let root = [
        ("fmiVersion", "3.0".to_string()),
        ("modelName", about.identifier.to_string()),
        ("instantiationToken", guid_in_package(model)),
        ("description", model.description()),
        ("author", about.author.to_string()),
        ("version", about.version.to_string()),
        ("license", about.license.to_string()),
        ("generationTool", about.tool.to_string()),
        ("variableNamingConvention", "flat".to_string()),
    ];
    xml.parent("fmiModelDescription", &root, |xml| {
        interfaces::<M>(xml)?;
        unit_definitions(xml, &units::<M>(&[*Unit::SECOND]), Standard::Fmi3)?;
        type_definitions(xml, &types(model))?;
        categories_and_experiment::<M>(xml)?;
        xml.parent("ModelVariables", &[], |xml| {
            xml.leaf("Float64", &time())?;
            M::VARIABLES
                .iter()
                .enumerate()
                .try_for_each(|(row, variable)| write_variable(xml, row, variable, model))
        })?;
        xml.parent("ModelStructure", &[], |xml| {
            unknowns(xml, "Output", outputs::<M>())?;
            unknowns(xml, "ContinuousStateDerivative", derivatives::<M>())?;
            unknowns(xml, "InitialUnknown", initial_unknowns::<M>())
        })
    })?;
    xml.finish()
}

/// The schema wants model exchange first.
fn interfaces<M: Model>(xml: &mut Xml) -> io::Result<()> {
    let saves = M::Simulation::SAVING.is_some();
    let tangent = M::Simulation::TANGENT.is_some();
    let looks_in = M::Simulation::INTERNAL_STEP.is_some();
    let flag = |value: bool| value.to_string();
    let common = [
        ("modelIdentifier", M::ABOUT.identifier.to_string()),
        ("canGetAndSetFMUState", flag(saves)),
        ("canSerializeFMUState", flag(saves)),
        ("providesDirectionalDerivatives", flag(tangent)),
        ("providesAdjointDerivatives", flag(tangent)),
    ];
    if M::Simulation::EXCHANGE.is_some() {
        let needed = [("needsCompletedIntegratorStep", flag(true))];
        xml.leaf("ModelExchange", &[&common[..], &needed].concat())?;
    }
    let output_order = if tangent { OUTPUT_ORDER } else { 0 };
    let only = [
        ("canHandleVariableCommunicationStepSize", flag(true)),
        ("maxOutputDerivativeOrder", output_order.to_string()),
        ("providesIntermediateUpdate", flag(looks_in)),
        // At the instant at which the simulation ends.
        ("mightReturnEarlyFromDoStep", flag(true)),
        ("canReturnEarlyAfterIntermediateUpdate", flag(looks_in)),
        ("hasEventMode", flag(false)),
    ];
    xml.leaf("CoSimulation", &[&common[..], &only].concat())
}

fn type_definitions(xml: &mut Xml, types: &[(&str, Kind)]) -> io::Result<()> {
    if types.is_empty() {
        return Ok(());
    }
    xml.parent("TypeDefinitions", &[], |xml| {
        types.iter().try_for_each(|&(name, kind)| {
            let named = [("name", name.to_string())];
            match kind {
                Kind::Real(unit) => {
                    xml.leaf("Float64Type", &[&named[..], &real_type(name, unit)].concat())
                }
                Kind::Enumeration(_, of) => {
                    xml.parent("EnumerationType", &named, |xml| items(xml, of))
                }
                Kind::Integer | Kind::Boolean => Ok(()),
            }
        })
    })
}

/// The independent variable.
fn time() -> [(&'static str, String); 6] {
    [
        ("name", "time".to_string()),
        ("valueReference", TIME.to_string()),
        ("description", "Simulation time".to_string()),
        ("causality", "independent".to_string()),
        ("variability", "continuous".to_string()),
        ("unit", Unit::SECOND.name.to_string()),
    ]
}

fn write_variable<M: Model>(
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
    let exchanged =
        matches!(variable.role, Role::Input(_) | Role::Output(_) | Role::OutputState(_));
    if exchanged && M::Simulation::INTERNAL_STEP.is_some() {
        attributes.push(("intermediateUpdate", true.to_string()));
    }
    let start = variable.start(model);
    let start_of = |text: fn(f64) -> String| start.map(|value| ("start", text(value)));
    let element = match variable.kind {
        Kind::Real(unit) => {
            attributes.extend(unit.quantity.map(|name| ("declaredType", name.to_string())));
            attributes.extend(unit.is_declared().then(|| ("unit", unit.name.to_string())));
            attributes.extend(unit.display.map(|(name, _)| ("displayUnit", name.to_string())));
            attributes.extend(range(variable));
            attributes.extend(variable.nominal.map(|value| ("nominal", value.to_string())));
            attributes.extend(start_of(|value| value.to_string()));
            if let Role::Derivative(state) = variable.role {
                attributes.push(("derivative", known_rows::<M>()[state].to_string()));
            }
            "Float64"
        }
        Kind::Integer => {
            attributes.extend(range(variable));
            attributes.extend(start_of(|value| value.to_string()));
            "Int32"
        }
        Kind::Boolean => {
            attributes.extend(start_of(|value| (value != 0.0).to_string()));
            "Boolean"
        }
        Kind::Enumeration(name, _) => {
            attributes.push(("declaredType", name.to_string()));
            attributes.extend(start_of(|value| value.to_string()));
            "Enumeration"
        }
    };
    xml.leaf(element, &attributes)
}

fn range<M: Model>(variable: &Variable<M>) -> impl Iterator<Item = (&'static str, String)> {
    let range =
        variable.range.map(|[min, max]| [("min", min.to_string()), ("max", max.to_string())]);
    range.into_iter().flatten()
}

fn unknowns(
    xml: &mut Xml,
    name: &str,
    mut unknowns: impl Iterator<Item = Unknown>,
) -> io::Result<()> {
    unknowns.try_for_each(|Unknown { row, dependencies, kinds }| {
        let mut attributes =
            vec![("valueReference", row.to_string()), ("dependencies", list(dependencies))];
        attributes.extend(kinds.map(|kinds| ("dependenciesKind", list(kinds))));
        xml.leaf(name, &attributes)
    })
}
