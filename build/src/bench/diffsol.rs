//! The crate diffsol on our right-hand sides: its explicit method, and its implicit one with exact
//! Jacobians.

use crate::methods::{FLIGHT_S, Law};
use ahv::dynamics::{NOMINAL, STATES, State, Vehicle};
use ahv::scalar::{Dual, Scalar};
use ahv::trim::Trim;
use anyhow::Result;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverStopReason,
};
use std::cell::Cell;

/// First step, s: as in our flights only a guess.
const FIRST_STEP_S: f64 = 1e-3;

/// Tsitouras 5(4).
pub fn tsit45(
    vehicle: &Vehicle,
    trim: &Trim,
    steps: usize,
    law: &Law,
    tolerance: f64,
) -> Result<(State, usize)> {
    fly(vehicle, trim, steps, law, tolerance, false)
}

/// Backward differentiation formulas.
pub fn bdf(
    vehicle: &Vehicle,
    trim: &Trim,
    steps: usize,
    law: &Law,
    tolerance: f64,
) -> Result<(State, usize)> {
    fly(vehicle, trim, steps, law, tolerance, true)
}

/// Final state and right-hand sides; the integration starts anew at each communication point. The state
/// is over its nominal values, so that one absolute tolerance is that of our flights.
fn fly(
    vehicle: &Vehicle,
    trim: &Trim,
    steps: usize,
    law: &Law,
    tolerance: f64,
    implicit: bool,
) -> Result<(State, usize)> {
    let (mut x, calls) = (trim.state, Cell::new(0));
    for step in 0..steps {
        let [elevator, phi] = trim.control;
        let control = [elevator + law.elevator(step, steps, &x), phi];
        let rates = |y: &[f64], rates: &mut [f64]| {
            calls.set(calls.get() + 1);
            let x = std::array::from_fn(|i| y[i] * NOMINAL[i]);
            let derivatives = vehicle.derivatives(&x, &control, 0.0);
            (0..STATES).for_each(|i| rates[i] = derivatives[i] / NOMINAL[i]);
        };
        let change = |y: &[f64], along: &[f64], change: &mut [f64]| {
            let x = std::array::from_fn(|i| Dual {
                re: y[i] * NOMINAL[i],
                eps: [along[i] * NOMINAL[i]],
            });
            let control = control.map(Dual::<1>::constant);
            let derivatives = vehicle.derivatives(&x, &control, Dual::constant(0.0));
            (0..STATES).for_each(|i| change[i] = derivatives[i].eps[0] / NOMINAL[i]);
        };
        let start = |y: &mut [f64]| (0..STATES).for_each(|i| y[i] = x[i] / NOMINAL[i]);
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol(tolerance)
            .atol([tolerance])
            .h0(FIRST_STEP_S)
            .p([])
            .rhs_implicit(|y, _, _, dy| rates(y, dy), |y, _, _, along, dy| change(y, along, dy))
            .init(|_, _, y| start(y), STATES)
            .build()?;
        let end = FLIGHT_S / steps as f64;
        x = match implicit {
            true => reach(problem.bdf::<NalgebraLU<f64>>()?, end)?,
            false => reach(problem.tsit45()?, end)?,
        };
    }
    Ok((x, calls.get()))
}

/// The state at an instant, s.
fn reach<'a, E>(mut solver: impl OdeSolverMethod<'a, E>, end: f64) -> Result<State>
where
    E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'a,
{
    solver.set_stop_time(end)?;
    while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
    let state = solver.state();
    Ok(std::array::from_fn(|i| state.y[i] * NOMINAL[i]))
}
