//! terminalsAndIcons: groups of inputs and outputs that a tool can connect as one (FMI 2.0.4,
//! section 2.3; file format of FMI 3.0, section 2.4.9).

use super::{Files, icon};
use anyhow::Result;
use fmi_model::describe::terminals::{Side, Terminal, terminals_and_icons};

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
        description: "Rigid-body motion",
        side: Side::Output,
        variables: &["V", "gamma", "h", "alpha", "q", "theta"],
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

/// The files of the directory.
pub fn files() -> Result<Files> {
    let xml = terminals_and_icons(&TERMINALS)?.into_bytes();
    let mut files = Files::from([("terminalsAndIcons/terminalsAndIcons.xml".to_string(), xml)]);
    for (name, picture) in [("icon", "vehicle"), ("input", "input"), ("output", "output")] {
        files.insert(format!("terminalsAndIcons/{name}.png"), icon(picture)?);
    }
    Ok(files)
}
