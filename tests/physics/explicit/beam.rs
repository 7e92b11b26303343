//! Finite elements of its own: the bending body with two sloshing masses, all nodes, no modes.

use super::books::{Books, Liquid, spread};
use ahv::data::VehicleData;
use nalgebra::{DMatrix, DVector};

/// A place on the beam: what deflection and slope there are of a displacement.
pub struct Place {
    pub x: f64,
    /// Share of an integral, m.
    pub weight: f64,
    pub w: DVector<f64>,
    pub slope: DVector<f64>,
}

/// Displacement: deflection and slope of each node from the nose, then each sloshing mass, up.
pub struct Beam {
    pub element_m: f64,
    /// kg/m^2, of structure and frozen liquid.
    pub density: Vec<f64>,
    /// EI, N m^2/m.
    pub bending: Vec<f64>,
    pub liquids: [Liquid; 2],
    /// Mass centre of structure and frozen liquid by density.
    pub centre: f64,
    /// First moment about that centre, kg, and second moment, kg m^2/m, that density does not give.
    pub added: [f64; 2],
    /// Mean translation and mean slope of a displacement of the beam.
    pub heave: DVector<f64>,
    pub turn: DVector<f64>,
}

/// Places and weights of Gauss's rule of three points on 0 to 1: exact to the fifth power.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

fn table(stations: &[f64], values: &[f64], x: f64) -> f64 {
    let next = stations.iter().position(|s| *s >= x).unwrap_or(stations.len() - 1).max(1);
    let part = (x - stations[next - 1]) / (stations[next] - stations[next - 1]);
    values[next - 1] * (1.0 - part) + values[next] * part
}

impl Beam {
    /// Of a number of equal elements, with the mass centre and the inertia that the books want.
    pub fn new(data: &VehicleData, books: &Books, elements: usize, stiffness: f64) -> Self {
        let element_m = data.geometry.length_m.value / elements as f64;
        let masses = spread(data, &books.liquids, elements);
        let density = masses.iter().map(|mass| mass / element_m).collect();
        let (stations, values) =
            (&data.beam.stiffness_station_m.value, &data.beam.stiffness_n_m2_per_m.value);
        let middle = |e: usize| (e as f64 + 0.5) * element_m;
        let bending = (0..elements).map(|e| stiffness * table(stations, values, middle(e)));
        let mass: f64 = masses.iter().sum();
        let centre = (0..elements).map(|e| masses[e] * middle(e)).sum::<f64>() / mass;
        let own = element_m * element_m / 12.0;
        let inertia: f64 =
            (0..elements).map(|e| masses[e] * ((middle(e) - centre).powi(2) + own)).sum();

        // The body of all less the sloshing masses, about the centre by density.
        let total = &books.total;
        let arms = books.liquids.map(|l| [l.sloshing, l.station - total.centre]);
        let first = -arms.iter().map(|[mass, arm]| mass * arm).sum::<f64>();
        let second = total.inertia - arms.iter().map(|[mass, arm]| mass * arm * arm).sum::<f64>();
        let off = total.centre - centre;
        let added = [first + mass * off, second + 2.0 * first * off + mass * off * off - inertia];
        let mut beam = Self {
            element_m,
            bending: bending.collect(),
            density,
            liquids: books.liquids,
            centre,
            added,
            heave: DVector::zeros(0),
            turn: DVector::zeros(0),
        };
        beam.heave = beam.density_times(&beam.rigid(1.0, 0.0, centre)) / mass;
        beam.turn = beam.density_times(&beam.rigid(0.0, 1.0, centre)) / inertia;
        beam
    }

    fn nodes(&self) -> usize {
        2 * (self.density.len() + 1)
    }

    pub fn unknowns(&self) -> usize {
        self.nodes() + 2
    }

    /// Everything, liquid as well, moved up and turned nose down about a station.
    pub fn rigid(&self, up: f64, slope: f64, about: f64) -> DVector<f64> {
        DVector::from_fn(self.unknowns(), |row, _| {
            let at = |x: f64| up + slope * (x - about);
            match row.checked_sub(self.nodes()) {
                Some(tank) => at(self.liquids[tank].station),
                None if row % 2 == 0 => at((row / 2) as f64 * self.element_m),
                None => slope,
            }
        })
    }

    /// Cubic functions of the element that a station is in.
    pub fn place(&self, x: f64, weight: f64) -> Place {
        let l = self.element_m;
        let e = ((x / l) as usize).min(self.density.len() - 1);
        let s = x / l - e as f64;
        let (mut w, mut slope) = (DVector::zeros(self.unknowns()), DVector::zeros(self.unknowns()));
        let cubics = [
            [1.0 - 3.0 * s * s + 2.0 * s * s * s, (6.0 * s * s - 6.0 * s) / l],
            [l * (s - 2.0 * s * s + s * s * s), 1.0 - 4.0 * s + 3.0 * s * s],
            [3.0 * s * s - 2.0 * s * s * s, (6.0 * s - 6.0 * s * s) / l],
            [l * (s * s * s - s * s), 3.0 * s * s - 2.0 * s],
        ];
        for (k, [value, derivative]) in cubics.into_iter().enumerate() {
            (w[2 * e + k], slope[2 * e + k]) = (value, derivative);
        }
        Place { x, weight, w, slope }
    }

