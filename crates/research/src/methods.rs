//! `cargo ahv methods`: evaluations of the right-hand side against error, for several integration methods.

mod tableaus;

pub use tableaus::RKF78;

use crate::cli::Compare;
use ahv::dynamics::trim::Trim;
use ahv::flight::{DEFAULT_TOLERANCE, method};
use ahv::solve::{DOP853, Integrator, Method, Outcome, System};
use ahv::vehicle::{ALPHA, Control, DELTA_E, NOMINAL, PHI, Q, STATES, State, Vehicle};
use ahv_tool::table::{row, table};
use ahv_tool::trim::flight;
use anyhow::Result;
use std::cell::Cell;
use std::convert::Infallible;

/// Elevator relative to trim in the quarters of the flight, rad.
pub const DOUBLET: [f64; 4] = [0.0, 0.01, -0.01, 0.0];
/// Feedback of incidence (rad per rad) and pitch rate (s) to the elevator that stabilises the short
/// period.
pub const FEEDBACK: [f64; 2] = [9.0, 2.0];
/// Length of the flight, s; the unstable vehicle amplifies errors in longer flights.
pub const FLIGHT_S: f64 = 1.0;
/// Initial disturbance of incidence, pitch rate and modes in the second flight, in nominal values.
const DISTURBANCE: f64 = 3.0;
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// Tolerance of the reference flight, which uses another method than the vehicle.
pub const EXACT: f64 = 1e-14;

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
    pub fn elevator(&self, step: usize, steps: usize, x: &State) -> f64 {
        let [per_alpha, per_q] = self.feedback;
        DOUBLET[step * DOUBLET.len() / steps] + per_alpha * (x[ALPHA] - self.alpha) + per_q * x[Q]
    }
}

/// The vehicle in one communication step, with a count of right-hand sides.
pub struct Counted<'a> {
    pub vehicle: &'a Vehicle,
    pub control: Control,
    calls: &'a Cell<usize>,
}

impl System<STATES> for Counted<'_> {
    fn derivatives(&self, _: f64, x: &State) -> State {
        self.calls.set(self.calls.get() + 1);
        self.vehicle.derivatives(x, &self.control, [0.0; 2])
    }
    fn holds(&self, _: f64, _: &State) -> bool {
        true
    }
    fn nominal(&self) -> &State {
        &NOMINAL
    }
}

/// The trimmed vehicle under an elevator doublet.
pub struct Problem<'a> {
    vehicle: &'a Vehicle,
    start: State,
    control: Control,
    /// Communication steps of the flight.
    steps: usize,
    law: Law,
}

impl<'a> Problem<'a> {
    /// From trim, in equal communication steps.
    pub fn new(vehicle: &'a Vehicle, trim: &Trim, steps: usize, law: Law) -> Self {
        Self { vehicle, start: trim.state, control: trim.control, steps, law }
    }

    /// Final state and right-hand sides, where `step` integrates the interval (s) of one communication step.
    pub fn each<E>(
        &self,
        mut step: impl FnMut(&Counted, [f64; 2], &mut State) -> Result<(), E>,
    ) -> Result<(State, usize), E> {
        let (mut x, calls) = (self.start, Cell::new(0));
        for number in 0..self.steps {
            let elevator = self.law.elevator(number, self.steps, &x);
            let control = [self.control[DELTA_E] + elevator, self.control[PHI]];
            let system = Counted { vehicle: self.vehicle, control, calls: &calls };
            let time = |number: usize| FLIGHT_S * number as f64 / self.steps as f64;
            step(&system, [time(number), time(number + 1)], &mut x)?;
        }
        Ok((x, calls.get()))
    }

    /// Final state and right-hand sides.
    pub fn fly(&self, method: &mut impl Method<STATES>, tolerance: f64) -> (State, usize) {
        let (mut integrator, mut slope) = (Integrator::new(tolerance, 1e-3), None);
        let mut before = None;
        let flown: Result<_, Infallible> = self.each(|system, interval, x| {
            if before.replace(system.control) != Some(system.control) {
                slope = None;
            }
            let outcome = integrator.advance(method, system, x, interval, &mut slope);
            assert_eq!(outcome, Outcome::Complete, "the flight is short and stays near trim");
            Ok(())
        });
        let Ok(flown) = flown;
        flown
    }

    fn cell(&self, method: &mut impl Method<STATES>, tolerance: f64, exact: &State) -> String {
        let (x, calls) = self.fly(method, tolerance);
        format!("{calls:6}  {:.0e}", error(&x, exact))
    }
}

/// Largest error of a state over the sum of nominal value and magnitude.
pub fn error(x: &State, exact: &State) -> f64 {
    (0..STATES).map(|i| (x[i] - exact[i]).abs() / (NOMINAL[i] + exact[i].abs())).fold(0.0, f64::max)
}

/// A start far from trim in incidence, pitch rate and modes.
fn disturbed(vehicle: &Vehicle, trim: &Trim) -> Trim {
    let mut state = trim.state;
    for i in ALPHA..vehicle.states() {
        state[i] += DISTURBANCE * NOMINAL[i];
    }
    Trim { state, ..*trim }
}

/// Prints right-hand sides and error of each method for a range of tolerances.
pub fn run(options: &Compare) -> Result<()> {
    let flight = flight(&options.set)?;
    let (vehicle, trim) = (flight.vehicle(), flight.trim());
    let mut exponential = method(vehicle, trim);
    outln!(
        "Elevator doublet, {FLIGHT_S} s: evaluations of the right-hand side, and the largest error of a"
    )?;
    outln!("state over the sum of its nominal value and magnitude\n")?;
    for (start, from) in [("trim", *trim), ("a disturbed state", disturbed(vehicle, trim))] {
        for steps in [100, 4] {
            let problem = Problem::new(vehicle, &from, steps, Law::OPEN);
            let (exact, _) = problem.fly(&mut &RKF78, EXACT);
            let mut rows = vec![row(["tolerance", "DOPRI5", "RKF78", "DOP853", "exponential"])];
            for tolerance in TOLERANCES {
                let mark = if tolerance == DEFAULT_TOLERANCE { " (default)" } else { "" };
                rows.push(vec![
                    format!("{tolerance:.0e}{mark}"),
                    problem.cell(&mut &tableaus::DOPRI5, tolerance, &exact),
                    problem.cell(&mut &RKF78, tolerance, &exact),
                    problem.cell(&mut &DOP853, tolerance, &exact),
                    problem.cell(&mut exponential, tolerance, &exact),
                ]);
            }
            let step = FLIGHT_S / steps as f64;
            outln!("From {start}, communication step {step} s\n{}", table(&rows))?;
        }
    }
    Ok(())
}
