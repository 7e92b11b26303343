//! Liquid in the two tanks: what sloshes, how fast, and what lies still. Fig. 4 of the paper.
//!
//! E. W. Graham and A. M. Rodriguez, "The characteristics of fuel motion which affect airplane
//! dynamics", J. Applied Mechanics 19(3), 1952, 381-388: liquid of depth `h` in a rectangular tank
//! of length `b` along the motion answers like a row of spring-mass systems and a rest that moves
//! with the walls. The first of the row is kept.
//!
//! Two things are left out on purpose. The *second mode* carries 1/27 of the first one's mass in a
//! deep tank (3.7 %, [`mass_ratio`] of a bay a third as long), less than the data are known to; its
//! liquid counts as frozen. The *attachment height* `h (1/2 - tanh(pi r/2) / (pi r/2))` above the
//! middle of the liquid is at most two thirds of a metre here, while the station of a tank is itself
//! identified from three frequencies: the mass hangs on the tank's node, as in fig. 4.

use crate::data::{TankData, VehicleData};
use crate::error::Error;
use libm::tanh;
use std::f64::consts::PI;

/// Sloshing mass over liquid mass of a tank with `depth_ratio = h/b`:
/// `8 tanh(pi r) / (pi^3 r)`, Graham and Rodriguez 1952, first mode.
///
/// Falls from `8/pi^2` (shallow) to nothing (deep, where only the surface moves).
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

/// Part of the full load that is on board: the residual stays at `fuel_fraction` 0.
fn filling(data: &VehicleData, fuel_fraction: f64) -> f64 {
    let residual = data.mass.residual_fraction.value;
    residual + (1.0 - residual) * fuel_fraction
}

/// Propellant on board per metre of width, kg/m.
pub fn propellant_kg_per_m(data: &VehicleData, fuel_fraction: f64) -> f64 {
    data.mass.propellant_fraction.value * full_mass_kg_per_m(data) * filling(data, fuel_fraction)
}

/// Fuel per metre of width, kg/m: what of the propellant can be drained.
pub fn fuel_kg_per_m(data: &VehicleData, fuel_fraction: f64) -> f64 {
    let drainable = 1.0 - data.mass.residual_fraction.value;
    let load = data.mass.propellant_fraction.value * full_mass_kg_per_m(data);
    load * drainable * fuel_fraction
}

/// Slowest frequency that can be asked for, rad/s. A slower spring is so soft that what the kept
/// modes leave of the static loads moves the liquid by metres.
pub const SLOWEST_RAD_PER_S: f64 = 0.1;

/// Where the sloshing frequency and its damping come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SloshSettings {
    /// Damping ratio of the sloshing mass on a tank that stands still.
    pub damping_ratio: f64,
    /// Angular frequency of both tanks, rad/s; 0 takes [`frequency`] of each tank.
    pub frequency_rad_per_s: f64,
    /// Gravity less the centrifugal part, across the flight path, m/s^2; used where the frequency
    /// comes from the tank.
    pub gravity_m_per_s2: f64,
}

/// A tank at one filling. Masses and coefficients per metre of vehicle width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SloshingTank {
    /// Middle of the tank, m from the nose: where the sloshing mass is attached.
    pub centre_m: f64,
    /// Extent of the frozen liquid along the body, m.
    pub length_m: f64,
    /// Mean depth of the liquid, m.
    pub depth_m: f64,
    /// All the liquid, kg/m.
    pub liquid_mass: f64,
    /// Liquid that moves with the walls, kg/m.
    pub frozen_mass: f64,
    /// Liquid that sloshes, kg/m.
    pub sloshing_mass: f64,
    /// Angular frequency on a tank that stands still, rad/s.
    pub omega_rad_per_s: f64,
    /// Spring between tank and sloshing mass, N/m per metre: `m omega^2`.
    pub stiffness: f64,
    /// Damper beside the spring, N s/m per metre: `2 zeta m omega`.
    pub damping: f64,
}

impl SloshingTank {
    /// Fore and aft tank, in this order.
    ///
    /// Fails where the tank's own frequency is asked for and gravity does not hold the liquid:
    /// from orbital speed upwards.
    pub fn pair(
        data: &VehicleData,
        fuel_fraction: f64,
        settings: &SloshSettings,
    ) -> Result<[Self; 2], Error> {
        let asked = settings.frequency_rad_per_s;
        if asked > 0.0 && asked < SLOWEST_RAD_PER_S {
            return Err(Error::SloshFrequency {
                asked_rad_per_s: asked,
                least_rad_per_s: SLOWEST_RAD_PER_S,
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
