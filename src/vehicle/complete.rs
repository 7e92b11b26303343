//! The complete vehicle.

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

/// A vehicle in one configuration, per metre of width.
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
    /// Properties at the initial fuel level.
    pub airframe: Airframe,
    /// Properties at lower fuel levels, if fuel burns.
    pub fuel_table: Option<Arc<FuelTable>>,
    /// Engine intake.
    pub intake: Intake,
    /// Thermal choking of the burner.
    pub choking: Choking,
    /// Sensor stations.
    pub stations: SensorStations,
    /// Largest elevator deflection (rad) and fuel equivalence ratio.
    pub limits: Control,
}

impl Vehicle {
    /// From data and options.
    ///
    /// # Errors
    /// [`Error::SensorOffBody`]; those of [`Body::new`]; [`Error::ModesNotFollowed`] if the
    /// modes cannot be aligned while fuel burns.
    pub fn new(data: &Data, options: &VehicleOptions) -> Result<Self, Error> {
        Self::from_definition(&VehicleDefinition::new(data, options))
    }

    /// [`Vehicle::new`] from a definition, which may have any coefficient set.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn from_definition(definition: &VehicleDefinition) -> Result<Self, Error> {
        Self::with_body(definition, &Body::new(definition)?)
    }

    /// The same, with the result of [`Body::new`] already known.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn with_body(definition: &VehicleDefinition, body: &Body) -> Result<Self, Error> {
        let options = &definition.options;
        options.stations.check(definition.vehicle.geometry.length_m.value)?;
        let fuel_table = options.fuel_burn.then(|| FuelTable::new(definition, body)).transpose()?;
        Self::assembled(definition, body, fuel_table)
    }

    // Not inlined, to limit the size of the stack frame.
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

    /// Number of states in use at constant fuel: 5, 11 or 15.
    pub fn states(&self) -> usize {
        eta(self.modes)
    }
}
