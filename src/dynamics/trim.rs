//! Trim: controls and static deflections of steady flight, by Newton's method with exact derivatives.

use super::linear::directional_derivative;
use crate::error::{Error, LimitedKind, LimitedQuantity};
use crate::solve::Dual;
use crate::structure::MODES;
use crate::vehicle::{
    ALPHA, Condition, Control, FUEL, GAMMA, Q, STATES, State, V, Vehicle, eta, eta_dot,
};
use nalgebra::{SMatrix, SVector};

/// Steady flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trim {
    /// State with all accelerations zero.
    pub state: State,
    /// Controls that hold it.
    pub control: Control,
}

/// alpha, delta_e, phi and the modal coordinates.
const UNKNOWNS: usize = FIRST_ETA + MODES;
/// Index of the first modal coordinate among the unknowns.
const FIRST_ETA: usize = 3;
/// Limit of Newton's iteration; about five steps are usual.
const MAX_STEPS: usize = 40;
/// Largest scaled residual (accelerations relative to free fall) of a trim. Rounding leaves about 1e-15.
const CONVERGED: f64 = 1e-11;
/// Magnitude of an unknown, rad or m, at which Newton's iteration has diverged.
const DIVERGED: f64 = 1e6;
/// State derivatives that must vanish, with their scale in free fall (m/s^2, rad/s, rad/s^2).
const BALANCES: [(usize, f64); 3] = [(V, 10.0), (GAMMA, 0.004), (Q, 1.0)];

type Vector = SVector<f64, UNKNOWNS>;

/// State and controls from the unknowns and the known components of the state.
fn insert(known: &State, z: &Vector) -> (State, Control) {
    let mut x = *known;
    let [alpha, delta_e, phi, ..] = z.data.0[0];
    x[ALPHA] = alpha;
    for i in 0..MODES {
        x[eta(i)] = z[FIRST_ETA + i];
    }
    (x, [delta_e, phi])
}

/// Scaled residual of the trim equations and its exact Jacobian.
fn residual(
    vehicle: &Vehicle,
    start: &State,
    z: &Vector,
) -> (Vector, SMatrix<f64, UNKNOWNS, UNKNOWNS>) {
    let (x, u) = insert(start, z);
    let (mut value, mut jacobian) = (Vector::zeros(), SMatrix::identity());
    for column in 0..UNKNOWNS {
        let (dx, du) = insert(&[0.0; STATES], &Vector::from_fn(|i, _| f64::from(i == column)));
        let rates = directional_derivative(vehicle, [&x, &dx], [&u, &du]);
        let mut put = |row: usize, rate: Dual<1>, scale: f64| {
            value[row] = rate.re / scale;
            jacobian[(row, column)] = rate.eps[0] / scale;
        };
        for (row, (state, scale)) in BALANCES.into_iter().enumerate() {
            put(row, rates[state], scale);
        }
        for i in 0..vehicle.modes {
            put(FIRST_ETA + i, rates[eta_dot(i)], vehicle.omega[i] * vehicle.omega[i]);
        }
    }
    (value, jacobian)
}

/// Steady flight at a condition.
///
/// # Errors
/// [`Error::Trim`] with the residual and the limit that was hit, when no control within the limits
/// of actuators and curve fits holds the condition; [`Error::NotFinite`] if the equations have no value.
pub fn trim(vehicle: &Vehicle, condition: &Condition) -> Result<Trim, Error> {
    let mut start = condition.start(&vehicle.atmosphere);
    start[FUEL] = vehicle.fuel;
    let mut z = Vector::zeros();
    let mut best = f64::INFINITY;
    let mut solution = z;
    for step in 0..MAX_STEPS {
        let (value, jacobian) = residual(vehicle, &start, &z);
        if step == 0 && !value.iter().all(|rate| rate.is_finite()) {
            let Condition { mach, altitude: altitude_m, .. } = *condition;
            return Err(Error::NotFinite { mach, altitude_m });
        }
        let size = value.amax();
        // Converged to rounding once the residual stops falling.
        if !size.is_finite() || (best < CONVERGED && size >= best) {
            break;
        }
        if size < best {
            best = size;
            solution = z;
        }
        let Some(step) = jacobian.lu().solve(&value) else { break };
        z -= step;
        if z.amax() >= DIVERGED {
            break;
        }
    }

    let envelope = &vehicle.aero.envelope;
    let outside = |kind, value, limits: [f64; 2]| {
        let [min, max] = limits;
        (!(min..=max).contains(&value)).then_some(LimitedQuantity { kind, value, limits })
    };
    let mut limit = outside(LimitedKind::Mach, condition.mach, envelope.mach)
        .or_else(|| outside(LimitedKind::Altitude, condition.altitude, envelope.altitude));
    let [elevator, fuel] = vehicle.limits;
    let unknowns = [
        (LimitedKind::Incidence, envelope.alpha),
        (LimitedKind::Elevator, [-elevator, elevator]),
        (LimitedKind::FuelRatio, [0.0, fuel]),
    ];
    let steady = best < CONVERGED;
    let mut possible = steady && limit.is_none();
    let mut limited = solution;
    for (i, (kind, limits)) in unknowns.into_iter().enumerate() {
        let Some(beyond) = outside(kind, solution[i], limits) else { continue };
        possible = false;
        limited[i] = solution[i].clamp(limits[0], limits[1]);
        // The last point of a diverged iteration tells nothing.
        if steady {
            limit = limit.or(Some(beyond));
        }
    }
    if !possible {
        let (value, _) = residual(vehicle, &start, &limited);
        return Err(Error::Trim {
            mach: condition.mach,
            altitude_m: condition.altitude,
            gamma_rad: condition.gamma,
            residual: value.amax(),
            limit,
        });
    }

    let (state, control) = insert(&start, &solution);
    Ok(Trim { state, control })
}
