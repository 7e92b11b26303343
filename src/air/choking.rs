//! How much fuel the burner can take: with more, its heat would slow the stream to the speed of
//! sound, and no steady flow is left.
//!
//! The engine is that of the first-principles model (`shock_expansion` in crates/research), at run
//! time and for every [`Scalar`]: shock of the fore-body, shock of the inlet, isentropic diffuser,
//! heat at constant area. The capture is the same too, also where the lip is below the bow shock,
//! which [`crate::air::Intake`] leaves out. A burner chokes whatever the pressure, so the stream is
//! given by its Mach number squared and its mass flux alone.
//!
//! Where the fore-body turns away from the stream, the stream is taken to pass along it: an
//! expansion would only raise the limit. The margin is continuous if the diffuser chokes before a
//! shock is detached, as it does with this vehicle.
//!
//! Equation numbers are those of NACA Report 1135 (Ames Research Staff, "Equations, tables, and
//! charts for compressible flow", 1953); heat addition follows J. D. Anderson, Modern Compressible
//! Flow, 3rd ed., section 3.8.

use crate::data::{EarthData, VehicleData};
use crate::solve::Scalar;

/// Steps that an iteration takes at most; one to four are usual, more where two roots nearly meet.
const MAX_STEPS: usize = 50;
/// Step, over the distance to the next root, after which the error is below the last digits: Halley's
/// method cubes it, Newton's squares it twice.
const CLOSE: f64 = 1e-4;
/// Distance of two roots, over their size, below which they count as one.
const APART: f64 = 1e-4;

/// The engine as its burner sees it.
#[derive(Debug, Clone, Copy)]
pub struct Choking {
    /// Angle of the fore-body below the axis, rad: the turn at the inlet.
    lower_angle: f64,
    /// Tangent of this angle.
    tan_lower: f64,
    /// Distance of the lip from the nose along the fore-body, m.
    reach: f64,
    /// Distance of the lip from the fore-body, across it, m.
    height: f64,
    /// Height of the burner, m.
    burner: f64,
    /// Heat per mass of air at equivalence ratio 1, J/kg.
    heat: f64,
    /// Ratio of specific heats.
    gamma: f64,
    /// Power of the stagnation temperature in the square of the area, eq. (80).
    power: f64,
}

/// A supersonic stream.
#[derive(Clone, Copy)]
struct Stream<S> {
    /// Mach number squared.
    mach2: S,
    /// Square of the mass flux over that of the free stream.
    flux2: S,
}

impl Choking {
    /// The engine of the data files.
    pub fn new(vehicle: &VehicleData, earth: &EarthData) -> Self {
        let (engine, lower_angle) = (&vehicle.engine, vehicle.outline.lower_angle_rad.value);
        let (sin, cos) = libm::sincos(lower_angle);
        let duct = engine.duct_height_m.value;
        let gamma = earth.air.heat_capacity_ratio.value;
        // For air this is six, and a product in place of a power; 1.4 only misses it by rounding.
        let power = (gamma + 1.0) / (gamma - 1.0);
        let power = if (power - 6.0).abs() < 1e-12 { 6.0 } else { power };
        Self {
            lower_angle,
            tan_lower: sin / cos,
            reach: vehicle.geometry.fore_body_m.value / cos + duct * sin,
            height: duct * cos,
            burner: duct / engine.nozzle_area_ratio.value,
            heat: engine.stoichiometric_ratio.value
                * engine.combustion_efficiency.value
                * engine.heating_value_j_per_kg.value,
            gamma,
            power,
        }
    }

    /// Equivalence ratio that can still be added before the burner chokes, negative beyond.
    ///
    /// `inflow` is the incidence of the engine's inflow, rad, `sound_speed` that of the free stream,
    /// m/s, `phi` the equivalence ratio now. Without supersonic flow up to the burner (the free
    /// stream too slow, a shock detached, the diffuser choked) nothing can be burnt, so it is -phi.
    pub fn margin<S: Scalar>(&self, mach: S, inflow: S, sound_speed: S, phi: S) -> S {
        match self.rise(mach * mach, inflow) {
            Some(rise) => {
                // Heat is specific heat times stagnation temperature times rise.
                let total = sound_speed * sound_speed * self.total_temperature(mach * mach);
                total * rise * (1.0 / ((self.gamma - 1.0) * self.heat)) - phi
            }
            None => -phi,
        }
    }

    /// Stagnation temperature over temperature, eq. (43).
    fn total_temperature<S: Scalar>(&self, mach2: S) -> S {
        mach2 * (0.5 * (self.gamma - 1.0)) + 1.0
    }

    /// Part of its stagnation temperature by which the burner may heat the stream; `None` where
    /// there is no supersonic stream to heat.
    fn rise<S: Scalar>(&self, mach2: S, inflow: S) -> Option<S> {
        let ahead = Stream { mach2, flux2: S::constant(1.0) };
        let turn = inflow + self.lower_angle;
        let (sin, cos) =
            if turn.value() <= 0.0 { (S::constant(0.0), S::constant(1.0)) } else { turn.sin_cos() };
        // No shock turns a stream by more, however fast it is.
        if cos.value() <= 0.0 || sin.value() * self.gamma >= 1.0 {
            return None;
        }
        let along = self.shock(ahead, sin / cos)?;
        let inside = self.shock(along, S::constant(self.tan_lower))?;
        // A lip in the shock layer takes in what passes between itself and the fore-body, one below
        // the bow shock the free stream from the nose down to itself: whichever is less.
        let layer = along.flux2 * (self.height * self.height);
        let whole = sin * self.reach + cos * self.height;
        let captured = if layer.value() < (whole * whole).value() { layer } else { whole * whole };
        self.diffused(inside.mach2, inside.flux2 / captured * (self.burner * self.burner))
    }

