//! The vehicle, with its own data or the built-in ones.

mod page;

use super::{Content, PackagedModel};
use crate::own_vehicle;
use crate::package::{Files, reference_flight};
use ahv::data::OwnFiles;
use ahv::flight::Setup;
use anyhow::Result;
use fmi_model::Model;
use fmi_model::describe::model_description_of;
use fmi_model::describe::terminals::{Side, Terminal};
use fmi_model::standard::Standard;

pub const VEHICLE: PackagedModel = PackagedModel {
    name: "vehicle",
    identifier: Setup::ABOUT.identifier,
    cargo_package: "ahv-fmu",
    describe: |standard| Ok(model_description_of(&Setup::new()?, standard)?),
    content: || content(&OwnFiles::default()),
    terminals: &TERMINALS,
    icon: "vehicle",
    trial: reference_flight,
};

const TERMINALS: [Terminal; 6] = [
    Terminal {
        name: "controls",
        description: "Commands of an autopilot",
        side: Side::Input,
        variables: &["delta_e", "phi"],
    },
    Terminal {
        name: "air",
        description: "Velocity of the air",
        side: Side::Input,
        variables: &["w_gust", "u_gust"],
    },
    Terminal {
        name: "motion",
        description: "Rigid-body motion, and the fuel that is left",
        side: Side::Output,
        variables: &["V", "gamma", "h", "alpha", "q", "theta", "fuel_mass"],
    },
    Terminal {
        name: "structure",
        description: "Bending of the fuselage and sloshing of the propellant",
        side: Side::Output,
        variables: &["eta1", "eta2", "eta3", "slosh1", "slosh2"],
    },
    Terminal {
        name: "loads",
        description: "Forces, moment, Mach number, dynamic pressure and load factor",
        side: Side::Output,
        variables: &["lift", "drag", "thrust", "moment", "mach", "qbar", "n_z", "choking_margin"],
    },
    Terminal {
        name: "sensors",
        description: "Inertial measurement unit and incidence vane on the bent body",
        side: Side::Output,
        variables: &["theta_imu", "q_imu", "gamma_imu", "n_z_imu", "n_x_imu", "alpha_probe"],
    },
];

/// The vehicle with these files of the user.
pub fn content(own: &OwnFiles) -> Result<Content> {
    let setup = own_vehicle::setup(own)?;
    let page = page::page(&setup)?;
    let resources: Files =
        [(OwnFiles::VEHICLE, &own.vehicle), (OwnFiles::COEFFICIENTS, &own.coefficients)]
            .into_iter()
            .filter_map(|(name, file)| {
                Some((name.to_string(), file.as_ref()?.text.clone().into_bytes()))
            })
            .collect();
    let [fmi2, fmi3] = Standard::ALL.map(|standard| model_description_of(&setup, standard));
    Ok(Content { descriptions: [fmi2?, fmi3?], page, resources })
}
