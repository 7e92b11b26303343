//! The parts of a control loop around the vehicle, each a crate of its own.

use super::{Content, PackagedModel};
use crate::describe::{by_program, committed};
use crate::documentation::{Page, html_of};
use crate::package::{Files, trial_step};
use crate::workspace::{MAX_DATA_BYTES, MAX_TEXT_BYTES, read, read_text, root};
use anyhow::Result;
use fmi_model::describe::terminals::{Side, Terminal};
use fmi_model::standard::Standard;

/// A part: its name is also that of its picture and of its folder in `crates`.
macro_rules! part {
    ($part:ident: $name:literal, $terminals:expr, $resources:expr) => {
        pub const $part: PackagedModel = PackagedModel {
            name: $name,
            identifier: concat!("ahv_", $name),
            cargo_package: concat!("ahv-", $name),
            describe: |standard| by_program($name, standard),
            content: || content(&$part, $resources),
            terminals: $terminals,
            icon: $name,
            trial: trial_step,
        };
    };
}

part!(AUTOPILOT: "autopilot", &AUTOPILOT_TERMINALS, &["law.json"]);
part!(ACTUATOR: "actuator", &[], &[]);
part!(SENSOR: "sensor", &[], &[]);

/// The vehicle has terminals of the same names and variables on its other side.
const AUTOPILOT_TERMINALS: [Terminal; 4] = [
    Terminal {
        name: "motion",
        description: "Measured motion, and the fuel that is left",
        side: Side::Input,
        variables: &["V", "gamma", "q", "fuel_mass"],
    },
    Terminal {
        name: "wanted",
        description: "Wanted change of speed and flight-path angle",
        side: Side::Input,
        variables: &["V_change", "gamma_wanted"],
    },
    Terminal {
        name: "controls",
        description: "Commands of an autopilot",
        side: Side::Output,
        variables: &["delta_e", "phi"],
    },
    Terminal {
        name: "health",
        description: "Counts of measurements that were not believed and of saturated commands",
        side: Side::Output,
        variables: &["missed", "saturated"],
    },
];

/// What is committed: description, the crate's README.md as page, resources.
fn content(part: &PackagedModel, resources: &[&str]) -> Result<Content> {
    let [fmi2, fmi3] = Standard::ALL.map(|standard| committed(part, standard));
    let folder = root().join("crates").join(part.name);
    let readme = read_text(&folder.join("README.md"), MAX_TEXT_BYTES)?;
    // Below its title.
    let (_, readme) = readme.split_once('\n').unwrap_or_default();
    let page = Page {
        about: None,
        summary: "<p><img src=\"../terminalsAndIcons/icon.png\" alt=\"\" width=\"200\"/></p>"
            .into(),
        sections: html_of(readme),
        closing: String::new(),
    };
    let resource = |name: &&str| Ok((name.to_string(), read(&folder.join(name), MAX_DATA_BYTES)?));
    let resources = resources.iter().map(resource).collect::<Result<Files>>()?;
    Ok(Content { descriptions: [fmi2?, fmi3?], page, resources })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::VEHICLE;

    #[test]
    fn terminals_of_the_autopilot_connect_to_those_of_the_vehicle() {
        let mut connected = Vec::new();
        for own in AUTOPILOT_TERMINALS {
            let same = VEHICLE.terminals.iter().find(|terminal| terminal.name == own.name);
            if let Some(vehicle) = same {
                assert_ne!(own.side, vehicle.side, "{}", own.name);
                assert!(own.variables.iter().all(|name| vehicle.variables.contains(name)));
                connected.push(own.name);
            }
        }
        assert_eq!(connected, ["motion", "controls"]);
    }
}
