//! Outer shape and engine of the first-principles model.

use super::quantity::Quantity;
use super::reader::fields;

/// Outer shape; heights are above the nose, angles against the axis.
#[derive(Debug, Clone)]
pub struct Outline {
    /// Fore-body, lower side, below the axis, rad.
    pub lower_angle_rad: Quantity,
    /// Upper side, above the axis, rad.
    pub upper_angle_rad: Quantity,
    /// Height of the moment centre, m.
    pub moment_height_m: Quantity,
    /// Station of the elevator, m.
    pub elevator_station_m: Quantity,
    /// Height of the elevator, m.
    pub elevator_height_m: Quantity,
    /// Area of the elevator per metre of width, m.
    pub elevator_area_m2_per_m: Quantity,
}

/// Duct, burner and fuel.
#[derive(Debug, Clone)]
pub struct EngineData {
    /// Height of the duct at inlet and exit, m.
    pub duct_height_m: Quantity,
    /// Exit area over burner area.
    pub nozzle_area_ratio: Quantity,
    /// Lower heating value of the fuel, J/kg.
    pub heating_value_j_per_kg: Quantity,
    /// Stoichiometric ratio of fuel to air, by mass.
    pub stoichiometric_ratio: Quantity,
    /// Part of the heating value that is released.
    pub combustion_efficiency: Quantity,
}

fields! {
    Outline {
        lower_angle_rad, upper_angle_rad, moment_height_m, elevator_station_m, elevator_height_m,
        elevator_area_m2_per_m,
    }
    EngineData {
        duct_height_m, nozzle_area_ratio, heating_value_j_per_kg, stoichiometric_ratio,
        combustion_efficiency,
    }
}
