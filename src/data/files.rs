//! Contents of the data files. The build script reads them with the same types.

use super::quantity::Quantity;
use super::reader::fields;
use super::shape::{EngineData, Outline};

/// Flexible modes for which a file gives a damping ratio.
const FLEXIBLE: usize = 3;

/// `vehicle.toml`.
#[derive(Debug, Clone)]
pub struct VehicleData {
    /// Outer shape.
    pub geometry: Geometry,
    /// Mass per metre of width.
    pub mass: Mass,
    /// Bending stiffness and discretisation.
    pub beam: BeamData,
    /// Fore and aft tank, in this order.
    pub tank: [TankData; 2],
    /// Limits of the controls.
    pub actuation: Actuation,
    /// Outer shape of the first-principles model.
    pub outline: Outline,
    /// Engine of the first-principles model.
    pub engine: EngineData,
    /// Start values of the parameters.
    pub default: Defaults,
}

/// Lengths along the body, from the nose aft.
#[derive(Debug, Clone)]
pub struct Geometry {
    /// Overall length, m.
    pub length_m: Quantity,
    /// Length of the fore-body, m.
    pub fore_body_m: Quantity,
    /// Length of the nacelle, which follows the fore-body, m.
    pub nacelle_m: Quantity,
}

/// Mass of the full vehicle and its propellant.
#[derive(Debug, Clone)]
pub struct Mass {
    /// Mass per length ahead of the joint, kg/m^2.
    pub fore_beam_kg_per_m2: Quantity,
    /// Mass per length behind the joint, kg/m^2.
    pub aft_beam_kg_per_m2: Quantity,
    /// Station of the joint, m.
    pub beam_joint_m: Quantity,
    /// Propellant over take-off mass.
    pub propellant_fraction: Quantity,
    /// Fraction of the propellant that remains in the tanks at `fuel_fraction` 0.
    pub residual_fraction: Quantity,
}

/// The free-free beam.
#[derive(Debug, Clone)]
pub struct BeamData {
    /// Number of equal elements.
    pub elements: Quantity<u32>,
    /// Stations of the stiffness table, m; first 0, last the length, increasing.
    pub stiffness_station_m: Quantity<Vec<f64>>,
    /// Bending stiffness EI at the stations, N m^2 per metre of width; linear between them.
    pub stiffness_n_m2_per_m: Quantity<Vec<f64>>,
}

/// One tank.
#[derive(Debug, Clone)]
pub struct TankData {
    /// `fore` or `aft`.
    pub name: String,
    /// Middle of the tank, m.
    pub centre_m: Quantity,
    /// Length along the body over which the frozen liquid is distributed, m.
    pub length_m: Quantity,
    /// Fraction of the propellant in this tank.
    pub share: Quantity,
    /// Length of a bay between baffles along the sloshing motion, m.
    pub bay_length_m: Quantity,
    /// Depth of the liquid when full, m.
    pub depth_full_m: Quantity,
}

/// Limits of the controls.
#[derive(Debug, Clone)]
pub struct Actuation {
    /// Largest elevator deflection in either direction, rad.
    pub delta_e_limit_rad: Quantity,
    /// Largest fuel equivalence ratio.
    pub phi_limit: Quantity,
}

/// Start values of the parameters.
#[derive(Debug, Clone)]
pub struct Defaults {
    /// Fuel fraction.
    pub fuel_fraction: Quantity,
    /// Damping ratio of the sloshing masses.
    pub slosh_damping: Quantity,
    /// Sloshing frequency, rad/s; 0 takes the geometry of the tank.
    pub slosh_frequency_rad_per_s: Quantity,
    /// Mach number.
    pub mach: Quantity,
    /// Altitude, m.
    pub altitude_m: Quantity,
    /// Station of the inertial measurement unit, m from the nose.
    pub imu_station_m: Quantity,
    /// Station of the incidence vane, m from the nose.
    pub probe_station_m: Quantity,
}

/// `earth.toml`.
#[derive(Debug, Clone)]
pub struct EarthData {
    /// Gravity field.
    pub earth: Earth,
    /// Standard atmosphere.
    pub air: AirData,
}

/// Round, non-rotating earth.
#[derive(Debug, Clone)]
pub struct Earth {
    /// Gravity at sea level, m/s^2.
    pub gravity_m_per_s2: Quantity,
    /// Radius, m.
    pub radius_m: Quantity,
}

/// US Standard Atmosphere 1976.
#[derive(Debug, Clone)]
pub struct AirData {
    /// Specific gas constant, J/(kg K).
    pub gas_constant_j_per_kg_k: Quantity,
    /// Ratio of specific heats.
    pub heat_capacity_ratio: Quantity,
    /// Pressure at sea level, Pa.
    pub sea_level_pressure_pa: Quantity,
    /// Temperature at sea level, K.
    pub sea_level_temperature_k: Quantity,
    /// Geopotential altitude of the layers' lower edges, m.
    pub layer_base_m: Quantity<Vec<f64>>,
    /// Temperature gradient in each layer, K/m.
    pub layer_lapse_k_per_m: Quantity<Vec<f64>>,
    /// Upper edge of the last layer, m.
    pub top_m: Quantity,
}

