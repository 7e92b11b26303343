//! The free-free beam: equal Euler-Bernoulli elements with sloshing masses at nodes. Eqs (1)-(2) of the
//! paper.
//!
//! A displacement is a slice `[w_0, theta_0, w_1, theta_1, ...]` over the nodes, nose first:
//! deflection in m, up positive, and slope `dw/dx` in rad; a load is `[force, moment, ...]`, N/m
//! and N m/m, in the same order. All quantities are per metre of vehicle width.
//!
//! The stiffness matrix K is never assembled: with 500 cubic elements its condition number is
//! near 1e13, and a factorisation would lose the digits of the low modes. A free-free beam is statically
//! determinate, so [`Beam::deflect`] integrates shear, moment, curvature and slope from the nose:
//!
//! ```text
//! Q' = p,   (EI w'')' = Q,   over an element of length l with constant EI:
//! w     <- w + l theta + (l^2 / EI) (M/2 + Q l/6)
//! theta <- theta + (l / EI) (M + Q l/2),   M <- M + Q l
//! ```
//!
//! The deflection between loaded nodes is a cubic, so this is the exact inverse of K on self-equilibrated
//! loads, in O(n) operations and almost to the last bit.

use super::mass_correction::MassCorrection;
use super::tanks::{SloshingTank, full_mass_kg_per_m, propellant_kg_per_m};
use crate::data::VehicleData;
use multiversion::multiversion;

/// Sloshing mass on a spring and a damper at a node; it moves vertically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Node of attachment.
    pub node: usize,
    /// Mass, kg/m.
    pub mass: f64,
    /// Spring, N/m per metre of width.
    pub stiffness: f64,
    /// Damper, N s/m per metre of width.
    pub damping: f64,
}

/// Mass, its centre and its inertia, per metre of width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// kg/m.
    pub mass: f64,
    /// Station of the mass centre, m from the nose.
    pub centre_m: f64,
    /// About the mass centre, kg m^2 per metre of width.
    pub inertia: f64,
}

/// A free-free beam of equal elements, each with constant stiffness and density.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// Length of an element, m.
    pub element_m: f64,
    /// Bending stiffness EI of each element, N m^2 per metre of width.
    pub stiffness: Vec<f64>,
    /// Mass per length of each element, kg/m^2.
    pub density: Vec<f64>,
    /// Correction of mass centre and inertia.
    pub correction: MassCorrection,
}

impl Beam {
    /// All mass distributed as in the full vehicle: configuration `EvenMassBeam`.
    pub fn even(data: &VehicleData, fuel_fraction: f64) -> Self {
        let dry = 1.0 - data.mass.propellant_fraction.value;
        let scale = dry + propellant_kg_per_m(data, fuel_fraction) / full_mass_kg_per_m(data);
        Self::with_structure(data, scale)
    }

    /// Structure and frozen liquid, without the sloshing masses ([`Beam::attach`]): configuration
    /// `SloshBeam`.
    pub fn slosh(data: &VehicleData, tanks: &[SloshingTank; 2]) -> Self {
        let mut beam = Self::with_structure(data, 1.0 - data.mass.propellant_fraction.value);
        for tank in tanks {
            let (centre, half) = (tank.centre_m, 0.5 * tank.length_m);
            beam.spread(tank.frozen_mass / tank.length_m, centre - half, centre + half);
        }
        beam
    }

    fn with_structure(data: &VehicleData, scale: f64) -> Self {
        let count = data.beam.elements.value as usize;
        let element_m = data.geometry.length_m.value / count as f64;
        let (stations, values) =
            (&data.beam.stiffness_station_m.value, &data.beam.stiffness_n_m2_per_m.value);
        let stiffness = (0..count)
            .map(|e| interpolate(stations, values, (e as f64 + 0.5) * element_m))
            .collect();
        let density = vec![0.0; count];
        let mut beam =
            Self { element_m, stiffness, density, correction: MassCorrection::default() };
        let (mass, joint) = (&data.mass, data.mass.beam_joint_m.value);
        beam.spread(scale * mass.fore_beam_kg_per_m2.value, f64::NEG_INFINITY, joint);
        beam.spread(scale * mass.aft_beam_kg_per_m2.value, joint, f64::INFINITY);
        beam
    }

    /// Adds a uniform density over `[from, to]`; a partly covered element gets the average.
    fn spread(&mut self, density: f64, from: f64, to: f64) {
        for (e, total) in self.density.iter_mut().enumerate() {
            let start = e as f64 * self.element_m;
            let end = (e + 1) as f64 * self.element_m;
            let overlap = (to.min(end) - from.max(start)).max(0.0);
            *total += density * overlap / (end - start);
        }
    }

    /// Number of elements; there is one node more.
    pub fn elements(&self) -> usize {
        self.density.len()
    }

    /// Length of a displacement or load: two entries per node.
    pub fn unknowns(&self) -> usize {
        2 * (self.elements() + 1)
    }

    /// Length of the beam, m.
    pub fn length_m(&self) -> f64 {
        self.elements() as f64 * self.element_m
    }

    /// Station of a node, m from the nose.
    pub fn station(&self, node: usize) -> f64 {
        node as f64 * self.element_m
    }

    /// The node nearest to a station.
    pub fn nearest_node(&self, station_m: f64) -> usize {
        ((station_m / self.element_m).round() as usize).min(self.elements())
    }

    /// The sloshing mass of a tank, on the node nearest to its middle.
    pub fn attach(&self, tank: &SloshingTank) -> Oscillator {
        Oscillator {
            node: self.nearest_node(tank.centre_m),
            mass: tank.sloshing_mass,
            stiffness: tank.stiffness,
            damping: tank.damping,
        }
    }

