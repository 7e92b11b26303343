//! The models that the tool describes and packages: the vehicle and the parts of its control loop.

pub mod parts;
pub mod vehicle;

use crate::documentation::Page;
use crate::fmu::Fmu;
use crate::package::Files;
use anyhow::{Result, anyhow};
use fmi_model::describe::terminals::Terminal;
use fmi_model::standard::Standard;
use parts::{ACTUATOR, AUTOPILOT, SENSOR};
pub use vehicle::VEHICLE;

/// A model, and what its package has besides libraries.
#[derive(Debug)]
pub struct PackagedModel {
    /// What users call it.
    pub name: &'static str,
    /// Name of its library and of its FMU.
    pub identifier: &'static str,
    /// Cargo's package of the library.
    pub cargo_package: &'static str,
    /// modelDescription.xml, from the table of variables.
    pub describe: fn(Standard) -> Result<String>,
    /// The model with its built-in data.
    pub content: fn() -> Result<Content>,
    /// Groups of inputs and outputs.
    pub terminals: &'static [Terminal],
    /// Picture in build/icons, without its ending.
    pub icon: &'static str,
    /// Tries a package for this machine; the files that this adds to it.
    pub trial: fn(&Fmu) -> Result<Files>,
}

/// A model with its data.
pub struct Content {
    /// modelDescription.xml of FMI 2.0 and of FMI 3.0.
    pub descriptions: [String; 2],
    pub page: Page,
    /// Files of the folder `resources`, by name.
    pub resources: Files,
}

impl Content {
    pub fn xml(&self, standard: Standard) -> &str {
        let [fmi2, fmi3] = &self.descriptions;
        match standard {
            Standard::Fmi2 => fmi2,
            Standard::Fmi3 => fmi3,
        }
    }
}

/// All models; the vehicle is the first.
pub const MODELS: [&PackagedModel; 4] = [&VEHICLE, &AUTOPILOT, &ACTUATOR, &SENSOR];

/// The model that users call by a name.
pub fn named(name: &str) -> Result<&'static PackagedModel> {
    MODELS.into_iter().find(|model| model.name == name).ok_or_else(|| {
        let names = MODELS.map(|model| model.name);
        anyhow!("there is no model `{name}`; choose one of {}", names.join(", "))
    })
}
