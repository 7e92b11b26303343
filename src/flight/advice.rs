//! What works and is probably not meant.

use super::in_flight::Flight;
use crate::vehicle::CONTROLS;

/// A control that asks for more than its actuator can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeyondLimit {
    /// Number of the control.
    pub control: usize,
    /// What it asks for in all.
    pub asked: f64,
    /// What it gets.
    pub limit: f64,
}

impl Flight {
    /// The controls that ask for more than their actuators can do, each reported once in a flight.
    pub fn newly_beyond_limits(&mut self) -> impl Iterator<Item = BeyondLimit> {
        (0..CONTROLS).filter_map(|control| {
            let [min, max] = self.vehicle.control_ranges()[control];
            let asked = self.base[control] + self.inputs.values[control];
            // A master that aims at the limit itself may miss it by rounding.
            let slack = 1e-9 * (max - min);
            let beyond = asked < min - slack || asked > max + slack;
            if self.limit_said[control] || !beyond {
                return None;
            }
            self.limit_said[control] = true;
            Some(BeyondLimit { control, asked, limit: asked.clamp(min, max) })
        })
    }
}
