//! Modes that are made up: rigid motions and a parabola, with what the air answers to them by hand.

use crate::model::{AERO_SETS, data};
use ahv::air::curve_fits::{Aero, DRAG, ELASTIC_ROWS, Elastic, INFLOW, LIFT, MODAL_FORCE, MOMENT};
use ahv::air::strip_theory::{StripIntegrals, elastic_derivatives};
use ahv::data::{AeroSet, Data};
use ahv::structure::{Beam, MODES, Modes, Shape};

/// Sums over 2,000 quadrature points.
pub const ROUNDING: f64 = 1e-12;
/// Closed integrals against sums over 500 elements, of terms a hundred times as large as what is left.
pub const BY_HAND: f64 = 1e-10;
/// Mass centre against the moment centre, m aft.
pub const SHIFTS: [f64; 3] = [0.0, 2.5, -1.2];
/// The made-up modes.
pub const HEAVE: usize = 0;
pub const PITCH: usize = 1;
pub const BEND: usize = 2;

/// Powers of the station, m from the nose.
#[derive(Clone)]
pub struct Powers(pub Vec<f64>);

impl Powers {
    pub fn times(&self, other: &Self) -> Self {
        let mut product = vec![0.0; self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (k, b) in other.0.iter().enumerate() {
                product[i + k] += a * b;
            }
        }
        Self(product)
    }

    pub fn minus(&self, factor: f64, other: &Self) -> Self {
        let length = self.0.len().max(other.0.len());
        let at = |powers: &[f64], i: usize| powers.get(i).copied().unwrap_or(0.0);
        Self((0..length).map(|i| at(&self.0, i) - factor * at(&other.0, i)).collect())
    }

    pub fn slope(&self) -> Self {
        Self((1..self.0.len()).map(|i| i as f64 * self.0[i]).chain([0.0]).collect())
    }

    pub fn at(&self, x: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// Average over an interval, or what is at a place.
    pub fn mean(&self, [from, to]: [f64; 2]) -> f64 {
        if from == to {
            return self.at(from);
        }
        let whole = Self([0.0].into_iter().chain(self.0.clone()).collect());
        let whole = Self(whole.0.iter().enumerate().map(|(i, c)| c / i.max(1) as f64).collect());
        (whole.at(to) - whole.at(from)) / (to - from)
    }
}

pub fn from(place: f64) -> Powers {
    Powers(vec![-place, 1.0])
}

pub fn unit() -> Powers {
    Powers(vec![1.0])
}

/// Elastic terms of three made-up modes of unit modal mass: heave, nose-down pitch about the moment
/// centre (w up, slope dw/dx = 1) and a parabola, which also moves the body.
pub struct Case {
    pub data: Data,
    pub aero: Aero,
    pub elastic: Elastic,
    pub shapes: [Powers; 3],
    /// Station of the mass centre.
    pub centre: f64,
}

pub fn case(set: AeroSet, shift: f64, pitch_rate: f64) -> Case {
    let data = data();
    let aero = Aero::new(data.aero(set));
    let beam = Beam::even(&data.vehicle, 1.0);
    let arm = from(aero.moment_centre);
    let square = Powers(arm.times(&arm).0.iter().map(|c| c / 100.0).collect());
    let shapes = [unit(), arm, square];
    let shape = |powers: &Powers| {
        let nodes = || (0..=beam.elements()).map(|i| beam.station(i));
        let slope = powers.slope();
        Shape {
            w: nodes().map(|x| powers.at(x)).collect(),
            slope: nodes().map(|x| slope.at(x)).collect(),
        }
    };
    let shape = shapes.iter().map(shape).collect();
    let modes = Modes { count: 3, modal_mass: [1.0; MODES], shape, ..Modes::default() };
    let centre = aero.moment_centre + shift;
    let strips = StripIntegrals::new(&beam, &modes, &data.vehicle.geometry);
    let elastic = elastic_derivatives(&aero, &beam, &modes, &strips, centre, pitch_rate);
    Case { data, aero, elastic, shapes, centre }
}

impl Case {
    pub fn slope(&self, row: usize) -> f64 {
        let aero = &self.aero;
        aero.fits.row(row).slope(aero.elastic_alpha, aero.elastic_delta_e)
    }

    /// Where each surface is and its lift slope: two strips with lift slope and moment slope of the
    /// published body, and the elevator where its lift makes the published moment.
    pub fn surfaces(&self) -> [([f64; 2], f64); 3] {
        let (aero, geometry) = (&self.aero, &self.data.vehicle.geometry);
        let at = aero.elastic_delta_e;
        let [elevator, elevator_moment] = [LIFT, MOMENT].map(|row| {
            let [d1, _, d3] = aero.fits.row(row).delta_e;
            d1 + 3.0 * d3 * at * at
        });
        let (lift, moment) = (self.slope(LIFT) - elevator, self.slope(MOMENT) - elevator_moment);
        let (cut, length) = (geometry.fore_body_m.value, geometry.length_m.value);
        let [x1, x2] = [0.5 * cut, 0.5 * (cut + length)].map(|x| x - aero.moment_centre);
        // Cramer's rule.
        let [fore, aft] = [lift * x2 + moment * aero.chord, -moment * aero.chord - lift * x1];
        let place = aero.moment_centre - aero.chord * elevator_moment / elevator;
        [
            ([0.0, cut], fore / (x2 - x1)),
            ([cut, length], aft / (x2 - x1)),
            ([place, place], elevator),
        ]
    }

    /// What the air answers to a field of incidence.
    pub fn answer(&self, field: &Powers) -> [f64; ELASTIC_ROWS] {
        let surfaces = self.surfaces();
        let sum = |of: &Powers| -> f64 {
            surfaces.iter().map(|(span, slope)| slope * field.times(of).mean(*span)).sum()
        };
        let mut rows = [0.0; ELASTIC_ROWS];
        rows[LIFT] = sum(&unit());
        rows[DRAG] = self.slope(DRAG) / self.slope(LIFT) * rows[LIFT];
        rows[MOMENT] = -sum(&from(self.aero.moment_centre)) / self.aero.chord;
        rows[INFLOW] = field.mean(surfaces[0].0);
        for (i, shape) in self.shapes.iter().enumerate() {
            rows[MODAL_FORCE + i] = sum(shape);
        }
        rows
    }

    /// What is large where rows cancel.
    pub fn sizes(&self) -> [f64; ELASTIC_ROWS] {
        let length = self.data.vehicle.geometry.length_m.value;
        let uniform = self.answer(&unit());
        let far = self.answer(&from(-length));
        std::array::from_fn(|row| uniform[row].abs().max(far[row].abs()).max(1.0))
    }

    pub fn assert_rows(
        &self,
        what: &str,
        rows: &[f64; ELASTIC_ROWS],
        expected: &[f64; ELASTIC_ROWS],
        limit: f64,
    ) {
        for (row, size) in self.sizes().into_iter().enumerate() {
            let off = (rows[row] - expected[row]) / size;
            assert!(off.abs() < limit, "{what}, row {row}: {rows:?}, not {expected:?}: {off:.1e}");
        }
    }
}

pub fn cases(pitch_rate: f64) -> impl Iterator<Item = (String, Case)> {
    AERO_SETS.into_iter().flat_map(move |set| {
        SHIFTS.map(|shift| (format!("{set:?}, {shift} m"), case(set, shift, pitch_rate)))
    })
}
