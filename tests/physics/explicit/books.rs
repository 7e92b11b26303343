//! Mass books: what is where, from the data files alone.

use ahv::data::{AeroData, TankData, VehicleData};
use ahv::vehicle::VehicleOptions;
use std::f64::consts::PI;

/// What is asked of a vehicle.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    pub fuel_fraction: f64,
    /// Sloshing frequency on a tank that stands still, rad/s; 0: from the tank.
    pub slosh_frequency: f64,
    pub slosh_damping: f64,
    /// Of i_yy.
    pub inertia_factor: f64,
    /// Mass centre against that of the densities, m aft.
    pub shift_m: f64,
    /// Part of the strips' answer to the pitch rate that counts.
    pub pitch_rate: f64,
}

impl From<&VehicleOptions> for Wanted {
    fn from(options: &VehicleOptions) -> Self {
        Self {
            fuel_fraction: options.fuel_fraction,
            slosh_frequency: options.slosh_frequency,
            slosh_damping: options.slosh_damping,
            inertia_factor: options.factors.inertia,
            shift_m: options.factors.mass_centre_shift_m,
            pitch_rate: options.factors.pitch_rate,
        }
    }
}

/// Liquid of one tank that sloshes, and the rest of it.
#[derive(Debug, Clone, Copy)]
pub struct Liquid {
    /// Node of the library's beam next to the middle of the tank, on which the mass hangs, m from the nose.
    pub station: f64,
    /// Middle of the tank, m from the nose.
    pub middle: f64,
    /// Extent of the frozen liquid, m.
    pub length: f64,
    /// kg/m.
    pub frozen: f64,
    /// kg/m.
    pub sloshing: f64,
    /// Spring, N/m per metre of width.
    pub spring: f64,
    /// Damper, N s/m per metre of width.
    pub damper: f64,
}

/// Mass, mass centre (m from the nose) and inertia about it.
#[derive(Debug, Clone, Copy)]
pub struct Total {
    pub mass: f64,
    pub centre: f64,
    pub inertia: f64,
}

fn full_mass(data: &VehicleData) -> f64 {
    let joint = data.mass.beam_joint_m.value;
    let aft = data.geometry.length_m.value - joint;
    data.mass.fore_beam_kg_per_m2.value * joint + data.mass.aft_beam_kg_per_m2.value * aft
}

fn filling(data: &VehicleData, fuel_fraction: f64) -> f64 {
    let residual = data.mass.residual_fraction.value;
    residual + (1.0 - residual) * fuel_fraction
}

/// Graham and Rodriguez 1952, first mode of a rectangular tank: its part of the liquid, and the square
/// of its frequency over that of gravity, 1/m.
fn first_mode(depth: f64, bay: f64) -> [f64; 2] {
    let ratio = depth / bay;
    let tanh = (PI * ratio).tanh();
    [8.0 * tanh / (PI.powi(3) * ratio), PI / bay * tanh]
}

/// The liquid in both tanks under a gravity, m/s^2.
pub fn liquids(data: &VehicleData, wanted: &Wanted, gravity: f64) -> [Liquid; 2] {
    let filling = filling(data, wanted.fuel_fraction);
    let element = data.geometry.length_m.value / f64::from(data.beam.elements.value);
    let load = data.mass.propellant_fraction.value * full_mass(data) * filling;
    let liquid = |tank: &TankData| {
        let depth = tank.depth_full_m.value * filling;
        let [part, per_gravity] = first_mode(depth, tank.bay_length_m.value);
        let mass = tank.share.value * load;
        let omega = match wanted.slosh_frequency {
            0.0 => (gravity * per_gravity).sqrt(),
            asked => asked,
        };
        let sloshing = part * mass;
        Liquid {
            station: (tank.centre_m.value / element).round() * element,
            middle: tank.centre_m.value,
            length: tank.length_m.value,
            frozen: mass - sloshing,
            sloshing,
            spring: sloshing * omega * omega,
            damper: 2.0 * wanted.slosh_damping * sloshing * omega,
        }
    };
    [liquid(&data.tank[0]), liquid(&data.tank[1])]
}

