//! The range of validity of the curve fits, which no flight leaves.

use super::atmosphere::Atmosphere;
use crate::error::{LimitedKind, LimitedQuantity};

/// Lower and upper limits.
#[derive(Debug, Clone, Copy)]
pub struct Envelope {
    /// Incidence, rad.
    pub alpha: [f64; 2],
    /// Mach number.
    pub mach: [f64; 2],
    /// Altitude, m.
    pub altitude: [f64; 2],
    /// Smallest margin to thermal choking, if the fits are limited by it.
    pub choking_margin: Option<f64>,
}

impl Envelope {
    /// Altitude, Mach number and incidence with their limits, from altitude (m), airspeed (m/s) and incidence
    /// (rad).
    pub fn limited_quantities(
        &self,
        atmosphere: &Atmosphere,
        [altitude, speed, alpha]: [f64; 3],
    ) -> [LimitedQuantity; 3] {
        let mach = speed / atmosphere.sound_speed(altitude);
        [
            LimitedQuantity { kind: LimitedKind::Altitude, value: altitude, limits: self.altitude },
            LimitedQuantity { kind: LimitedKind::Mach, value: mach, limits: self.mach },
            LimitedQuantity { kind: LimitedKind::Incidence, value: alpha, limits: self.alpha },
        ]
    }

    /// Whether the fits hold; false for NaN.
    pub fn holds(&self, atmosphere: &Atmosphere, condition: [f64; 3]) -> bool {
        self.limited_quantities(atmosphere, condition).iter().all(|limited| limited.margin() >= 0.0)
    }
}

/// The quantity with the smallest margin.
pub fn tightest(limited: impl IntoIterator<Item = LimitedQuantity>) -> LimitedQuantity {
    let unlimited = LimitedQuantity {
        kind: LimitedKind::State(0),
        value: 0.0,
        limits: [f64::NEG_INFINITY, f64::INFINITY],
    };
    limited.into_iter().fold(unlimited, |a, b| if b.margin() < a.margin() { b } else { a })
}
