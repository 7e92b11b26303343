//! The vehicle as the integrator sees it.

use super::inputs::{INPUTS, Inputs};
use crate::dynamics::is_finite;
use crate::solve::System;
use crate::vehicle::{Control, Gust, NOMINAL, STATES, State, Vehicle};

/// A vehicle under the controls of one step.
pub(super) struct ControlledVehicle<'a> {
    pub vehicle: &'a Vehicle,
    /// What the inputs are added to.
    pub base: Control,
    pub inputs: &'a Inputs,
    /// Controls in effect and gust, if they do not move.
    pub held: Option<(Control, Gust)>,
}

impl ControlledVehicle<'_> {
    /// Controls in effect and gust after a time (s) of the step.
    #[inline]
    fn at(&self, t: f64) -> (Control, Gust) {
        self.held.unwrap_or_else(|| in_effect(self.vehicle, &self.base, &self.inputs.at(t)))
    }
}

/// Controls, cut to the actuators' limits, and gust, cut to the fastest: the inputs themselves follow
/// their derivatives wherever these lead.
pub(super) fn in_effect(
    vehicle: &Vehicle,
    base: &Control,
    inputs: &[f64; INPUTS],
) -> (Control, Gust) {
    let (control, gust) = Inputs::split(inputs);
    (vehicle.saturate([base[0] + control[0], base[1] + control[1]]), Vehicle::limit_gust(gust))
}

impl System<STATES> for ControlledVehicle<'_> {
    fn derivatives(&self, t: f64, x: &State) -> State {
        let (control, gust) = self.at(t);
        self.vehicle.derivatives(x, &control, gust)
    }
    fn holds(&self, t: f64, x: &State) -> bool {
        let (control, gust) = self.at(t);
        self.vehicle.holds(x, &control, gust)
    }
    fn nominal(&self) -> &State {
        &NOMINAL
    }
    #[inline(always)]
    fn in_domain(&self, x: &State) -> bool {
        is_finite(x)
    }
    fn is_autonomous(&self) -> bool {
        self.held.is_some()
    }
}