/// Sum of uniform pieces, [mass, from, to] each, and of points.
fn total(pieces: &[[f64; 3]]) -> Total {
    let mass: f64 = pieces.iter().map(|[mass, _, _]| mass).sum();
    let centre = pieces.iter().map(|[mass, a, b]| mass * 0.5 * (a + b)).sum::<f64>() / mass;
    let inertia = |[piece, a, b]: &[f64; 3]| {
        let arm = 0.5 * (a + b) - centre;
        piece * (arm * arm + (b - a) * (b - a) / 12.0)
    };
    Total { mass, centre, inertia: pieces.iter().map(inertia).sum() }
}

/// Structure and frozen liquid.
fn pieces(data: &VehicleData, liquids: &[Liquid; 2]) -> [[f64; 3]; 4] {
    let dry = 1.0 - data.mass.propellant_fraction.value;
    let (joint, length) = (data.mass.beam_joint_m.value, data.geometry.length_m.value);
    let [fore, aft] = [&data.mass.fore_beam_kg_per_m2, &data.mass.aft_beam_kg_per_m2]
        .map(|density| dry * density.value);
    let [frozen_fore, frozen_aft] = liquids.map(|l| {
        let half = 0.5 * l.length;
        [l.frozen, l.middle - half, l.middle + half]
    });
    let structure = [[fore * joint, 0.0, joint], [aft * (length - joint), joint, length]];
    [structure[0], structure[1], frozen_fore, frozen_aft]
}

/// Mass of each of a number of elements.
pub fn spread(data: &VehicleData, liquids: &[Liquid; 2], elements: usize) -> Vec<f64> {
    let length = data.geometry.length_m.value / elements as f64;
    let pieces = pieces(data, liquids);
    let masses = (0..elements).map(|e| {
        let (start, end) = (e as f64 * length, (e + 1) as f64 * length);
        let part = |[mass, from, to]: &[f64; 3]| {
            mass / (to - from) * (to.min(end) - from.max(start)).max(0.0)
        };
        pieces.iter().map(part).sum()
    });
    masses.collect()
}

/// What the densities give, each even within an element of the library's beam.
fn of_densities(data: &VehicleData, liquids: &[Liquid; 2]) -> Total {
    let elements = data.beam.elements.value as usize;
    let length = data.geometry.length_m.value / elements as f64;
    let masses = spread(data, liquids, elements).into_iter().enumerate();
    let even = masses.map(|(e, mass)| [mass, e as f64 * length, (e + 1) as f64 * length]);
    let points = liquids.map(|l| [l.sloshing, l.station, l.station]);
    total(&even.chain(points).collect::<Vec<_>>())
}

/// The body and the liquid on it, with the mass centre and the inertia that are wanted.
#[derive(Debug, Clone, Copy)]
pub struct Books {
    /// Of all.
    pub total: Total,
    /// Of the densities.
    pub own: Total,
    pub liquids: [Liquid; 2],
}

impl Books {
    pub fn new(data: &VehicleData, set: &AeroData, wanted: &Wanted, gravity: f64) -> Self {
        let liquids = liquids(data, wanted, gravity);
        let own = of_densities(data, &liquids);
        let full = Wanted { fuel_fraction: 1.0, ..*wanted };
        let full = of_densities(data, &self::liquids(data, &full, gravity));
        let i_yy = set.inertia.i_yy_kg_m2_per_m.value * wanted.inertia_factor;
        let of_set = set.inertia.mass_centre_shift_m.as_ref().map_or(0.0, |shift| shift.value);
        let total = Total {
            mass: own.mass,
            centre: own.centre + of_set + wanted.shift_m,
            inertia: i_yy * own.inertia / full.inertia,
        };
        Self { total, own, liquids }
    }

    /// Least inertia about the mass centre: that of the sloshing masses and of a body that is a point.
    pub fn least_inertia(&self) -> f64 {
        let arms = self.liquids.map(|l| [l.sloshing, l.station - self.total.centre]);
        let first: f64 = arms.iter().map(|[mass, arm]| mass * arm).sum();
        let body = self.total.mass - arms.iter().map(|[mass, _]| mass).sum::<f64>();
        let points: f64 = arms.iter().map(|[mass, arm]| mass * arm * arm).sum();
        points + first * first / body
    }
}