    /// Behind the weak oblique shock that turns a stream by the angle of tangent `tan`; `None` if it
    /// is detached or the stream not supersonic.
    #[inline]
    fn shock<S: Scalar>(&self, ahead: Stream<S>, tan: S) -> Option<Stream<S>> {
        let (gamma, square) = (self.gamma, ahead.mach2);
        // Eq. (138), solved for the tangent of the turn, is a cubic in the cotangent of the shock's
        // angle: its largest root is the weak shock.
        let total = self.total_temperature(square);
        let cubic = [(total + square) * tan, S::constant(1.0) - square, total * tan];
        let value = |cot: S| ((cot + cubic[0]) * cot + cubic[1]) * cot + cubic[2];
        let (root, slope) = largest_root(cubic.map(S::value))?;
        // One step of Newton brings the last digits, and the derivatives.
        let root = S::constant(root);
        let cot = root - value(root) * (1.0 / slope);
        let normal = square / (cot * cot + 1.0);
        // Eqs. (128) to (130); the energy gives the rest.
        let pressure = (normal * (2.0 * gamma) - (gamma - 1.0)) * (1.0 / (gamma + 1.0));
        let density = normal * (gamma + 1.0) / (normal * (gamma - 1.0) + 2.0);
        let kinetic = density * total - pressure;
        let per_half = 2.0 / (gamma - 1.0);
        let mach2 = kinetic / pressure * per_half;
        let flux2 = ahead.flux2 * density * kinetic / square * per_half;
        Some(Stream { mach2, flux2 })
    }

    /// A stagnation temperature over that at the throat, to the power of eq. (80).
    #[inline]
    fn powered(&self, total: f64) -> f64 {
        let cube = total * total * total;
        if self.power == 6.0 { cube * cube } else { libm::pow(total, self.power) }
    }

    /// As [`Self::rise`], for the stream of `mach2` ahead of a diffuser whose area changes by the
    /// root of `change2`.
    fn diffused<S: Scalar>(&self, mach2: S, change2: S) -> Option<S> {
        let (at_throat, start) = (0.5 * (self.gamma + 1.0), mach2.value());
        if start <= 1.0 {
            return None;
        }
        // Square of the burner's area over the throat's, eq. (80).
        let total = self.total_temperature(start);
        let value = self.powered(total / at_throat) / start;
        let area2 = mach2.chain(value, value * (start - 1.0) / (start * total)) * change2;
        let target = area2.value();
        if target <= 1.0 {
            return None;
        }

        // Unknown is the logarithm of Mach number squared: in it the logarithm of the area is convex
        // and soon a straight line, so Halley's method is quick. Of logarithms near zero the first
        // fraction is enough, ln x = 2 (x - 1)/(x + 1), and the step is kept as a fraction too. Near
        // Mach 5 the guess is exact.
        let guess = start * libm::sqrt(libm::sqrt(change2.value()));
        let mut square = guess.max(0.5 * (1.0 + start));
        for _ in 0..MAX_STEPS {
            let (above, total) = (square - 1.0, self.total_temperature(square));
            let (is, wanted) = (self.powered(total / at_throat), target * square);
            let (excess, sum) = (is - wanted, (is + wanted) * (above * above));
            let below = (sum - excess * (at_throat * square)).max(0.5 * sum);
            let step = (2.0 * excess * total * above).max(-below);
            // Never beyond half the way to the speed of sound.
            let next = square * (2.0 * below - step) / (2.0 * below + step);
            square = next.max(0.5 * (1.0 + square));
            if step.abs() <= CLOSE * below * above.clamp(1e-3, 1.0) {
                break;
            }
        }

        // Anderson's eq. (3.89) turned over, less 1; its slope along the area is finite even where
        // the diffuser chokes.
        let (above, total) = (square - 1.0, self.total_temperature(square));
        let part = 0.5 * above / (at_throat * square * total);
        let slope = 0.5 * (1.0 / at_throat - part * (2.0 * total - 1.0)) / target;
        Some(area2.chain(0.5 * above * part, slope))
    }
}

/// Largest root of x^3 + b x^2 + c x + d, with b and d not negative, and the slope there; `None`
/// unless all three are real and c is negative.
#[inline]
fn largest_root([b, c, d]: [f64; 3]) -> Option<(f64, f64)> {
    let third = b / 3.0;
    let radius2 = third * third - c / 3.0;
    let offset = third * (third * third - 0.5 * c) + 0.5 * d;
    if !(c < 0.0 && offset * offset < radius2 * radius2 * radius2) {
        return None;
    }
    // Without d the root is that of a square; it is above, and so is the next guess. From there
    // Newton's method comes down to it.
    let (middle, square) = (0.5 * b, 0.25 * b * b - c);
    let mut x = libm::sqrt(square) - middle;
    x = libm::sqrt(square - d / x) - middle;
    let mut slope = (3.0 * x + 2.0 * b) * x + c;
    for _ in 0..MAX_STEPS {
        let step = (((x + b) * x + c) * x + d) / slope;
        x -= step;
        slope = (3.0 * x + 2.0 * b) * x + c;
        // The slope is in proportion to the distance of the roots.
        if step * -c <= CLOSE * x * slope || slope <= 0.0 {
            break;
        }
    }
    (slope > -APART * c).then_some((x, slope))
}
