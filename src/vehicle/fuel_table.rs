//! The vehicle as a function of fuel, for fuel that burns in flight.
//!
//! Frequencies cross as the tanks empty, so eigenmodes cannot be tracked one by one, but the space
//! spanned by the kept modes can. At every level its basis is the one nearest to the eigenmodes at the
//! start ([`Modes::aligned_to`]), so it depends on start and level only and is analytic. The stiffness
//! becomes a full matrix; its eigenvalues are the squares of the frequencies of the level.
//!
//! One polynomial through the levels at which the modes are solved ([`Chebyshev`]) gives every property and,
//! differentiated, the turning of the shapes. In flight cubic pieces with its values and slopes at their
//! ends take its place, as they take fewer operations.
//!
//! # Coordinate
//!
//! Near empty tanks the frequencies of the liquid and with them the damping fall with the root r of the
//! filling, so all is analytic in r. Mass and frequency of the liquid depend on tanh(pi h/b)
//! ([`tanks`](crate::structure::tanks)), whose poles nearest to the real fillings are at the depth h = i b/2
//! and its conjugate: at r = a (1 + i) and a (1 - i), with 2 a^2 = b/(2 h_full). The polynomial is one in
//!
//! ```text
//! u = asinh((r - a)/a)
//! ```
//!
//! where these poles are at i pi/2 and -i pi/2 whatever a is; of the two tanks the one with the smaller a
//! counts. 17 levels then do what 25 do in r.

use super::airframe::{Airframe, COEFFICIENTS};
use super::assembly::VehicleDefinition;
use super::body::Body;
use crate::data::TankData;
use crate::error::Error;
use crate::solve::{Chebyshev, Scalar};
#[cfg(doc)]
use crate::structure::Modes;
use crate::structure::tanks::fuel_kg_per_m;

/// Number of fuel levels at which the modes are solved.
const LEVELS: usize = 17;
/// Number of cubic pieces.
const PIECES: usize = 64;
/// Lowest level, as a fraction of the residual propellant: trial steps of an integrator go slightly below
/// empty tanks.
const BELOW_EMPTY: f64 = 0.5;

/// A vehicle at all fuel levels up to that of its start.
#[derive(Debug, Clone)]
pub struct FuelTable {
    /// Filling without fuel, and its slope with the fuel mass, m/kg.
    filling: [f64; 2],
    /// Square root of the filling at the start.
    start: f64,
    /// Length of a piece in that root.
    spacing: f64,
    /// Cubics in the order of falling fuel: coefficients of the powers of the local coordinate, 0 to 1.
    pieces: Vec<[[f64; COEFFICIENTS]; 4]>,
}

/// The coordinate of the polynomial: u, scaled to 1 at the start and -1 at the lowest level.
struct Coordinate {
    /// a: real part of the poles.
    pole: f64,
    middle: f64,
    half: f64,
}

impl Coordinate {
    fn new(definition: &VehicleDefinition, start: f64, lowest: f64) -> Self {
        let pole =
            |tank: &TankData| (0.25 * tank.bay_length_m.value / tank.depth_full_m.value).sqrt();
        let [fore, aft] = &definition.vehicle.tank;
        let pole = pole(fore).min(pole(aft));
        let [start, lowest] = [start, lowest].map(|root| libm::asinh((root - pole) / pole));
        Self { pole, middle: 0.5 * (start + lowest), half: 0.5 * (start - lowest) }
    }

    /// The coordinate of a root of the filling, and its slope.
    fn at(&self, root: f64) -> [f64; 2] {
        let along = root - self.pole;
        let slope = 1.0 / (along * along + self.pole * self.pole).sqrt();
        [(libm::asinh(along / self.pole) - self.middle) / self.half, slope / self.half]
    }

    /// Inverse of [`Coordinate::at`].
    fn root(&self, coordinate: f64) -> f64 {
        self.pole * (1.0 + libm::sinh(self.middle + self.half * coordinate))
    }
}

