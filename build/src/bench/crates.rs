//! Integrators of other crates on our right-hand sides.

use crate::methods::{FLIGHT_S, Law};
use ahv::dynamics::{Control, NOMINAL, STATES, State, Vehicle};
use ahv::trim::Trim;
use anyhow::Result;
use ode_solvers::{Dop853, OutputType, SVector, System};

/// Final state and right-hand sides of a flight in equal communication steps, at a tolerance.
pub type Fly = fn(&Vehicle, &Trim, usize, &Law, f64) -> Result<(State, usize)>;

/// The crates, by the names of their methods.
pub const CRATES: &[(&str, Fly)] = &[
    ("ode_solvers", ode_solvers),
    #[cfg(feature = "diffsol")]
    ("diffsol tsit45", super::diffsol::tsit45),
    #[cfg(feature = "diffsol")]
    ("diffsol BDF", super::diffsol::bdf),
];

/// The state over its nominal values, so that one absolute tolerance is that of our flights.
type Scaled = SVector<f64, STATES>;

struct Held<'a> {
    vehicle: &'a Vehicle,
    control: Control,
}

impl System<f64, Scaled> for Held<'_> {
    fn system(&self, _: f64, y: &Scaled, rates: &mut Scaled) {
        let x = std::array::from_fn(|i| y[i] * NOMINAL[i]);
        let derivatives = self.vehicle.derivatives(&x, &self.control, 0.0);
        (0..STATES).for_each(|i| rates[i] = derivatives[i] / NOMINAL[i]);
    }
}

/// Final state and right-hand sides; the integration starts anew at each communication point.
fn ode_solvers(
    vehicle: &Vehicle,
    trim: &Trim,
    steps: usize,
    law: &Law,
    tolerance: f64,
) -> Result<(State, usize)> {
    let (mut x, mut calls) = (trim.state, 0);
    let length = FLIGHT_S / steps as f64;
    for step in 0..steps {
        let [elevator, phi] = trim.control;
        let control = [elevator + law.elevator(step, steps, &x), phi];
        let start = Scaled::from_fn(|i, _| x[i] / NOMINAL[i]);
        let held = Held { vehicle, control };
        let mut stepper = Dop853::new(held, 0.0, length, length, start, tolerance, tolerance);
        stepper.set_output(OutputType::Sparse);
        calls += stepper.integrate()?.num_eval as usize;
        let last = stepper.y_out().last().map_or(start, |state| *state);
        x = std::array::from_fn(|i| last[i] * NOMINAL[i]);
    }
    Ok((x, calls))
}
