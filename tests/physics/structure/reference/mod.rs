//! The same eigenproblem in double-double arithmetic, 32 digits, by an independent route: the
//! matrices are assembled and factored. At condition numbers near 1e13 some 18 digits remain.

mod double_double;

use ahv::data::{DataFile, VEHICLE, VehicleData};
use ahv::structure::tanks::{SloshSettings, SloshingTank};
use ahv::structure::{Beam, Modes, Oscillator};
pub use double_double::{Dd, exact};

/// Entries above the diagonal in a row of the beam's matrices.
const BAND: usize = 3;

pub type Vector = Vec<Dd>;

pub fn vehicle() -> VehicleData {
    VehicleData::embedded(&VEHICLE).unwrap()
}

/// The vehicle with its tanks; gravity as in level flight at Mach 8.
pub fn tanked(fuel_fraction: f64, frequency_rad_per_s: f64) -> (Beam, [Oscillator; 2]) {
    let data = vehicle();
    let settings =
        SloshSettings { damping_ratio: 0.05, frequency_rad_per_s, gravity_m_per_s2: 8.8 };
    let tanks = SloshingTank::pair(&data, fuel_fraction, &settings).unwrap();
    let beam = Beam::slosh(&data, &tanks);
    let oscillators = tanks.map(|tank| beam.attach(&tank));
    (beam, oscillators)
}

/// A beam of constant stiffness and density.
pub fn uniform(elements: usize, length: f64, stiffness: f64, density: f64) -> Beam {
    Beam {
        element_m: length / elements as f64,
        stiffness: vec![stiffness; elements],
        density: vec![density; elements],
        correction: Default::default(),
    }
}

/// Mode `i`: displacement of the beam, then of the sloshing masses.
pub fn displacement(modes: &Modes, oscillators: &[Oscillator], i: usize) -> Vec<f64> {
    let shape = &modes.shape[i];
    let nodes = shape.w.iter().zip(&shape.slope).flat_map(|(w, slope)| [*w, *slope]);
    let masses = oscillators
        .iter()
        .zip(&modes.slosh_displacement)
        .map(|(o, relative)| relative[i] + shape.w[o.node]);
    nodes.chain(masses).collect()
}

pub struct Reference<'a> {
    pub beam: &'a Beam,
    pub oscillators: &'a [Oscillator],
}

