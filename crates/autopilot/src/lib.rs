//! An autopilot for speed and flight-path angle of the hypersonic vehicle `ahv`: a Kalman filter in predictor
//! form, state feedback and two integrators, sampled, with gains scheduled over fuel.
//!
//! | module | its job |
//! |---|---|
//! | [`law`], [`written`], [`gains`] | the designs, the file that holds them, the matrices made from them |
//! | [`commands`] | the manoeuvre that the parameters hold |
//! | [`pilot`] | what is remembered, and one sample |
//! | [`running`] | sampling in time, inputs and outputs: the FMU's simulation |
//! | [`saved`] | the running autopilot as plain numbers |
//! | [`table`] | the variables |
//! | [`error`] | what is refused |

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

pub mod commands;
pub mod error;
pub mod gains;
pub mod law;
pub mod pilot;
pub mod running;
pub mod saved;
pub mod table;
pub mod written;

use commands::{BREAKPOINTS, Breakpoint, Commands};
use error::Error;
use fmi_model::identity::fnv;
use fmi_model::{About, Model, Resources, Variable};
use law::{BUILT_IN, COMMANDS, Design, Law};
use pilot::Pilot;
use running::Running;
use std::path::Path;
use std::sync::Arc;

/// The law, and the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Autopilot {
    law: Arc<Law>,
    /// Sampling period, s; 0: that of the law.
    pub period_s: f64,
    /// Fuel that the gains are for until a mass is measured.
    pub fuel_fraction: f64,
    /// Speed in level flight, m/s; 0: that of the law.
    pub level_speed_m_per_s: f64,
    /// Commands in level flight, which the limits are counted from; 0: those of the law.
    pub trim: [f64; COMMANDS],
    /// The manoeuvre.
    pub breakpoints: [Breakpoint; BREAKPOINTS],
}

impl Autopilot {
    /// With this law and default parameters.
    pub fn with(law: Law) -> Self {
        Self {
            law: Arc::new(law),
            period_s: 0.0,
            fuel_fraction: 1.0,
            level_speed_m_per_s: 0.0,
            trim: [0.0; COMMANDS],
            breakpoints: [Breakpoint::LEVEL; BREAKPOINTS],
        }
    }

    /// Trim and limits, as far as the parameters or else the design say.
    fn limits(&self, design: &Design) -> Result<[[f64; COMMANDS]; 2], Error> {
        let mut limits = [design.lowest, design.highest];
        for (i, variable) in ["delta_e_trim", "phi_trim"].into_iter().enumerate() {
            let value = if self.trim[i] == 0.0 { design.trim[i] } else { self.trim[i] };
            let [low, high] = limits.map(|limit| limit[i]);
            if !(low..=high).contains(&value) {
                return Err(Error::Trim { variable, value, low, high });
            }
            limits.iter_mut().for_each(|limit| limit[i] -= value);
        }
        Ok(limits)
    }
}

impl Model for Autopilot {
    type Simulation = Running;
    type Error = Error;

    const ABOUT: About = About {
        description: "Autopilot for speed and flight-path angle of the hypersonic vehicle ahv",
        author: "The ahv authors",
        license: env!("CARGO_PKG_LICENSE"),
        tool: concat!("cargo ahv ", env!("CARGO_PKG_VERSION")),
        events: "The law in use, the first measurement that is not believed",
        stop_s: 10.0,
        step_s: 0.01,
        ..About::new("ahv_autopilot", env!("CARGO_PKG_VERSION"))
    };
    const VARIABLES: &'static [Variable<Self>] = &table::TABLE;
    const RESOURCES: Resources<Self> =
        Resources::Replaceable(|folder: &Path| Ok(Self::with(Law::in_folder(folder)?)));

    fn new() -> Result<Self, Error> {
        Ok(Self::with(Law::parse(BUILT_IN)?))
    }

    fn identity(&self) -> u128 {
        fnv(Self::IDENTITY, &self.law.hash.to_le_bytes())
    }

    fn start(&self, time_s: f64, _tolerance: f64) -> Result<Running, Error> {
        let designs = self.law.designs(self.period_s)?;
        let design = Design::at(designs, self.fuel_fraction);
        let limits = self.limits(&design)?;
        let mut level = design.level;
        if self.level_speed_m_per_s != 0.0 {
            level[0] = self.level_speed_m_per_s;
        }
        let period_s = design.period_s;
        let pilot = Pilot::new(designs, design, level, limits);
        Ok(Running::new(pilot, Commands::new(&self.breakpoints)?, period_s, time_s))
    }

    fn started(&self, _default: &Self, running: &Running, say: &mut dyn FnMut(String)) {
        let Ok(designs) = self.law.designs(self.period_s) else { return };
        let (first, last) = (&designs[0], &designs[designs.len() - 1]);
        say(format!(
            "law sampled every {} s, {} designs for fuel fractions from {} to {}",
            running.period_s(),
            designs.len(),
            first.fuel_fraction,
            last.fuel_fraction
        ));
        if !(first.fuel_fraction..=last.fuel_fraction).contains(&self.fuel_fraction) {
            say(format!(
                "fuel_fraction = {} is outside: the gains are those of the nearest design",
                self.fuel_fraction
            ));
        }
    }
}

fmi_model::export!(Autopilot);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_autopilots_share_their_designs() {
        let autopilot = Autopilot::new().unwrap();
        let _running = [0.0, 0.5].map(|fuel_fraction| {
            Autopilot { fuel_fraction, ..autopilot.clone() }.start(0.0, 1e-6).unwrap()
        });
        assert_eq!(Arc::strong_count(autopilot.law.designs(0.0).unwrap()), 3);
    }
}
