//! A solver for fmi-rs. Its own CVODE comes with a download of SUNDIALS, which a build may not make.

use fmi_rs::sim::SimulationError;
use fmi_rs::sim::solver::{Dae, Ode, Solver, SolverFactory};
use std::mem::replace;

/// Steps of the midpoint rule, from which it is extrapolated to order 12.
const SUBSTEPS: [usize; 6] = [2, 4, 6, 8, 10, 12];
/// A step may not be longer, s: then its error is smaller than the rounding.
const STEP_S: f64 = 0.0025;

/// Makes solvers after Gragg, Bulirsch and Stoer.
pub struct Extrapolation;

impl SolverFactory for Extrapolation {
    fn create<'a, T: Ode + 'a, D: Dae + 'a>(
        &self,
        time: f64,
        _tolerance: f64,
        ode: T,
        _dae: Option<D>,
    ) -> Result<Box<dyn Solver + 'a>, SimulationError> {
        let mut solver = Extrapolator { states: vec![0.0; ode.nx()], ode, time };
        solver.reset(time)?;
        Ok(Box::new(solver))
    }
}

struct Extrapolator<T> {
    ode: T,
    time: f64,
    states: Vec<f64>,
}

impl<T: Ode> Extrapolator<T> {
    /// Derivatives at a distance from the states.
    ///
    /// At the time where the step begins: at its end fmi-rs would already set the inputs that
    /// follow a jump, and nothing but the inputs depends on the time.
    fn rates(&self, distance: &[f64]) -> Result<Vec<f64>, SimulationError> {
        let states: Vec<f64> = self.states.iter().zip(distance).map(|(x, d)| x + d).collect();
        let mut rates = vec![0.0; states.len()];
        self.ode.f(self.time, &states, &mut rates)?;
        Ok(rates)
    }

    /// How far the states move in a time, by the midpoint rule.
    fn midpoint(&self, length: f64, substeps: usize) -> Result<Vec<f64>, SimulationError> {
        let h = length / substeps as f64;
        let mut before = vec![0.0; self.states.len()];
        let mut now: Vec<f64> = self.rates(&before)?.iter().map(|rate| h * rate).collect();
        for _ in 1..substeps {
            let rates = self.rates(&now)?;
            let next = before.iter().zip(rates).map(|(d, rate)| d + 2.0 * h * rate).collect();
            before = replace(&mut now, next);
        }
        Ok(now)
    }

    fn advance(&mut self, length: f64) -> Result<(), SimulationError> {
        let mut column: Vec<Vec<f64>> = Vec::new();
        for (row, substeps) in SUBSTEPS.into_iter().enumerate() {
            let mut better = self.midpoint(length, substeps)?;
            for (last, coarser) in column.iter_mut().zip(SUBSTEPS[..row].iter().rev()) {
                let weight = 1.0 / ((substeps as f64 / *coarser as f64).powi(2) - 1.0);
                let next = better.iter().zip(&*last).map(|(b, l)| b + weight * (b - l)).collect();
                *last = replace(&mut better, next);
            }
            column.push(better);
        }
        let moved = column.last().expect("a row for each number of substeps");
        self.states.iter_mut().zip(moved).for_each(|(x, d)| *x += d);
        self.time += length;
        Ok(())
    }
}

impl<T: Ode> Solver for Extrapolator<T> {
    fn reset(&mut self, time: f64) -> Result<(), SimulationError> {
        self.time = time;
        let mut nominals = vec![0.0; self.states.len()];
        self.ode.init(&mut self.states, &mut nominals)
    }

    fn step(&mut self, next_time: f64) -> Result<(f64, &[f64], bool), SimulationError> {
        let length = next_time - self.time;
        let steps = (length / STEP_S).ceil();
        for _ in 0..steps as usize {
            self.advance(length / steps)?;
        }
        self.time = next_time;
        Ok((next_time, &self.states, false))
    }
}
