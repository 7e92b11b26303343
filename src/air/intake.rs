//! Air captured by the engine, and the fuel flow.
//!
//! The lip lies between fore-body and bow shock, so the engine captures the flow through the duct's
//! height there. The density behind the bow shock follows from hypersonic similarity (J. D. Anderson,
//! Hypersonic and High-Temperature Gas Dynamics, 2nd ed., section 2.3), the velocity along the free
//! stream from the exact relation. Above Mach 10.7 at small incidence the shock layer is thinner than the
//! duct and the result is too large by up to 4 %; elsewhere it agrees with the first-principles model,
//! `shock_expansion` in crates/research.

use crate::data::{EarthData, VehicleData};
use crate::solve::Scalar;

/// Intake duct and fuel.
#[derive(Debug, Clone, Copy)]
pub struct Intake {
    /// Angle of the fore-body below the axis, rad.
    pub lower_angle: f64,
    /// Height of the duct normal to the fore-body, m.
    pub height: f64,
    /// Fuel per air, by mass, at equivalence ratio 1.
    pub stoichiometric_ratio: f64,
    /// Ratio of specific heats.
    pub gamma: f64,
}

impl Intake {
    /// The intake of the data files.
    pub fn new(vehicle: &VehicleData, earth: &EarthData) -> Self {
        let lower_angle = vehicle.outline.lower_angle_rad.value;
        Self {
            lower_angle,
            height: vehicle.engine.duct_height_m.value * libm::cos(lower_angle),
            stoichiometric_ratio: vehicle.engine.stoichiometric_ratio.value,
            gamma: earth.air.heat_capacity_ratio.value,
        }
    }

    /// Height of the captured free stream, m, at incidence `alpha`, rad.
    pub fn captured_height<S: Scalar>(&self, mach: S, alpha: S) -> S {
        let gamma = self.gamma;
        let turn = alpha + self.lower_angle;
        // Mach number normal to the shock: K/2 + sqrt(K^2/4 + 1), K = (gamma + 1)/2 M theta.
        let half = mach * turn * ((gamma + 1.0) / 4.0);
        let normal = half + (half * half + 1.0).sqrt();
        let square = normal * normal;
        let density = square * (gamma + 1.0) / (square * (gamma - 1.0) + 2.0);
        let along = -(square - 1.0) * (2.0 / (gamma + 1.0)) / (mach * mach) + 1.0;
        let (_, cos) = turn.sin_cos();
        density * along / cos * self.height
    }

    /// Fuel, kg/(m s), for a free stream of `mass_flux`, kg/(m^2 s), at equivalence ratio `phi`.
    pub fn fuel_flow<S: Scalar>(&self, mass_flux: S, mach: S, alpha: S, phi: S) -> S {
        mass_flux * self.captured_height(mach, alpha) * phi * self.stoichiometric_ratio
    }
}
