//! Work against precision: what a method costs, in right-hand sides, for the error it makes.

mod tableaus;

pub use tableaus::RKF78;

use crate::cli::Compare;
use crate::table::{row, table};
use crate::trim::{flight, model, ready};
use ahv::dop853::DOP853;
use ahv::dynamics::{Control, NOMINAL, STATES, State, Vehicle};
use ahv::flight::DEFAULT_TOLERANCE;
use ahv::integrate::{Arrival, Integrator, System, Tableau};
use ahv::trim::Trim;
use anyhow::Result;
use std::cell::Cell;

/// Elevator against its trim value, rad, over the quarters of the flight.
pub const DOUBLET: [f64; 4] = [0.0, 0.01, -0.01, 0.0];
/// Length of the flight, s: the unstable vehicle keeps few digits for longer.
pub const FLIGHT_S: f64 = 1.0;
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// Of the flight that counts as exact; flown with another method than the vehicle's own.
pub const EXACT: f64 = 1e-14;

struct Counted<'a> {
    vehicle: &'a Vehicle,
    control: Control,
    calls: &'a Cell<usize>,
}

impl System<STATES> for Counted<'_> {
    fn derivatives(&self, _: f64, x: &State) -> State {
        self.calls.set(self.calls.get() + 1);
        self.vehicle.derivatives(x, &self.control, 0.0)
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
}

impl<'a> Problem<'a> {
    /// From trim, in equal communication steps.
    pub fn new(vehicle: &'a Vehicle, trim: &Trim, steps: usize) -> Self {
        Self { vehicle, start: trim.state, control: trim.control, steps }
    }

    /// Final state and right-hand sides.
    pub fn fly<const S: usize>(&self, tableau: &Tableau<S>, tolerance: f64) -> (State, usize) {
        let calls = Cell::new(0);
        let (mut x, mut slope) = (self.start, None);
        let mut integrator = Integrator::new(tolerance, 1e-3);
        let mut input = DOUBLET[0];
        for step in 0..self.steps {
            let wanted = DOUBLET[step * DOUBLET.len() / self.steps];
            if wanted != input {
                (input, slope) = (wanted, None);
            }
            let control = [self.control[0] + input, self.control[1]];
            let system = Counted { vehicle: self.vehicle, control, calls: &calls };
            let time = |step: usize| FLIGHT_S * step as f64 / self.steps as f64;
            let interval = [time(step), time(step + 1)];
            let arrival = integrator.advance(tableau, &system, &mut x, interval, &mut slope);
            assert_eq!(arrival, Arrival::Complete, "the flight is short and stays near trim");
        }
        (x, calls.get())
    }

    fn cell<const S: usize>(&self, tableau: &Tableau<S>, tolerance: f64, exact: &State) -> String {
        let (x, calls) = self.fly(tableau, tolerance);
        format!("{calls:6}  {:.0e}", error(&x, exact))
    }
}

/// Largest error of a state over its nominal value plus its size.
pub fn error(x: &State, exact: &State) -> f64 {
    (0..STATES).map(|i| (x[i] - exact[i]).abs() / (NOMINAL[i] + exact[i].abs())).fold(0.0, f64::max)
}

/// Prints right-hand sides and error of each method for a range of tolerances.
pub fn run(options: &Compare) -> Result<()> {
    let flight = flight(&model()?, &options.set)?;
    let (vehicle, trim) = ready(&flight)?;
    println!("Elevator doublet, {FLIGHT_S} s: right-hand sides, and the largest error of a state");
    println!("over its nominal value plus its size\n");
    for steps in [100, 4] {
        let problem = Problem::new(vehicle, trim, steps);
        let (exact, _) = problem.fly(&RKF78, EXACT);
        let mut rows = vec![row(["tolerance", "DOPRI5", "RKF78", "DOP853"])];
        for tolerance in TOLERANCES {
            let mark = if tolerance == DEFAULT_TOLERANCE { " (default)" } else { "" };
            rows.push(vec![
                format!("{tolerance:.0e}{mark}"),
                problem.cell(&tableaus::DOPRI5, tolerance, &exact),
                problem.cell(&RKF78, tolerance, &exact),
                problem.cell(&DOP853, tolerance, &exact),
            ]);
        }
        println!("Communication step {} s\n{}", FLIGHT_S / steps as f64, table(&rows));
    }
    Ok(())
}