    /// Places of an integral from one station to another; a station alone counts as a unit.
    pub fn places(&self, from: f64, to: f64) -> Vec<Place> {
        if from == to {
            return vec![self.place(from, 1.0)];
        }
        let mut places = Vec::new();
        for e in 0..self.density.len() {
            let start = e as f64 * self.element_m;
            let (a, b) = (from.max(start), to.min(start + self.element_m));
            if a < b {
                places.extend(
                    GAUSS.map(|[part, share]| self.place(a + part * (b - a), share * (b - a))),
                );
            }
        }
        places
    }

    /// By the consistent mass matrix of the densities, without liquid that sloshes.
    fn density_times(&self, v: &DVector<f64>) -> DVector<f64> {
        let mut product = DVector::zeros(self.unknowns());
        let l = self.element_m;
        let entries = [
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ];
        for (e, density) in self.density.iter().enumerate() {
            for (i, row) in entries.iter().enumerate() {
                let sum: f64 = row.iter().enumerate().map(|(k, entry)| entry * v[2 * e + k]).sum();
                product[2 * e + i] += sum * density * l / 420.0;
            }
        }
        product
    }

    /// By the mass matrix of all.
    pub fn mass_times(&self, v: &DVector<f64>) -> DVector<f64> {
        let [first, second] = self.added;
        let (moved, turned) = (self.heave.dot(v), self.turn.dot(v));
        let mut product = self.density_times(v);
        product += &self.heave * (first * turned) + &self.turn * (first * moved + second * turned);
        for (tank, liquid) in self.liquids.iter().enumerate() {
            let row = self.nodes() + tank;
            product[row] += liquid.sloshing * v[row];
        }
        product
    }

    /// Mass matrix of all.
    pub fn mass(&self) -> DMatrix<f64> {
        let unit = |k: usize| DVector::from_fn(self.unknowns(), |i, _| f64::from(i == k));
        let columns: Vec<_> = (0..self.unknowns()).map(|k| self.mass_times(&unit(k))).collect();
        DMatrix::from_columns(&columns)
    }

    /// Energy of bending and springs, J/m. By the ends' turns against the chord: the products of the
    /// stiffness matrix would lose it among deflections.
    pub fn strain_energy(&self, u: &DVector<f64>) -> f64 {
        let element = |(e, bending): (usize, &f64)| {
            let chord = (u[2 * e + 2] - u[2 * e]) / self.element_m;
            let [a, b] = [u[2 * e + 1] - chord, u[2 * e + 3] - chord];
            2.0 * bending / self.element_m * (a * a + a * b + b * b)
        };
        let springs = self.liquids.iter().enumerate();
        let springs = springs.map(|(tank, l)| 0.5 * l.spring * self.stretch(tank).dot(u).powi(2));
        self.bending.iter().enumerate().map(element).sum::<f64>() + springs.sum::<f64>()
    }

    /// Stretch of a tank's spring.
    pub fn stretch(&self, tank: usize) -> DVector<f64> {
        let mut stretch = -self.place(self.liquids[tank].station, 0.0).w;
        stretch[self.nodes() + tank] = 1.0;
        stretch
    }

    /// Stiffness of bending and springs, and dampers.
    pub fn springs(&self) -> [DMatrix<f64>; 2] {
        let mut matrix = DMatrix::zeros(self.unknowns(), self.unknowns());
        let l = self.element_m;
        for (e, bending) in self.bending.iter().enumerate() {
            // Turns of both ends against the chord, by deflections and slopes.
            let ends = [[1.0 / l, 1.0, -1.0 / l, 0.0], [1.0 / l, 0.0, -1.0 / l, 1.0]];
            for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let factor = bending / l * if i == k { 4.0 } else { 2.0 };
                for (a, left) in ends[i].iter().enumerate() {
                    for (b, right) in ends[k].iter().enumerate() {
                        matrix[(2 * e + a, 2 * e + b)] += factor * left * right;
                    }
                }
            }
        }
        let mut dampers = DMatrix::zeros(self.unknowns(), self.unknowns());
        for (tank, liquid) in self.liquids.iter().enumerate() {
            let stretch = self.stretch(tank);
            let square = &stretch * stretch.transpose();
            matrix += &square * liquid.spring;
            dampers += square * liquid.damper;
        }
        [matrix, dampers]
    }
}
