//! Placeholder until the engine's choking lands.
use crate::params::{EarthData, VehicleData};
use crate::scalar::Scalar;

/// Engine.
#[derive(Debug, Clone, Copy)]
pub struct Choking {}

impl Choking {
    /// New.
    pub fn new(_vehicle: &VehicleData, _earth: &EarthData) -> Self {
        Self {}
    }
    /// Margin.
    pub fn margin<S: Scalar>(&self, _mach: S, _inflow: S, _sound_speed: S, phi: S) -> S {
        -phi + 1.0
    }
}