impl Reference<'_> {
    /// `(K, M)` of an element, each entry to 32 digits.
    fn element(&self, e: usize) -> ([[Dd; 4]; 4], [[Dd; 4]; 4]) {
        let l = exact(self.beam.element_m);
        let ei = exact(self.beam.stiffness[e]) / (l * l * l);
        let mass = exact(self.beam.density[e]) * l / 420.0;
        let unit = [exact(1.0), l, exact(1.0), l];
        let stiffness = [
            [12.0, 6.0, -12.0, 6.0],
            [6.0, 4.0, -6.0, 2.0],
            [-12.0, -6.0, 12.0, -6.0],
            [6.0, 2.0, -6.0, 4.0],
        ];
        let inertia = [
            [156.0, 22.0, 54.0, -13.0],
            [22.0, 4.0, 13.0, -3.0],
            [54.0, 13.0, 156.0, -22.0],
            [-13.0, -3.0, -22.0, 4.0],
        ];
        let options = |table: [[f64; 4]; 4], scale: Dd| {
            std::array::from_fn(|i| {
                std::array::from_fn(|k| scale * table[i][k] * unit[i] * unit[k])
            })
        };
        (options(stiffness, ei), options(inertia, mass))
    }

    /// Rows `i` to `i + 3` of the upper band of `K - sigma M`, the sloshing masses eliminated.
    fn banded(&self, sigma: Dd) -> Vec<[Dd; BAND + 1]> {
        let mut band = vec![[exact(0.0); BAND + 1]; self.beam.unknowns()];
        for e in 0..self.beam.elements() {
            let (stiffness, mass) = self.element(e);
            for i in 0..4 {
                for k in i..4 {
                    band[2 * e + i][k - i] += stiffness[i][k] - sigma * mass[i][k];
                }
            }
        }
        for o in self.oscillators {
            let (k, free) = (exact(o.stiffness), self.free(o, sigma));
            band[2 * o.node][0] += k - k * k / free;
        }
        band
    }

    fn free(&self, o: &Oscillator, sigma: Dd) -> Dd {
        exact(o.stiffness) - sigma * o.mass
    }

    /// L D L^T: the pivots, and the multipliers below each.
    fn factor(&self, sigma: Dd) -> Vec<[Dd; BAND + 1]> {
        let mut a = self.banded(sigma);
        for i in 0..a.len() {
            let row = a[i];
            for p in 1..=BAND.min(a.len() - 1 - i) {
                let multiplier = row[p] / row[0];
                for q in p..=BAND {
                    a[i + p][q - p] -= multiplier * row[q];
                }
                a[i][p] = multiplier;
            }
        }
        a
    }

    /// Number of eigenvalues `omega^2` below `sigma`, heave and pitch among them: Sylvester's law
    /// of inertia.
    pub fn count_below(&self, sigma: Dd) -> usize {
        let beam = self.factor(sigma).iter().filter(|row| row[0].hi < 0.0).count();
        beam + self.oscillators.iter().filter(|o| self.free(o, sigma).hi < 0.0).count()
    }

    /// `(K - sigma M)^-1 b`.
    pub fn solve(&self, sigma: Dd, b: &[Dd]) -> Vector {
        let size = self.beam.unknowns();
        let (mut x, masses) = (b[..size].to_vec(), &b[size..]);
        for (o, b) in self.oscillators.iter().zip(masses) {
            x[2 * o.node] += exact(o.stiffness) * *b / self.free(o, sigma);
        }
        let a = self.factor(sigma);
        for i in 0..size {
            for p in 1..=BAND.min(size - 1 - i) {
                x[i + p] = x[i + p] - a[i][p] * x[i];
            }
        }
        for i in (0..size).rev() {
            x[i] = x[i] / a[i][0];
            for p in 1..=BAND.min(size - 1 - i) {
                x[i] = x[i] - a[i][p] * x[i + p];
            }
        }
        for (o, b) in self.oscillators.iter().zip(masses) {
            let w = x[2 * o.node];
            x.push((*b + exact(o.stiffness) * w) / self.free(o, sigma));
        }
        x
    }

    /// `(K x, M x)`.
    pub fn products(&self, x: &[Dd]) -> (Vector, Vector) {
        let size = self.beam.unknowns();
        let (mut kx, mut mx) = (vec![exact(0.0); x.len()], vec![exact(0.0); x.len()]);
        for e in 0..self.beam.elements() {
            let (stiffness, mass) = self.element(e);
            for i in 0..4 {
                for k in 0..4 {
                    kx[2 * e + i] += stiffness[i][k] * x[2 * e + k];
                    mx[2 * e + i] += mass[i][k] * x[2 * e + k];
                }
            }
        }
        for (j, o) in self.oscillators.iter().enumerate() {
            let force = (x[size + j] - x[2 * o.node]) * o.stiffness;
            kx[size + j] = force;
            kx[2 * o.node] -= force;
            mx[size + j] = x[size + j] * o.mass;
        }
        (kx, mx)
    }

    /// The eigenpair next to `omega2`, from a start vector, by inverse iteration.
    pub fn refine(&self, omega2: f64, start: &[f64]) -> (Dd, Vector) {
        // Off the eigenvalue, so that the factorisation keeps its digits.
        let sigma = exact(omega2 * (1.0 + 1e-8));
        let mut x: Vector = start.iter().map(|x| exact(*x)).collect();
        for _ in 0..2 {
            let (_, mx) = self.products(&x);
            x = self.solve(sigma, &mx);
            let largest = x.iter().map(|x| x.hi.abs()).fold(0.0, f64::max);
            for entry in &mut x {
                *entry = *entry / largest;
            }
        }
        let (kx, mx) = self.products(&x);
        (dot(&x, &kx) / dot(&x, &mx), x)
    }
}

pub fn dot(a: &[Dd], b: &[Dd]) -> Dd {
    a.iter().zip(b).fold(exact(0.0), |sum, (x, y)| sum + *x * *y)
}
