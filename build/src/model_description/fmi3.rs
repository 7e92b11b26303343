//! modelDescription.xml of FMI 3.0.

use super::{
    Causality, CoSimulation, Enumeration, EnumerationType, Experiment, Item, Kind,
    ModelDescription, Real, Units, Variable, read,
};
use anyhow::Result;
use fmi_model::standard::Standard;
use serde::Deserialize;

pub fn parse(xml: &str) -> Result<ModelDescription> {
    let file: File = read(xml)?;
    let types = file.types.list.into_iter().filter_map(|kind| match kind {
        Type::EnumerationType(Items { name, items }) => Some(EnumerationType { name, items }),
        Type::Other => None,
    });
    let variables = file.variables.list.into_iter().filter_map(|element| {
        let (attributes, kind): (_, fn(Rest) -> Kind) = match element {
            Element::Float64(attributes) => (attributes, Rest::real),
            Element::Enumeration(attributes) => (attributes, Rest::enumeration),
            Element::Int32(attributes) => (attributes, |_| Kind::Integer),
            Element::Boolean(attributes) => (attributes, |_| Kind::Boolean),
            // Types that the tool does not know.
            Element::Other => return None,
        };
        Some(attributes.variable(kind))
    });
    Ok(ModelDescription {
        standard: Standard::Fmi3,
        model_name: file.model_name,
        token: file.token,
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
    #[serde(rename = "@instantiationToken")]
    token: String,
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
    #[serde(rename = "$value", default)]
    list: Vec<Type>,
}

#[derive(Debug, Deserialize)]
enum Type {
    EnumerationType(Items),
    #[serde(other)]
    Other,
}

#[derive(Debug, Deserialize)]
struct Items {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "Item", default)]
    items: Vec<Item>,
}

#[derive(Debug, Deserialize)]
struct Variables {
    #[serde(rename = "$value", default)]
    list: Vec<Element>,
}

#[derive(Debug, Deserialize)]
enum Element {
    Float64(Attributes),
    Int32(Attributes),
    Boolean(Attributes),
    Enumeration(Attributes),
    #[serde(other)]
    Other,
}

/// Attributes of a variable of any type.
#[derive(Debug, Deserialize)]
struct Attributes {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "@valueReference")]
    value_reference: u32,
    #[serde(rename = "@causality", default)]
    causality: Causality,
    #[serde(rename = "@intermediateUpdate", default)]
    intermediate_update: bool,
    #[serde(rename = "@unit")]
    unit: Option<String>,
    #[serde(rename = "@displayUnit")]
    display_unit: Option<String>,
    #[serde(rename = "@declaredType")]
    declared_type: Option<String>,
    #[serde(rename = "@min")]
    min: Option<f64>,
    #[serde(rename = "@max")]
    max: Option<f64>,
    #[serde(rename = "@start")]
    start: Option<String>,
}

/// What belongs to some types only.
struct Rest {
    real: Real,
    enumeration: Enumeration,
}

impl Rest {
    fn real(self) -> Kind {
        Kind::Real(self.real)
    }

    fn enumeration(self) -> Kind {
        Kind::Enumeration(self.enumeration)
    }
}

impl Attributes {
    fn variable(self, kind: fn(Rest) -> Kind) -> Variable {
        let Self { unit, display_unit, declared_type, min, max, start, .. } = self;
        let start = start.and_then(|start| start.parse().ok());
        Variable {
            name: self.name,
            value_reference: self.value_reference,
            causality: self.causality,
            moves_within_a_step: self.intermediate_update,
            kind: kind(Rest {
                real: Real { unit, display_unit, min, max },
                enumeration: Enumeration { declared_type, start },
            }),
        }
    }
}