/// `aero/*.toml`: a coefficient set of eq. (4).
#[derive(Debug, Clone)]
pub struct AeroData {
    /// Reference lengths.
    pub reference: Reference,
    /// Inertia and damping that belong to the set.
    pub inertia: Inertia,
    /// C_L.
    pub lift: PolynomialData,
    /// C_D.
    pub drag: PolynomialData,
    /// C_M about the moment centre, without the thrust.
    pub moment: PolynomialData,
    /// C_T without fuel.
    pub thrust: PolynomialData,
    /// C_T per fuel equivalence ratio.
    pub thrust_phi: PolynomialData,
    /// C_L per fuel equivalence ratio, due to the plume under the aft-body.
    pub lift_phi: Option<PolynomialData>,
    /// C_D per fuel equivalence ratio.
    pub drag_phi: Option<PolynomialData>,
    /// C_M per fuel equivalence ratio, without the thrust.
    pub moment_phi: Option<PolynomialData>,
    /// Range of validity.
    pub envelope: EnvelopeData,
}

/// Reference lengths and the incidence of the elastic derivatives.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Area per metre of width, m.
    pub area_m2_per_m: Quantity,
    /// Chord, m.
    pub chord_m: Quantity,
    /// Station about which C_M is taken, m from the nose.
    pub moment_centre_m: Quantity,
    /// Distance of the thrust line below the mass centre, m.
    pub thrust_arm_m: Quantity,
    /// Incidence at which the elastic derivatives are taken, rad.
    pub elastic_alpha_rad: Quantity,
    /// Factor on all elastic terms; 1 as they are derived.
    pub elastic_scale: Quantity,
    /// Elevator deflection at which they are taken, rad; relevant if the lift is cubic in it.
    pub elastic_delta_e_rad: Option<Quantity>,
    /// Station of the flight-path angle in the flexible columns of Table 3, m aft of the mass centre;
    /// used by reports only.
    pub gamma_offset_m: Option<Quantity>,
}

/// Inertia and damping of a coefficient set.
#[derive(Debug, Clone)]
pub struct Inertia {
    /// Pitch inertia of the full vehicle, kg m^2 per metre of width.
    pub i_yy_kg_m2_per_m: Quantity,
    /// Damping ratio of the structure in each flexible mode.
    pub structural_damping: Quantity<[f64; FLEXIBLE]>,
    /// Mass centre of the flexible configurations relative to that of beam and sloshing masses, m aft.
    pub mass_centre_shift_m: Option<Quantity>,
}

/// A polynomial in incidence and elevator deflection; omitted coefficients are zero.
#[derive(Debug, Clone)]
pub struct PolynomialData {
    /// Constant term.
    pub constant: Option<Quantity>,
    /// Per rad of incidence.
    pub alpha: Option<Quantity>,
    /// Per rad^2 of incidence.
    pub alpha2: Option<Quantity>,
    /// Per rad^3 of incidence.
    pub alpha3: Option<Quantity>,
    /// Per rad of elevator deflection.
    pub delta_e: Option<Quantity>,
    /// Per rad^2 of elevator deflection.
    pub delta_e2: Option<Quantity>,
    /// Per rad^3 of elevator deflection.
    pub delta_e3: Option<Quantity>,
    /// Per rad of incidence and rad of elevator deflection.
    pub alpha_delta_e: Option<Quantity>,
}

/// Lower and upper limits of validity.
#[derive(Debug, Clone)]
pub struct EnvelopeData {
    /// Incidence, rad.
    pub alpha_rad: Quantity<[f64; 2]>,
    /// Mach number.
    pub mach: Quantity<[f64; 2]>,
    /// Altitude, m.
    pub altitude_m: Quantity<[f64; 2]>,
    /// Smallest equivalence ratio that can be added before the burner chokes; no limit if omitted.
    pub choking_margin: Option<Quantity>,
}

fields! {
    VehicleData { geometry, mass, beam, tank, actuation, outline, engine, default }
    Geometry { length_m, fore_body_m, nacelle_m }
    Mass {
        fore_beam_kg_per_m2, aft_beam_kg_per_m2, beam_joint_m, propellant_fraction,
        residual_fraction,
    }
    BeamData { elements, stiffness_station_m, stiffness_n_m2_per_m }
    TankData { name, centre_m, length_m, share, bay_length_m, depth_full_m }
    Actuation { delta_e_limit_rad, phi_limit }
    Defaults {
        fuel_fraction, slosh_damping, slosh_frequency_rad_per_s, mach, altitude_m, imu_station_m,
        probe_station_m,
    }
    EarthData { earth, air }
    Earth { gravity_m_per_s2, radius_m }
    AirData {
        gas_constant_j_per_kg_k, heat_capacity_ratio, sea_level_pressure_pa,
        sea_level_temperature_k, layer_base_m, layer_lapse_k_per_m, top_m,
    }
    AeroData {
        reference, inertia, lift, drag, moment, thrust, thrust_phi, lift_phi, drag_phi, moment_phi,
        envelope,
    }
    Reference {
        area_m2_per_m, chord_m, moment_centre_m, thrust_arm_m, elastic_alpha_rad, elastic_scale,
        elastic_delta_e_rad, gamma_offset_m,
    }
    Inertia { i_yy_kg_m2_per_m, structural_damping, mass_centre_shift_m }
    PolynomialData { constant, alpha, alpha2, alpha3, delta_e, delta_e2, delta_e3, alpha_delta_e }
    EnvelopeData { alpha_rad, mach, altitude_m, choking_margin }
}