impl FuelTable {
    /// Computes a vehicle, whose body at the start is known, at all levels.
    ///
    /// # Errors
    /// Those of [`Body::new`]; [`Error::ModesNotFollowed`] if the modes cannot be followed.
    pub fn new(definition: &VehicleDefinition, body: &Body) -> Result<Self, Error> {
        let residual = definition.vehicle.mass.residual_fraction.value;
        let drained = 1.0 - residual;
        let start = (residual + drained * definition.options.fuel_fraction).sqrt();
        let lowest = (BELOW_EMPTY * residual).sqrt();
        let filling = [residual, drained / fuel_kg_per_m(&definition.vehicle, 1.0)];
        let coordinate = Coordinate::new(definition, start, lowest);
        let chebyshev = Chebyshev::<LEVELS>::new();

        let mut definitions = vec![definition.clone()];
        let mut bodies = vec![body.clone()];
        for point in &chebyshev.points[1..] {
            let root = coordinate.root(*point);
            let level = definition.at((root * root - residual) / drained);
            bodies.push(Body::aligned(&level, body)?);
            definitions.push(level);
        }
        let shapes: Vec<Vec<Vec<f64>>> = bodies.iter().map(Body::displacements).collect();
        let mut rows = Vec::with_capacity(LEVELS);
        for ((definition, body), point) in definitions.iter().zip(&bodies).zip(chebyshev.points) {
            let [_, weights] = chebyshev.weights(point);
            let root = coordinate.root(point);
            let per_fuel = coordinate.at(root)[1] * filling[1] / (2.0 * root);
            let slopes = shape_slopes(&weights.map(|weight| weight * per_fuel), &shapes);
            push_row(&mut rows, body, definition, &slopes)?;
        }

        let spacing = (start - lowest) / PIECES as f64;
        let mut ends: Vec<[[f64; COEFFICIENTS]; 2]> = (0..=PIECES)
            .map(|end| {
                let [x, slope] = coordinate.at(start - spacing * end as f64);
                let [value, change] = chebyshev.weights(x);
                [value, change.map(|weight| -spacing * slope * weight)]
                    .map(|weights| combined(&weights, &rows))
            })
            .collect();
        // Without rounding, the start is the vehicle that does not burn.
        ends[0][0] = rows[0];
        Ok(Self { filling, start, spacing, pieces: ends.windows(2).map(cubic).collect() })
    }

    /// Properties at a fuel mass, kg/m; constant beyond one piece outside the table.
    pub fn airframe<S: Scalar>(&self, fuel: S) -> Airframe<S> {
        let position = self.position(fuel);
        let piece = (position.value() as usize).min(PIECES - 1);
        let [c0, c1, c2, c3] = &self.pieces[piece];
        let t = position.value() - piece as f64;
        let row: [S; COEFFICIENTS] = std::array::from_fn(|i| {
            let value = ((c3[i] * t + c2[i]) * t + c1[i]) * t + c0[i];
            position.chain(value, (3.0 * c3[i] * t + 2.0 * c2[i]) * t + c1[i])
        });
        Airframe::from_row(&row)
    }

    /// Continuous index of the piece, 0 at the start.
    fn position<S: Scalar>(&self, fuel: S) -> S {
        let [empty, per_fuel] = self.filling;
        let filling = fuel * per_fuel + empty;
        let [highest, lowest] = [-1.0, PIECES as f64].map(|end| self.start - self.spacing * end);
        // NaN counts as empty.
        let root = if filling.value() >= highest * highest {
            S::constant(highest)
        } else if filling.value() > lowest * lowest {
            filling.sqrt()
        } else {
            S::constant(lowest)
        };
        -(root - self.start) * (1.0 / self.spacing)
    }
}

/// Appends an airframe, with the turning of its shapes from their slopes by the fuel. Not inlined, to limit
/// the size of the stack frame.
#[inline(never)]
fn push_row(
    rows: &mut Vec<[f64; COEFFICIENTS]>,
    body: &Body,
    definition: &VehicleDefinition,
    slopes: &[Vec<f64>],
) -> Result<(), Error> {
    let airframe = body.airframe(definition)?;
    rows.push(Airframe { turning: body.products(slopes), ..airframe }.to_row());
    Ok(())
}

/// Sum of the shapes of all levels with these weights.
fn shape_slopes(weights: &[f64; LEVELS], shapes: &[Vec<Vec<f64>>]) -> Vec<Vec<f64>> {
    let mut slopes: Vec<Vec<f64>> = shapes[0].iter().map(|shape| vec![0.0; shape.len()]).collect();
    for (weight, shapes) in weights.iter().zip(shapes) {
        for (slope, shape) in slopes.iter_mut().zip(shapes) {
            slope.iter_mut().zip(shape).for_each(|(slope, u)| *slope += weight * u);
        }
    }
    slopes
}

/// Sum of rows with these weights.
fn combined(weights: &[f64; LEVELS], rows: &[[f64; COEFFICIENTS]]) -> [f64; COEFFICIENTS] {
    let mut sum = [0.0; COEFFICIENTS];
    for (weight, row) in weights.iter().zip(rows) {
        sum.iter_mut().zip(row).for_each(|(sum, entry)| *sum += weight * entry);
    }
    sum
}

/// The cubic with these values and slopes at two ends.
fn cubic(ends: &[[[f64; COEFFICIENTS]; 2]]) -> [[f64; COEFFICIENTS]; 4] {
    let [y0, m0] = &ends[0];
    let [y1, m1] = &ends[1];
    let square = |i: usize| 3.0 * (y1[i] - y0[i]) - 2.0 * m0[i] - m1[i];
    let cube = |i: usize| 2.0 * (y0[i] - y1[i]) + m0[i] + m1[i];
    [*y0, *m0, std::array::from_fn(square), std::array::from_fn(cube)]
}
