//! From data and options to a vehicle that can fly.

use super::airframe::Airframe;
use super::assembly::Chosen;
use super::body::Body;
use super::fuel_table::Burn;
use super::options::{Build, Stations};
use super::state::{Control, eta};
use crate::air::curve_fits::Aero;
use crate::air::{Atmosphere, Choking, Intake};
use crate::data::Data;
use crate::error::Error;
use crate::structure::MODES;
use crate::structure::tanks::fuel_kg_per_m;
use std::sync::Arc;

/// The vehicle in one configuration, ready to fly. Per metre of width.
#[derive(Debug, Clone)]
pub struct Vehicle {
    /// Air and gravity.
    pub atmosphere: Atmosphere,
    /// Curve fits of the rigid body.
    pub aero: Aero,
    /// Number of modes in use: 0, 3 or 5.
    pub modes: usize,
    /// Fuel at the start, kg/m.
    pub fuel: f64,
    /// Frequencies at the start, rad/s.
    pub omega: [f64; MODES],
    /// What the fuel level decides, at the start.
    pub airframe: Airframe,
    /// The same at every level below, if fuel burns.
    pub burn: Option<Arc<Burn>>,
    /// What the engine swallows.
    pub intake: Intake,
    /// When its burner chokes.
    pub choking: Choking,
    /// Where the sensors sit.
    pub stations: Stations,
    /// Largest elevator deflection (rad) and fuel equivalence ratio.
    pub limits: Control,
}

impl Vehicle {
    /// Puts a vehicle together.
    ///
    /// # Errors
    /// [`Error::Value`] if a sensor is off the body; those of [`Body::new`]; [`Error::Value`] if the
    /// modes cannot be followed while fuel burns.
    pub fn new(data: &Data, build: &Build) -> Result<Self, Error> {
        Self::chosen(&Chosen::new(data, build))
    }

    /// [`Vehicle::new`] with any coefficient set.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn chosen(chosen: &Chosen) -> Result<Self, Error> {
        Self::with_body(chosen, &Body::new(chosen)?)
    }

    /// The same around a body that is known: that of [`Body::new`].
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn with_body(chosen: &Chosen, body: &Body) -> Result<Self, Error> {
        let build = &chosen.build;
        build.stations.check(chosen.vehicle.geometry.length_m.value)?;
        let burn = build.fuel_burn.then(|| Burn::new(chosen, body)).transpose()?;
        Self::assembled(chosen, body, burn)
    }

    // A frame of its own, beside that of the burning vehicle.
    #[inline(never)]
    fn assembled(chosen: &Chosen, body: &Body, burn: Option<Burn>) -> Result<Self, Error> {
        let Chosen { vehicle, earth, aero, build } = chosen;
        Ok(Self {
            atmosphere: Atmosphere::new(earth),
            aero: Aero::new(aero),
            modes: body.modes.count,
            fuel: fuel_kg_per_m(vehicle, build.fuel_fraction),
            omega: body.modes.omega_rad_per_s,
            airframe: body.airframe(chosen)?,
            burn: burn.map(Arc::new),
            intake: Intake::new(vehicle, earth),
            choking: Choking::new(vehicle, earth),
            stations: build.stations,
            limits: [vehicle.actuation.delta_e_limit_rad.value, vehicle.actuation.phi_limit.value],
        })
    }

    /// Number of states in motion at one fuel level: 5, 11 or 15.
    pub fn states(&self) -> usize {
        eta(self.modes)
    }
}
