//! Liquid in the two tanks: sloshing mass, its frequency, and the frozen rest. Fig. 4 of the paper.
//!
//! E. W. Graham and A. M. Rodriguez, "The characteristics of fuel motion which affect airplane dynamics",
//! J. Applied Mechanics 19(3), 1952, 381-388: liquid of depth `h` in a rectangular tank of length `b`
//! along the motion is equivalent to a series of spring-mass systems and a frozen mass that moves with
//! the walls. With r = h/b the first system, which is kept, has
//!
//! ```text
//! m_1 / m = 8 tanh(pi r) / (pi^3 r),   omega_1^2 = g (pi/b) tanh(pi r),   k_1 = m_1 omega_1^2
//! ```
//!
//! Neglected are the *second mode*, whose mass in a deep tank is 1/27 (3.7 %) of the first, less than the
//! accuracy of the data (its liquid counts as frozen), and the *attachment height* `h (1/2 - tanh(pi r/2)
//! / (pi r/2))` above the centre of the liquid, here at most two thirds of a metre: the mass is attached
//! to the tank's node, as in fig. 4.

use crate::data::{TankData, VehicleData};
use crate::error::Error;
use libm::tanh;
use std::f64::consts::PI;

/// Sloshing mass over liquid mass of a tank with `depth_ratio = h/b`:
/// `8 tanh(pi r) / (pi^3 r)`, Graham and Rodriguez 1952, first mode.
///
/// Falls from `8/pi^2` (shallow) to 0 (deep, where only the surface moves).
pub fn mass_ratio(depth_ratio: f64) -> f64 {
    let x = PI * depth_ratio;
    8.0 * tanh(x) / (PI * PI * x)
}

/// Angular frequency, rad/s, of the first mode: `omega^2 = g (pi/b) tanh(pi h/b)`,
/// Graham and Rodriguez 1952; `bay_length_m = b`, gravity in m/s^2.
pub fn frequency(gravity_m_per_s2: f64, bay_length_m: f64, depth_ratio: f64) -> f64 {
    (gravity_m_per_s2 * PI / bay_length_m * tanh(PI * depth_ratio)).sqrt()
}

/// Mass of the full vehicle per metre of width, kg/m.
pub fn full_mass_kg_per_m(data: &VehicleData) -> f64 {
    let (mass, joint) = (&data.mass, data.mass.beam_joint_m.value);
    mass.fore_beam_kg_per_m2.value * joint
        + mass.aft_beam_kg_per_m2.value * (data.geometry.length_m.value - joint)
}

/// Fraction of the full load on board, including the residual propellant.
fn filling(data: &VehicleData, fuel_fraction: f64) -> f64 {
    let residual = data.mass.residual_fraction.value;
    residual + (1.0 - residual) * fuel_fraction
}

/// Propellant on board per metre of width, kg/m.
pub fn propellant_kg_per_m(data: &VehicleData, fuel_fraction: f64) -> f64 {
    data.mass.propellant_fraction.value * full_mass_kg_per_m(data) * filling(data, fuel_fraction)
}

/// Usable fuel per metre of width, kg/m.
pub fn fuel_kg_per_m(data: &VehicleData, fuel_fraction: f64) -> f64 {
    let drainable = 1.0 - data.mass.residual_fraction.value;
    let load = data.mass.propellant_fraction.value * full_mass_kg_per_m(data);
    load * drainable * fuel_fraction
}

/// Lowest sloshing frequency that can be set, rad/s. With softer springs the static deflection of the
/// truncated modes would be metres.
pub const MIN_FREQUENCY_RAD_PER_S: f64 = 0.1;

/// Sloshing frequency and damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SloshSettings {
    /// Damping ratio of the sloshing mass in a fixed tank.
    pub damping_ratio: f64,
    /// Angular frequency of both tanks, rad/s; 0 takes [`frequency`] of each tank.
    pub frequency_rad_per_s: f64,
    /// Gravity less centrifugal acceleration, normal to the flight path, m/s^2; used with [`frequency`].
    pub gravity_m_per_s2: f64,
}

/// A tank at one filling. Masses and coefficients per metre of vehicle width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SloshingTank {
    /// Station of the middle of the tank, m from the nose; the sloshing mass is attached there.
    pub centre_m: f64,
    /// Extent of the frozen liquid along the body, m.
    pub length_m: f64,
    /// Mean depth of the liquid, m.
    pub depth_m: f64,
    /// All the liquid, kg/m.
    pub liquid_mass: f64,
    /// Frozen liquid, which moves with the walls, kg/m.
    pub frozen_mass: f64,
    /// Sloshing liquid, kg/m.
    pub sloshing_mass: f64,
    /// Angular frequency in a fixed tank, rad/s.
    pub omega_rad_per_s: f64,
    /// Spring between tank and sloshing mass, N/m per metre: `m omega^2`.
    pub stiffness: f64,
    /// Damper beside the spring, N s/m per metre: `2 zeta m omega`.
    pub damping: f64,
}

impl SloshingTank {
    /// Fore and aft tank, in this order.
    ///
    /// # Errors
    /// [`Error::SloshFrequency`] if the frequency is positive but below [`MIN_FREQUENCY_RAD_PER_S`];
    /// [`Error::NoSloshFrequency`] if it is to follow from the geometry and the effective gravity is not
    /// positive (orbital speed and above).
    pub fn pair(
        data: &VehicleData,
        fuel_fraction: f64,
        settings: &SloshSettings,
    ) -> Result<[Self; 2], Error> {
        let requested = settings.frequency_rad_per_s;
        if requested > 0.0 && requested < MIN_FREQUENCY_RAD_PER_S {
            return Err(Error::SloshFrequency {
                asked_rad_per_s: requested,
                least_rad_per_s: MIN_FREQUENCY_RAD_PER_S,
            });
        }
        let gravity = settings.gravity_m_per_s2;
        if settings.frequency_rad_per_s <= 0.0 && gravity <= 0.0 {
            return Err(Error::NoSloshFrequency { gravity_m_per_s2: gravity });
        }
        let filling = filling(data, fuel_fraction);
        let propellant = propellant_kg_per_m(data, fuel_fraction);
        Ok([0, 1].map(|j| Self::new(&data.tank[j], propellant, filling, settings)))
    }

    fn new(tank: &TankData, propellant: f64, filling: f64, settings: &SloshSettings) -> Self {
        let bay_length = tank.bay_length_m.value;
        let depth_m = tank.depth_full_m.value * filling;
        let depth_ratio = depth_m / bay_length;
        let liquid_mass = tank.share.value * propellant;
        let sloshing_mass = liquid_mass * mass_ratio(depth_ratio);
        let omega = if settings.frequency_rad_per_s > 0.0 {
            settings.frequency_rad_per_s
        } else {
            frequency(settings.gravity_m_per_s2, bay_length, depth_ratio)
        };
        Self {
            centre_m: tank.centre_m.value,
            length_m: tank.length_m.value,
            depth_m,
            liquid_mass,
            frozen_mass: liquid_mass - sloshing_mass,
            sloshing_mass,
            omega_rad_per_s: omega,
            stiffness: sloshing_mass * omega * omega,
            damping: 2.0 * settings.damping_ratio * sloshing_mass * omega,
        }
    }
}
