//! modelDescription.xml of FMI 2.0.

use super::{
    Causality, CoSimulation, Enumeration, EnumerationType, Experiment, Item, Kind,
    ModelDescription, Real, Units, Variable, read,
};
use anyhow::Result;
use fmi_model::standard::Standard;
use serde::Deserialize;

pub fn parse(xml: &str) -> Result<ModelDescription> {
    let file: File = read(xml)?;
    let types = file.types.list.into_iter().filter_map(|kind| {
        let items = kind.enumeration?.items;
        Some(EnumerationType { name: kind.name, items })
    });
    let variables = file.variables.list.into_iter().map(|variable| Variable {
        name: variable.name,
        value_reference: variable.value_reference,
        causality: variable.causality,
        // By derivatives of inputs, which belong to the whole FMU.
        moves_within_a_step: true,
        kind: match variable.kind {
            Type::Real(real) => Kind::Real(real),
            Type::Integer => Kind::Integer,
            Type::Boolean => Kind::Boolean,
            Type::Enumeration(enumeration) => Kind::Enumeration(enumeration),
            Type::String => Kind::Other,
        },
    });
    Ok(ModelDescription {
        standard: Standard::Fmi2,
        model_name: file.model_name,
        token: file.guid,
        co_simulation: file.co_simulation,
        units: file.units,
        types: types.collect(),
        experiment: file.experiment,
        variables: variables.collect(),
    })
}

#[derive(Debug, Deserialize)]
struct File {
    #[serde(rename = "@modelName")]
    model_name: String,
    #[serde(rename = "@guid")]
    guid: String,
    #[serde(rename = "CoSimulation")]
    co_simulation: Option<CoSimulation>,
    #[serde(rename = "UnitDefinitions", default)]
    units: Units,
    #[serde(rename = "TypeDefinitions", default)]
    types: Types,
    #[serde(rename = "DefaultExperiment", default)]
    experiment: Experiment,
    #[serde(rename = "ModelVariables")]
    variables: Variables,
}

#[derive(Debug, Default, Deserialize)]
struct Types {
    #[serde(rename = "SimpleType", default)]
    list: Vec<SimpleType>,
}

#[derive(Debug, Deserialize)]
struct SimpleType {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "Enumeration")]
    enumeration: Option<Items>,
}

#[derive(Debug, Deserialize)]
struct Items {
    #[serde(rename = "Item", default)]
    items: Vec<Item>,
}

#[derive(Debug, Deserialize)]
struct Variables {
    #[serde(rename = "ScalarVariable", default)]
    list: Vec<ScalarVariable>,
}

#[derive(Debug, Deserialize)]
struct ScalarVariable {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "@valueReference")]
    value_reference: u32,
    #[serde(rename = "@causality", default)]
    causality: Causality,
    #[serde(rename = "$value")]
    kind: Type,
}

#[derive(Debug, Deserialize)]
enum Type {
    Real(Real),
    Integer,
    Boolean,
    Enumeration(Enumeration),
    String,
}
