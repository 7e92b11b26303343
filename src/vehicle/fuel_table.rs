//! The vehicle as a function of fuel, for fuel that burns in flight: cubic Hermite interpolation between
//! fuel levels.
//!
//! Frequencies cross as the tanks empty, so eigenmodes cannot be tracked one by one, but the space
//! spanned by the kept modes can. At every level its basis is the one nearest to the eigenmodes at the
//! start ([`Modes::aligned_to`]), so it depends on start and level only and is smooth. The stiffness
//! becomes a full matrix; its eigenvalues are the squares of the frequencies of the level.
//!
//! Near empty tanks the sloshing frequency falls with the square root of the filling, so the levels are
//! equally spaced in that root. Slopes at the levels are difference quotients of fourth order over five
//! levels, so the interpolation error falls with the fourth power of the spacing.

use super::airframe::{Airframe, COEFFICIENTS};
use super::assembly::VehicleDefinition;
use super::body::Body;
use crate::air::curve_fits::PerMode;
use crate::error::Error;
use crate::solve::Scalar;
use crate::structure::MODES;
#[cfg(doc)]
use crate::structure::Modes;
use crate::structure::tanks::fuel_kg_per_m;

/// Number of fuel levels.
const LEVELS: usize = 33;
/// Number of levels in a difference quotient.
const STENCIL: usize = 5;
/// Weights, times 12, of the first derivative at each of five equally spaced points, of fourth order.
const SLOPES: [[f64; STENCIL]; STENCIL] = [
    [-25.0, 48.0, -36.0, 16.0, -3.0],
    [-3.0, -10.0, 18.0, -6.0, 1.0],
    [1.0, -8.0, 0.0, 8.0, -1.0],
    [-1.0, 6.0, -18.0, 10.0, 3.0],
    [3.0, -16.0, 36.0, -48.0, 25.0],
];
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
    /// Spacing of the levels in that root.
    spacing: f64,
    /// Cubics between the levels: coefficients of the powers of the local coordinate, 0 to 1.
    pieces: Vec<[[f64; COEFFICIENTS]; 4]>,
}

/// Derivative at a level of a function known at all levels, per level.
fn slope(level: usize, at: impl Fn(usize) -> f64) -> f64 {
    let first = level.saturating_sub(STENCIL / 2).min(LEVELS - STENCIL);
    let weights = &SLOPES[level - first];
    weights.iter().enumerate().map(|(i, weight)| weight * at(first + i)).sum::<f64>() / 12.0
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
        let spacing = (start - (BELOW_EMPTY * residual).sqrt()) / (LEVELS - 1) as f64;
        let filling = [residual, drained / fuel_kg_per_m(&definition.vehicle, 1.0)];

        let level = |level: usize| {
            let root = start - spacing * level as f64;
            definition.at((root * root - residual) / drained)
        };
        let levels: Vec<VehicleDefinition> =
            std::iter::once(definition.clone()).chain((1..LEVELS).map(level)).collect();
        let mut bodies = vec![body.clone()];
        for definition in &levels[1..] {
            bodies.push(Body::new(definition)?.aligned_to(definition, body)?);
        }
        let shapes: Vec<Vec<Vec<f64>>> = bodies.iter().map(Body::displacements).collect();
        let mut rows = Vec::with_capacity(LEVELS);
        for (level, body) in bodies.iter().enumerate() {
            let root = start - spacing * level as f64;
            let levels_per_fuel = -filling[1] / (2.0 * root * spacing);
            let turning = body
                .products(&shape_derivative(level, &shapes))
                .map(|row| row.map(|entry| entry * levels_per_fuel));
            push_row(&mut rows, body, &levels[level], turning)?;
        }
        Ok(Self { filling, start, spacing, pieces: pieces(&rows) })
    }

    /// Properties at a fuel mass, kg/m; constant beyond one level outside the table.
    pub fn airframe<S: Scalar>(&self, fuel: S) -> Airframe<S> {
        let position = self.position(fuel);
        let piece = (position.value() as usize).min(self.pieces.len() - 1);
        let [c0, c1, c2, c3] = &self.pieces[piece];
        let t = position.value() - piece as f64;
        let row: [S; COEFFICIENTS] = std::array::from_fn(|i| {
            let value = ((c3[i] * t + c2[i]) * t + c1[i]) * t + c0[i];
            position.chain(value, (3.0 * c3[i] * t + 2.0 * c2[i]) * t + c1[i])
        });
        Airframe::from_row(&row)
    }

    /// Continuous index of the level, 0 at the start.
    fn position<S: Scalar>(&self, fuel: S) -> S {
        let [empty, per_fuel] = self.filling;
        let filling = fuel * per_fuel + empty;
        let [highest, lowest] =
            [-1.0, (LEVELS - 1) as f64].map(|level| self.start - self.spacing * level);
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

/// Appends an airframe. Not inlined, to limit the size of the stack frame.
#[inline(never)]
fn push_row(
    rows: &mut Vec<[f64; COEFFICIENTS]>,
    body: &Body,
    definition: &VehicleDefinition,
    turning: [PerMode; MODES],
) -> Result<(), Error> {
    let airframe = body.airframe(definition)?;
    rows.push(Airframe { turning, ..airframe }.to_row());
    Ok(())
}

/// Derivative of the shapes per level, at a level.
fn shape_derivative(level: usize, shapes: &[Vec<Vec<f64>>]) -> Vec<Vec<f64>> {
    let modes = 0..shapes[level].len();
    modes
        .map(|mode| {
            let unknowns = 0..shapes[level][mode].len();
            unknowns.map(|i| slope(level, |at| shapes[at][mode][i])).collect()
        })
        .collect()
}

/// Cubic Hermite pieces between rows.
fn pieces(rows: &[[f64; COEFFICIENTS]]) -> Vec<[[f64; COEFFICIENTS]; 4]> {
    let slopes: Vec<[f64; COEFFICIENTS]> = (0..rows.len())
        .map(|level| std::array::from_fn(|i| slope(level, |at| rows[at][i])))
        .collect();
    (0..rows.len() - 1)
        .map(|level| {
            let [y0, y1] = [&rows[level], &rows[level + 1]];
            let [m0, m1] = [&slopes[level], &slopes[level + 1]];
            let square = |i: usize| 3.0 * (y1[i] - y0[i]) - 2.0 * m0[i] - m1[i];
            let cube = |i: usize| 2.0 * (y0[i] - y1[i]) + m0[i] + m1[i];
            [*y0, *m0, std::array::from_fn(square), std::array::from_fn(cube)]
        })
        .collect()
}
