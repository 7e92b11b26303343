//! The vehicle as the integrator sees it.

use super::{INPUTS, Inputs};
use crate::dynamics::{Control, NOMINAL, STATES, State, Vehicle};
use crate::integrate::System;

/// A vehicle under the controls of one step.
pub(super) struct Steered<'a> {
    pub vehicle: &'a Vehicle,
    /// What the inputs are added to.
    pub base: Control,
    pub inputs: &'a Inputs,
    /// Controls in effect and gust, if they do not move.
    pub held: Option<(Control, f64)>,
}

impl Steered<'_> {
    /// Controls in effect and gust after a time (s) of the step.
    #[inline]
    fn at(&self, t: f64) -> (Control, f64) {
        self.held.unwrap_or_else(|| in_effect(self.vehicle, &self.base, &self.inputs.at(t)))
    }
}

/// Controls, cut to the actuators' limits, and gust.
pub(super) fn in_effect(
    vehicle: &Vehicle,
    base: &Control,
    inputs: &[f64; INPUTS],
) -> (Control, f64) {
    let (control, gust) = Inputs::split(inputs);
    (vehicle.saturate([base[0] + control[0], base[1] + control[1]]), gust)
}

impl System<STATES> for Steered<'_> {
    fn derivatives(&self, t: f64, x: &State) -> State {
        let (control, gust) = self.at(t);
        self.vehicle.derivatives(x, &control, gust)
    }
    fn holds(&self, t: f64, x: &State) -> bool {
        let (_, gust) = self.at(t);
        self.vehicle.holds(x, gust)
    }
    fn nominal(&self) -> &State {
        &NOMINAL
    }
    fn steady(&self) -> bool {
        self.held.is_some()
    }
}
