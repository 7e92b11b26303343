//! The crate diffsol with our right-hand side: its explicit method, and its implicit one with exact
//! Jacobians.

use super::rust_crates::Scaled;
use ahv::dynamics::linear::along;
use ahv::vehicle::{CONTROLS, NOMINAL, STATES, State};
use anyhow::Result;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeEquationsImplicit, OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason,
};

type Matrix = NalgebraMat<f64>;
type Vector = NalgebraVec<f64>;

/// First step, s; an initial guess as in our flights.
const FIRST_STEP_S: f64 = 1e-3;

/// Tsitouras 5(4).
pub fn tsit45(system: &Scaled, interval: [f64; 2], y: &State, tolerance: f64) -> Result<State> {
    let [start, end] = interval;
    reach(problem(system, start, y, tolerance)?.tsit45()?, end)
}

/// Backward differentiation formulas.
pub fn bdf(system: &Scaled, interval: [f64; 2], y: &State, tolerance: f64) -> Result<State> {
    let [start, end] = interval;
    reach(problem(system, start, y, tolerance)?.bdf::<NalgebraLU<f64>>()?, end)
}

fn problem(
    system: &Scaled,
    start: f64,
    y: &State,
    tolerance: f64,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<M = Matrix, V = Vector, T = f64, C = NalgebraContext>,
    >,
> {
    let change = |y: &[f64], dy: &[f64]| {
        let [x, dx] = [y, dy].map(|y| std::array::from_fn(|i| y[i] * NOMINAL[i]));
        let control = [&system.0.control, &[0.0; CONTROLS]];
        let rates = along(system.0.vehicle, [&x, &dx], control);
        std::array::from_fn::<f64, STATES, _>(|i| rates[i].eps[0] / NOMINAL[i])
    };
    Ok(OdeBuilder::<Matrix>::new()
        .t0(start)
        .rtol(tolerance)
        .atol([tolerance])
        .h0(FIRST_STEP_S)
        .p([])
        .rhs_implicit(
            |y, _, _, rates| rates.copy_from_slice(&system.rates(y)),
            move |y, _, _, dy, rates| rates.copy_from_slice(&change(y, dy)),
        )
        .init(|_, _, start| start.copy_from_slice(y), STATES)
        .build()?)
}

/// Integrates to an instant, s.
fn reach<'a, E>(mut solver: impl OdeSolverMethod<'a, E>, end: f64) -> Result<State>
where
    E: OdeEquations<T = f64, V = Vector> + 'a,
{
    solver.set_stop_time(end)?;
    while !matches!(solver.step()?, OdeSolverStopReason::TstopReached) {}
    let state = solver.state();
    Ok(std::array::from_fn(|i| state.y[i]))
}
