//! Steady flow of a calorically perfect gas: shocks, expansions, heat addition, ducts.
//!
//! Equation numbers are those of NACA Report 1135 (Ames Research Staff, "Equations, tables, and
//! charts for compressible flow", 1953); heat addition follows Anderson, Modern Compressible Flow,
//! 3rd ed., section 3.8. Angles in rad. Without a steady solution the result is an error, never a NaN.

use core::f64::consts::FRAC_PI_2;

/// A calorically perfect gas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gas {
    /// Ratio of specific heats.
    pub gamma: f64,
}

/// A flow that does not exist.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum GasError {
    /// The relation needs a supersonic stream.
    #[error("Mach {mach} is not supersonic")]
    Subsonic {
        /// Mach number of the stream.
        mach: f64,
    },
    /// No attached shock turns the stream by this angle.
    #[error("the shock is detached: Mach {mach} turns by {limit} rad at most, not by {turn} rad")]
    Detached {
        /// Mach number ahead of the shock.
        mach: f64,
        /// Angle asked for, rad.
        turn: f64,
        /// Largest angle, rad.
        limit: f64,
    },
    /// The stream would expand beyond vacuum, or be compressed beyond the speed of sound.
    #[error("Prandtl-Meyer angle {angle} rad is beyond [0, {limit}]")]
    Expansion {
        /// Prandtl-Meyer angle asked for, rad.
        angle: f64,
        /// Largest angle, rad.
        limit: f64,
    },
    /// More heat than the stream can take before it reaches the speed of sound.
    #[error(
        "thermal choking: Mach {mach} takes {limit} times its stagnation temperature at most, \
         not {ratio} times"
    )]
    ThermallyChoked {
        /// Mach number ahead of the heat addition.
        mach: f64,
        /// Ratio of stagnation temperatures asked for.
        ratio: f64,
        /// Largest ratio.
        limit: f64,
    },
    /// A duct that is narrower than the throat that the stream needs.
    #[error("the duct is choked: area over throat area is {ratio}, below 1")]
    Choked {
        /// Area over that of the sonic throat.
        ratio: f64,
    },
}

/// Ratios across a shock, behind to ahead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Pressure.
    pub pressure: f64,
    /// Density.
    pub density: f64,
    /// Temperature.
    pub temperature: f64,
    /// Stagnation pressure.
    pub total_pressure: f64,
    /// Mach number behind the shock.
    pub mach: f64,
}

/// An oblique shock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObliqueShock {
    /// Angle between the shock and the stream ahead, rad.
    pub angle: f64,
    /// Ratios across it.
    pub jump: Jump,
}

/// Iteration limit; bisection alone needs 53 steps for all bits.
const MAX_STEPS: usize = 80;

