//! The region in which the curve fits hold. Nothing is flown outside it.

use super::atmosphere::Atmosphere;

/// Lower and upper limits.
#[derive(Debug, Clone, Copy)]
pub struct Envelope {
    /// Incidence, rad.
    pub alpha: [f64; 2],
    /// Mach number.
    pub mach: [f64; 2],
    /// Altitude, m.
    pub altitude: [f64; 2],
    /// Least margin of the burner from thermal choking, if the fits end there.
    pub choking_margin: Option<f64>,
}

/// A limited variable with its value and limits, in the units of the variable table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedQuantity {
    /// Name in the variable table.
    pub variable: &'static str,
    /// Its value.
    pub value: f64,
    /// Its limits.
    pub limits: [f64; 2],
}

impl LimitedQuantity {
    /// Distance to the nearer limit over the width of the range, if it has one; negative outside.
    pub fn margin(&self) -> f64 {
        let [min, max] = self.limits;
        let (nearest, width) = (f64::min(self.value - min, max - self.value), max - min);
        // The divisor is chosen, not the quotient: infinity over infinity would be computed too.
        nearest / if width.is_finite() { width } else { 1.0 }
    }
}

impl Envelope {
    /// Altitude, Mach number and incidence, of altitude (m), speed through the air (m/s) and incidence
    /// to it (rad).
    pub fn limited_quantities(
        &self,
        atmosphere: &Atmosphere,
        [altitude, speed, alpha]: [f64; 3],
    ) -> [LimitedQuantity; 3] {
        let mach = speed / atmosphere.sound_speed(altitude);
        [
            LimitedQuantity { variable: "h", value: altitude, limits: self.altitude },
            LimitedQuantity { variable: "mach", value: mach, limits: self.mach },
            LimitedQuantity { variable: "alpha", value: alpha, limits: self.alpha },
        ]
    }

    /// Whether the fits hold there; never for what is not a number.
    pub fn holds(&self, atmosphere: &Atmosphere, condition: [f64; 3]) -> bool {
        self.limited_quantities(atmosphere, condition).iter().all(|limited| limited.margin() >= 0.0)
    }
}

/// The one with the smallest margin; there is one.
pub fn tightest(limited: impl IntoIterator<Item = LimitedQuantity>) -> LimitedQuantity {
    let nowhere =
        LimitedQuantity { variable: "", value: 0.0, limits: [f64::NEG_INFINITY, f64::INFINITY] };
    limited.into_iter().fold(nowhere, |a, b| if b.margin() < a.margin() { b } else { a })
}
