//! A manoeuvre of the vehicle that any method can integrate.

use super::double_double::DoubleDouble;
use super::extrapolation::extrapolate;
use ahv::dynamics::trim::Trim;
use ahv::solve::{Integrator, Method, Outcome, Scalar, System};
use ahv::vehicle::{ALPHA, Control, DELTA_E, GUSTS, Gust, NOMINAL, PHI, Q, STATES, State, Vehicle};
use anyhow::{Result, bail};
use std::cell::Cell;

/// Elevator relative to trim in the quarters of the flight, rad.
pub const DOUBLET: [f64; 4] = [0.0, 0.01, -0.01, 0.0];
/// Feedback of incidence (rad per rad) and pitch rate (s) to the elevator that stabilises the short
/// period.
pub const FEEDBACK: [f64; 2] = [9.0, 2.0];
/// Length of the usual flight, s; the unstable vehicle amplifies errors in longer flights.
pub const FLIGHT_S: f64 = 1.0;
/// Tolerance of a reference flight with another method than the vehicle's.
pub const EXACT: f64 = 1e-14;
/// Columns of the extrapolation and longest step (s) of the reference flight in twice the precision.
const COLUMNS: usize = 10;
const REFERENCE_STEP_S: f64 = 0.01;

/// Control law of the elevator.
#[derive(Debug, Clone, Copy)]
pub struct Law {
    /// Incidence in trim, rad.
    alpha: f64,
    feedback: [f64; 2],
}

impl Law {
    /// The doublet alone.
    pub const OPEN: Self = Self { alpha: 0.0, feedback: [0.0; 2] };

    /// The doublet with feedback of the deviation from trim.
    pub fn closed(trim: &Trim) -> Self {
        Self { alpha: trim.state[ALPHA], feedback: FEEDBACK }
    }

    /// Elevator relative to trim, rad, in a communication step that starts at state `x`.
    pub fn elevator<S: Scalar>(&self, step: usize, steps: usize, x: &State<S>) -> S {
        let [per_alpha, per_q] = self.feedback;
        (x[ALPHA] - self.alpha) * per_alpha + x[Q] * per_q + DOUBLET[step * DOUBLET.len() / steps]
    }
}

/// The vehicle in one communication step, with a count of right-hand sides.
pub struct Counted<'a> {
    pub vehicle: &'a Vehicle,
    pub control: Control,
    pub gust: Gust,
    calls: &'a Cell<usize>,
}

impl System<STATES> for Counted<'_> {
    fn derivatives(&self, _: f64, x: &State) -> State {
        self.calls.set(self.calls.get() + 1);
        self.vehicle.derivatives(x, &self.control, self.gust)
    }
    fn holds(&self, _: f64, _: &State) -> bool {
        true
    }
    fn nominal(&self) -> &State {
        &NOMINAL
    }
}

/// A flight under an elevator doublet.
pub struct Problem<'a> {
    pub vehicle: &'a Vehicle,
    pub start: State,
    pub control: Control,
    /// Velocity of the air in the first quarter of the flight, m/s; in the others twice, three and four times that.
    pub gust: Gust,
    pub flight_s: f64,
    /// Communication steps of the flight.
    pub steps: usize,
    pub law: Law,
}

impl<'a> Problem<'a> {
    /// One of [`FLIGHT_S`] from trim in still air, in equal communication steps.
    pub fn new(vehicle: &'a Vehicle, trim: &Trim, steps: usize, law: Law) -> Self {
        let Trim { state: start, control } = *trim;
        Self { vehicle, start, control, gust: [0.0; GUSTS], flight_s: FLIGHT_S, steps, law }
    }

    /// Controls and gust of a communication step that starts at state `x`.
    fn inputs<S: Scalar>(&self, step: usize, x: &State<S>) -> (Control<S>, Gust) {
        let elevator = self.law.elevator(step, self.steps, x) + self.control[DELTA_E];
        let quarter = step * DOUBLET.len() / self.steps;
        let gust = self.gust.map(|speed| speed * (quarter + 1) as f64);
        ([elevator, S::constant(self.control[PHI])], gust)
    }

    /// Final state and right-hand sides, where `step` integrates the interval (s) of one communication step.
    pub fn each<E>(
        &self,
        mut step: impl FnMut(&Counted, [f64; 2], &mut State) -> Result<(), E>,
    ) -> Result<(State, usize), E> {
        let (mut x, calls) = (self.start, Cell::new(0));
        for number in 0..self.steps {
            let (control, gust) = self.inputs(number, &x);
            let system = Counted { vehicle: self.vehicle, control, gust, calls: &calls };
            let time = |number: usize| self.flight_s * number as f64 / self.steps as f64;
            step(&system, [time(number), time(number + 1)], &mut x)?;
        }
        Ok((x, calls.get()))
    }

    /// Final state and right-hand sides, or where a flight ended for which the tolerance is too small.
    pub fn try_fly(
        &self,
        method: &mut impl Method<STATES>,
        tolerance: f64,
    ) -> Result<(State, usize), Outcome> {
        let (mut integrator, mut slope) = (Integrator::new(tolerance, 1e-3), None);
        let mut before = None;
        self.each(|system, interval, x| {
            let inputs = (system.control, system.gust);
            if before.replace(inputs) != Some(inputs) {
                slope = None;
            }
            match integrator.advance(method, system, x, interval, &mut slope) {
                Outcome::Complete => Ok(()),
                outcome => Err(outcome),
            }
        })
    }

    /// Final state and right-hand sides.
    pub fn fly(&self, method: &mut impl Method<STATES>, tolerance: f64) -> (State, usize) {
        self.try_fly(method, tolerance)
            .expect("a short flight near trim, with a possible tolerance")
    }

    /// Final state, from a flight in twice the precision.
    ///
    /// # Errors
    /// If the flight leaves the vehicle's envelope.
    pub fn exact(&self) -> Result<State> {
        let mut x = self.start.map(DoubleDouble::from);
        let step_s = self.flight_s / self.steps as f64;
        let pieces = libm::ceil(step_s / REFERENCE_STEP_S - 1e-6) as usize;
        let h = DoubleDouble::from(self.flight_s) / ((self.steps * pieces) as f64).into();
        for step in 0..self.steps {
            let (control, gust) = self.inputs(step, &x);
            let air = gust.map(DoubleDouble::from);
            let f = |x: &_| self.vehicle.derivatives(x, &control, air);
            for _ in 0..pieces {
                [_, x] = extrapolate::<_, STATES, COLUMNS>(f, &x, &f(&x), h);
            }
            let state = x.map(DoubleDouble::rounded);
            let holds = self.vehicle.holds(&state, &control.map(DoubleDouble::rounded), gust);
            if !holds {
                bail!("the flight leaves the envelope after {} s", step_s * (step + 1) as f64);
            }
        }
        Ok(x.map(DoubleDouble::rounded))
    }
}

/// Largest error of a state over the sum of nominal value and magnitude.
pub fn error(x: &State, exact: &State) -> f64 {
    (0..STATES).map(|i| (x[i] - exact[i]).abs() / (NOMINAL[i] + exact[i].abs())).fold(0.0, f64::max)
}