/// Root of an increasing function in a bracket, by Newton's method with bisection outside the bracket.
///
/// `f` gives value and slope.
fn root([mut low, mut high]: [f64; 2], guess: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut x = guess.clamp(low, high);
    for _ in 0..MAX_STEPS {
        let (value, slope) = f(x);
        if value < 0.0 {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x.abs() || value == 0.0 {
            return x;
        }
        x = next;
    }
    x
}

fn supersonic(mach: f64) -> Result<f64, GasError> {
    if mach >= 1.0 && mach.is_finite() { Ok(mach) } else { Err(GasError::Subsonic { mach }) }
}

impl Gas {
    /// Stagnation temperature over temperature, eq. (43).
    pub fn total_temperature(&self, mach: f64) -> f64 {
        1.0 + 0.5 * (self.gamma - 1.0) * mach * mach
    }

    /// Stagnation pressure over pressure, eq. (44).
    pub fn total_pressure(&self, mach: f64) -> f64 {
        libm::pow(self.total_temperature(mach), self.gamma / (self.gamma - 1.0))
    }

    /// Dynamic pressure over pressure.
    pub fn dynamic_pressure(&self, mach: f64) -> f64 {
        0.5 * self.gamma * mach * mach
    }

    /// Area of a stream tube over that of its sonic throat, eq. (80).
    pub fn area(&self, mach: f64) -> f64 {
        let at_throat = 0.5 * (self.gamma + 1.0);
        let exponent = at_throat / (self.gamma - 1.0);
        libm::pow(self.total_temperature(mach) / at_throat, exponent) / mach
    }

    /// Mach number of the supersonic stream whose area is `ratio` times that of its sonic throat.
    ///
    /// # Errors
    /// [`GasError::Choked`] below 1.
    pub fn mach_from_area(&self, ratio: f64) -> Result<f64, GasError> {
        if !(ratio >= 1.0 && ratio.is_finite()) {
            return Err(GasError::Choked { ratio });
        }
        // Without the 1 in the total temperature M is bounded from above; Newton's method converges fast on
        // the logarithm.
        let at_throat = 0.5 * (self.gamma + 1.0);
        let target = libm::log(ratio);
        let exponent = at_throat / (self.gamma - 1.0);
        let widest =
            libm::pow(ratio * libm::pow(2.0 * exponent, exponent), 1.0 / (2.0 * exponent - 1.0));
        let residual = |mach: f64| {
            let total = self.total_temperature(mach);
            let slope = (mach * mach - 1.0) / (mach * total);
            (libm::log(self.area(mach)) - target, slope)
        };
        Ok(root([1.0, widest.max(1.0)], widest, residual))
    }

    /// Normal shock, eqs. (93) to (99).
    ///
    /// # Errors
    /// [`GasError::Subsonic`] below Mach 1.
    pub fn normal_shock(&self, mach: f64) -> Result<Jump, GasError> {
        let square = supersonic(mach)? * mach;
        let (g, total) = (self.gamma, self.total_temperature(mach));
        let pressure = (2.0 * g * square - (g - 1.0)) / (g + 1.0);
        let density = 0.5 * (g + 1.0) * square / total;
        let per_density = 1.0 / (g - 1.0);
        Ok(Jump {
            pressure,
            density,
            temperature: pressure / density,
            total_pressure: libm::pow(density, g * per_density) * libm::pow(pressure, -per_density),
            mach: (total / (g * square - 0.5 * (g - 1.0))).sqrt(),
        })
    }

    /// Turning angle behind a shock at `angle`, eq. (138), with its slope.
    fn turn(&self, mach: f64, angle: f64) -> (f64, f64) {
        let (sin, cos) = libm::sincos(angle);
        let square = mach * mach;
        let above = 2.0 * cos * (square * sin * sin - 1.0);
        let below = sin * (square * (self.gamma + 1.0 - 2.0 * sin * sin) + 2.0);
        let above_slope = 2.0 * sin * (square * (2.0 - 3.0 * sin * sin) + 1.0);
        let below_slope = cos * (square * (self.gamma + 1.0 - 6.0 * sin * sin) + 2.0);
        let slope = (above_slope * below - above * below_slope) / (above * above + below * below);
        (libm::atan2(above, below), slope)
    }

    /// Angle of the shock with the largest turning angle, and that angle, eq. (168), rad.
    pub fn largest_turn(&self, mach: f64) -> (f64, f64) {
        let (g, square) = (self.gamma, mach * mach);
        let inner =
            (g + 1.0) * ((g + 1.0) * square * square / 16.0 + 0.5 * (g - 1.0) * square + 1.0);
        let sine2 = (0.25 * (g + 1.0) * square - 1.0 + inner.sqrt()) / (g * square);
        let angle = libm::asin(sine2.min(1.0).sqrt());
        (angle, self.turn(mach, angle).0)
    }

    /// The weak oblique shock that turns a stream by `turn`, eqs. (128) to (138).
    ///
    /// # Errors
    /// [`GasError::Subsonic`] below Mach 1, [`GasError::Detached`] beyond the largest angle.
    pub fn oblique_shock(&self, mach: f64, turn: f64) -> Result<ObliqueShock, GasError> {
        supersonic(mach)?;
        let (steepest, limit) = self.largest_turn(mach);
        if !(turn >= 0.0 && turn <= limit) {
            return Err(GasError::Detached { mach, turn, limit });
        }
        let wave = libm::asin(1.0 / mach);
        // Shock angle for a small turn in a fast stream.
        let guess = wave + 0.25 * (self.gamma + 1.0) * turn;
        let angle = root([wave, steepest], guess, |angle| {
            let (value, slope) = self.turn(mach, angle);
            (value - turn, slope)
        });
        let normal = (mach * libm::sin(angle)).max(1.0);
        let jump = self.normal_shock(normal)?;
        let behind = jump.mach / libm::sin(angle - turn);
        Ok(ObliqueShock { angle, jump: Jump { mach: behind, ..jump } })
    }

    /// Prandtl-Meyer angle, eq. (171c), rad.
    ///
    /// # Errors
    /// [`GasError::Subsonic`] below Mach 1.
    pub fn prandtl_meyer(&self, mach: f64) -> Result<f64, GasError> {
        let x = (supersonic(mach)? * mach - 1.0).sqrt();
        let k = ((self.gamma + 1.0) / (self.gamma - 1.0)).sqrt();
        Ok(k * libm::atan(x / k) - libm::atan(x))
    }

    /// Mach number of a Prandtl-Meyer angle.
    ///
    /// # Errors
    /// [`GasError::Expansion`] below zero or at vacuum.
    pub fn mach_from_prandtl_meyer(&self, angle: f64) -> Result<f64, GasError> {
        let k = ((self.gamma + 1.0) / (self.gamma - 1.0)).sqrt();
        let limit = FRAC_PI_2 * (k - 1.0);
        if !(angle >= 0.0 && angle < limit) {
            return Err(GasError::Expansion { angle, limit });
        }
        // The unknown is the Mach angle's complement t = atan(sqrt(M^2-1)): its range is finite.
        let t = root([0.0, FRAC_PI_2], angle / limit * FRAC_PI_2, |t| {
            let tan = libm::tan(t);
            let slope = (1.0 + tan * tan) / (1.0 + tan * tan / (k * k)) - 1.0;
            (k * libm::atan(tan / k) - t - angle, slope)
        });
        Ok(1.0 / libm::cos(t))
    }

    /// Stagnation temperature over that of the choked stream, Anderson eq. (3.89).
    pub fn rayleigh_total_temperature(&self, mach: f64) -> f64 {
        let (g, square) = (self.gamma, mach * mach);
        let below = 1.0 + g * square;
        (g + 1.0) * square * (2.0 + (g - 1.0) * square) / (below * below)
    }

    /// Pressure over that of the choked stream, Anderson eq. (3.85).
    pub fn rayleigh_pressure(&self, mach: f64) -> f64 {
        (1.0 + self.gamma) / (1.0 + self.gamma * mach * mach)
    }

    /// Mach number of a supersonic stream after its stagnation temperature has risen by the factor `ratio`
    /// in a frictionless duct of constant area.
    ///
    /// Solved for M^2, eq. (3.89) of Anderson gives M^2 = (1 + s)/(1 - gamma s) with
    /// s^2 = 1 - T0/T0*; the subsonic branch is s < 0.
    ///
    /// # Errors
    /// [`GasError::Subsonic`] below Mach 1, [`GasError::ThermallyChoked`] if it would fall to 1.
    pub fn heated(&self, mach: f64, ratio: f64) -> Result<f64, GasError> {
        let start = self.rayleigh_total_temperature(supersonic(mach)?);
        let left = 1.0 - start * ratio;
        if !(left >= 0.0 && ratio >= 1.0) {
            return Err(GasError::ThermallyChoked { mach, ratio, limit: 1.0 / start });
        }
        let s = left.sqrt();
        Ok(((1.0 + s) / (1.0 - self.gamma * s)).sqrt())
    }
}