    /// Mass, mass centre and inertia of beam and sloshing masses (points at their nodes): the
    /// rigid-body entries of the mass matrix.
    pub fn mass_properties(&self, oscillators: &[Oscillator]) -> MassProperties {
        let own = self.density_properties(oscillators);
        let (shift, off) =
            (self.correction.first / own.mass, own.centre_m - self.correction.motion.centre_m);
        let moved = own.mass * ((off + shift) * (off + shift) - off * off);
        MassProperties {
            mass: own.mass,
            centre_m: own.centre_m + shift,
            inertia: own.inertia + self.correction.second - moved,
        }
    }

    /// [`Beam::mass_properties`] without the correction. The consistent mass matrix is exact for rigid-body
    /// motion.
    pub fn density_properties(&self, oscillators: &[Oscillator]) -> MassProperties {
        let own = self.element_m * self.element_m / 12.0;
        let parts = || {
            let elements = self.density.iter().enumerate().map(move |(e, density)| {
                (density * self.element_m, (e as f64 + 0.5) * self.element_m, own)
            });
            elements.chain(oscillators.iter().map(|o| (o.mass, self.station(o.node), 0.0)))
        };
        let mass: f64 = parts().map(|(mass, _, _)| mass).sum();
        let centre_m = parts().map(|(mass, x, _)| mass * x).sum::<f64>() / mass;
        let inertia =
            parts().map(|(mass, x, own)| mass * ((x - centre_m) * (x - centre_m) + own)).sum();
        MassProperties { mass, centre_m, inertia }
    }

    /// Consistent mass matrix of an element's density, for `[w, theta]` at its two ends.
    pub fn element_mass(&self, element: usize) -> [[f64; 4]; 4] {
        let l = self.element_m;
        let rows = [
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ];
        rows.map(|row| row.map(|entry| entry * self.density[element] * l / 420.0))
    }

    /// Stiffness matrix of an element, for `[w, theta]` at its two ends; for tests only.
    pub fn element_stiffness(&self, element: usize) -> [[f64; 4]; 4] {
        let l = self.element_m;
        let rows = [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ];
        rows.map(|row| row.map(|entry| entry * self.stiffness[element] / (l * l * l)))
    }

    /// `product = M displacement`; M is the corrected mass matrix of the beam without sloshing masses.
    ///
    /// Both slices hold [`Beam::unknowns`] entries.
    pub fn mass_times(&self, displacement: &[f64], product: &mut [f64]) {
        self.density_times(displacement, product);
        if !self.correction.motion.rotation.is_empty() {
            self.correction.add_product(displacement, product);
        }
    }

    /// `product = M_b displacement`; M_b is the consistent mass matrix of the density.
    pub fn density_times(&self, displacement: &[f64], product: &mut [f64]) {
        density_times(self.element_m, &self.density, displacement, product);
    }

    /// The displacement under a self-equilibrated load, with `w_0 = theta_0 = 0`.
    ///
    /// The last node's load is not read: equilibrium determines it. Both slices hold [`Beam::unknowns`]
    /// entries.
    pub fn deflect(&self, load: &[f64], displacement: &mut [f64]) {
        let l = self.element_m;
        let [mut shear, mut bending, mut slope, mut w] = [0.0; 4];
        let (loads, _) = load.as_chunks::<2>();
        let (out, _) = displacement.as_chunks_mut::<2>();
        for (([force, moment], out), stiffness) in loads.iter().zip(out).zip(&self.stiffness) {
            *out = [w, slope];
            // (EI w'')' = shear, EI w'' = bending; signs by the principle of virtual work.
            shear += force;
            bending -= moment;
            let rise = shear * l;
            let flexibility = l / stiffness;
            w += l * (slope + flexibility * (bending / 2.0 + rise / 6.0));
            slope += flexibility * (bending + rise / 2.0);
            bending += rise;
        }
        let tail = 2 * self.elements();
        displacement[tail..].copy_from_slice(&[w, slope]);
    }
}

/// [`Beam::density_times`]: the inertia of each element at its first node, then that at its second. The
/// elements of either loop do not wait for each other.
#[multiversion(targets("x86_64+avx"))]
fn density_times(l: f64, density: &[f64], displacement: &[f64], product: &mut [f64]) {
    let (nodes, _) = displacement.as_chunks::<2>();
    let (product, _) = product.as_chunks_mut::<2>();
    let ends = || nodes.iter().zip(&nodes[1..]).zip(density);
    for (out, (([w0, slope0], [w1, slope1]), density)) in product.iter_mut().zip(ends()) {
        let (scale, t0, t1) = (density * l / 420.0, l * slope0, l * slope1);
        *out = [
            scale * (156.0 * w0 + 22.0 * t0 + 54.0 * w1 - 13.0 * t1),
            scale * l * (22.0 * w0 + 4.0 * t0 + 13.0 * w1 - 3.0 * t1),
        ];
    }
    product[density.len()] = [0.0; 2];
    for (out, (([w0, slope0], [w1, slope1]), density)) in product[1..].iter_mut().zip(ends()) {
        let (scale, t0, t1) = (density * l / 420.0, l * slope0, l * slope1);
        out[0] += scale * (54.0 * w0 + 13.0 * t0 + 156.0 * w1 - 22.0 * t1);
        out[1] += -scale * l * (13.0 * w0 + 3.0 * t0 + 22.0 * w1 - 4.0 * t1);
    }
}

/// Linear interpolation in a table with increasing stations.
fn interpolate(stations: &[f64], values: &[f64], x: f64) -> f64 {
    let right = stations.partition_point(|&station| station < x).clamp(1, stations.len() - 1);
    let (x0, x1) = (stations[right - 1], stations[right]);
    let (y0, y1) = (values[right - 1], values[right]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}
