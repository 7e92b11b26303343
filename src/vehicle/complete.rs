//! From data and options to a vehicle that can fly.

use super::airframe::Airframe;
use super::assembly::VehicleDefinition;
use super::body::Body;
use super::fuel_table::FuelTable;
use super::options::{SensorStations, VehicleOptions};
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
    pub fuel_table: Option<Arc<FuelTable>>,
    /// What the engine swallows.
    pub intake: Intake,
    /// When its burner chokes.
    pub choking: Choking,
    /// Where the sensors sit.
    pub stations: SensorStations,
    /// Largest elevator deflection (rad) and fuel equivalence ratio.
    pub limits: Control,
}

impl Vehicle {
    /// Puts a vehicle together.
    ///
    /// # Errors
    /// [`Error::SensorOffBody`]; those of [`Body::new`]; [`Error::ModesNotFollowed`] if the
    /// modes cannot be followed while fuel burns.
    pub fn new(data: &Data, options: &VehicleOptions) -> Result<Self, Error> {
        Self::from_definition(&VehicleDefinition::new(data, options))
    }

    /// [`Vehicle::new`] with any coefficient set.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn from_definition(definition: &VehicleDefinition) -> Result<Self, Error> {
        Self::with_body(definition, &Body::new(definition)?)
    }

    /// The same around a body that is known: that of [`Body::new`].
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn with_body(definition: &VehicleDefinition, body: &Body) -> Result<Self, Error> {
        let options = &definition.options;
        options.stations.check(definition.vehicle.geometry.length_m.value)?;
        let fuel_table = options.fuel_burn.then(|| FuelTable::new(definition, body)).transpose()?;
        Self::assembled(definition, body, fuel_table)
    }

    // A frame of its own, beside that of the burning vehicle.
    #[inline(never)]
    fn assembled(
        definition: &VehicleDefinition,
        body: &Body,
        fuel_table: Option<FuelTable>,
    ) -> Result<Self, Error> {
        let VehicleDefinition { vehicle, earth, aero, options } = definition;
        Ok(Self {
            atmosphere: Atmosphere::new(earth),
            aero: Aero::new(aero),
            modes: body.modes.count,
            fuel: fuel_kg_per_m(vehicle, options.fuel_fraction),
            omega: body.modes.omega_rad_per_s,
            airframe: body.airframe(definition)?,
            fuel_table: fuel_table.map(Arc::new),
            intake: Intake::new(vehicle, earth),
            choking: Choking::new(vehicle, earth),
            stations: options.stations,
            limits: [vehicle.actuation.delta_e_limit_rad.value, vehicle.actuation.phi_limit.value],
        })
    }

    /// Number of states in motion at one fuel level: 5, 11 or 15.
    pub fn states(&self) -> usize {
        eta(self.modes)
    }
}
