//! Reads modelDescription.xml of either version of the standard.

mod fmi2;
mod fmi3;

use anyhow::{Context, Result, anyhow, bail};
use fmi_model::standard::Standard;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// What the tool needs to know of a model.
#[derive(Debug)]
pub struct ModelDescription {
    pub standard: Standard,
    pub model_name: String,
    /// `guid` or `instantiationToken`.
    pub token: String,
    pub co_simulation: Option<CoSimulation>,
    units: Units,
    types: Vec<EnumerationType>,
    pub experiment: Experiment,
    variables: Vec<Variable>,
}

#[derive(Debug, Deserialize)]
pub struct CoSimulation {
    #[serde(rename = "@modelIdentifier")]
    pub model_identifier: String,
}

#[derive(Debug, Default, Deserialize)]
pub struct Experiment {
    #[serde(rename = "@stopTime")]
    pub stop_time: Option<f64>,
    #[serde(rename = "@tolerance")]
    pub tolerance: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
struct Units {
    #[serde(rename = "Unit", default)]
    list: Vec<Unit>,
}

#[derive(Debug, Deserialize)]
struct Unit {
    #[serde(rename = "@name")]
    name: String,
    #[serde(rename = "DisplayUnit", default)]
    display: Vec<DisplayUnit>,
}

/// Displayed value = value * factor + offset.
#[derive(Debug, Clone, Deserialize)]
pub struct DisplayUnit {
    #[serde(rename = "@name")]
    pub name: String,
    #[serde(rename = "@factor", default = "one")]
    pub factor: f64,
    #[serde(rename = "@offset", default)]
    pub offset: f64,
}

fn one() -> f64 {
    1.0
}

/// A type of enumerations.
#[derive(Debug)]
struct EnumerationType {
    name: String,
    items: Vec<Item>,
}

/// One value of an enumeration.
#[derive(Debug, Deserialize)]
pub struct Item {
    #[serde(rename = "@name")]
    pub name: String,
    #[serde(rename = "@value")]
    pub value: i32,
}

/// A variable.
#[derive(Debug)]
pub struct Variable {
    pub name: String,
    pub value_reference: u32,
    pub causality: Causality,
    /// Whether the master may set or read it within a step: `intermediateUpdate`.
    pub moves_within_a_step: bool,
    pub kind: Kind,
}

#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Causality {
    Parameter,
    CalculatedParameter,
    StructuralParameter,
    Input,
    Output,
    #[default]
    Local,
    Independent,
}

/// What values a variable takes.
#[derive(Debug)]
pub enum Kind {
    Real(Real),
    Integer,
    Boolean,
    Enumeration(Enumeration),
    /// What the tool neither sets nor reads.
    Other,
}

#[derive(Debug, Deserialize)]
pub struct Real {
    #[serde(rename = "@unit")]
    pub unit: Option<String>,
    #[serde(rename = "@displayUnit")]
    display_unit: Option<String>,
    #[serde(rename = "@min")]
    pub min: Option<f64>,
    #[serde(rename = "@max")]
    pub max: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub struct Enumeration {
    #[serde(rename = "@declaredType")]
    declared_type: Option<String>,
    #[serde(rename = "@start")]
    start: Option<i32>,
}

/// Reads XML into a type.
fn read<T: DeserializeOwned>(xml: &str) -> Result<T> {
    quick_xml::de::from_str(xml).map_err(|error| {
        // The error may quote the whole file.
        let reason: String = error.to_string().chars().take(200).collect();
        anyhow!("modelDescription.xml cannot be read: {reason}")
    })
}

#[derive(Debug, Deserialize)]
struct Root {
    #[serde(rename = "@fmiVersion")]
    fmi_version: String,
}

impl ModelDescription {
    pub fn parse(xml: &str) -> Result<Self> {
        let Root { fmi_version } = read(xml)?;
        match fmi_version.split_once('.').context("fmiVersion is no version")? {
            ("2", _) => fmi2::parse(xml),
            ("3", _) => fmi3::parse(xml),
            _ => bail!("the FMU is for FMI {fmi_version}; FMI 2.0 or 3.0 is needed"),
        }
    }

    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    pub fn with(&self, causality: Causality) -> impl Iterator<Item = &Variable> {
        self.variables().iter().filter(move |variable| variable.causality == causality)
    }

    pub fn find(&self, name: &str) -> Option<&Variable> {
        self.variables().iter().find(|variable| variable.name == name)
    }

    /// The items of an enumeration; empty for other kinds.
    pub fn items(&self, variable: &Variable) -> &[Item] {
        let Kind::Enumeration(Enumeration { declared_type: Some(name), .. }) = &variable.kind
        else {
            return &[];
        };
        let known = self.types.iter().find(|known| known.name == *name);
        known.map_or(&[], |known| &known.items)
    }

    /// The display unit of a real variable, or its unit without one.
    pub fn display(&self, variable: &Variable) -> DisplayUnit {
        let plain = |name: &str| DisplayUnit { name: name.to_string(), factor: 1.0, offset: 0.0 };
        let Kind::Real(Real { unit: Some(unit), display_unit, .. }) = &variable.kind else {
            return plain("1");
        };
        let known = self.units.list.iter().find(|known| known.name == *unit);
        let Some(shown) = display_unit else { return plain(unit) };
        known
            .and_then(|known| known.display.iter().find(|display| display.name == *shown))
            .cloned()
            .unwrap_or_else(|| plain(unit))
    }
}

impl Variable {
    /// Start value of an enumeration.
    pub fn start(&self) -> Option<f64> {
        match &self.kind {
            Kind::Enumeration(enumeration) => enumeration.start.map(f64::from),
            _ => None,
        }
    }

    /// Minimum and maximum of a real variable.
    pub fn range(&self) -> [f64; 2] {
        let (min, max) = match &self.kind {
            Kind::Real(real) => (real.min, real.max),
            _ => (None, None),
        };
        [min.unwrap_or(f64::MIN), max.unwrap_or(f64::MAX)]
    }

    /// Unit of a real variable; "1" if it has none.
    pub fn unit(&self) -> &str {
        match &self.kind {
            Kind::Real(Real { unit: Some(unit), .. }) => unit,
            _ => "1",
        }
    }
}
