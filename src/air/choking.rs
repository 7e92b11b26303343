//! Thermal choking: the fuel equivalence ratio at which heat addition makes the burner flow sonic.
//!
//! The engine is that of the first-principles model (`shock_expansion` in crates/research): oblique shock
//! at the fore-body, oblique shock at the inlet, isentropic diffuser, heat addition at constant area. The
//! captured mass flow also covers a lip below the bow shock, unlike [`crate::air::Intake`]. Choking does
//! not depend on pressure, so Mach number squared and mass flux describe the stream.
//!
//! A fore-body that turns away from the stream leaves it unchanged here; the expansion would only raise
//! the limit. The margin is continuous if the diffuser chokes before a shock detaches, as with this
//! vehicle.
//!
//! Equation numbers are those of NACA Report 1135 (Ames Research Staff, "Equations, tables, and
//! charts for compressible flow", 1953); heat addition follows J. D. Anderson, Modern Compressible
//! Flow, 3rd ed., section 3.8.

use crate::data::{EarthData, VehicleData};
use crate::solve::Scalar;

/// Limit of iterations; one to four are usual, more near a double root.
const MAX_STEPS: usize = 50;
/// Step over the distance to the next root at which the iteration ends: Halley's method leaves its cube,
/// Newton's with one more step its fourth power.
const CONVERGED: f64 = 1e-4;
/// Relative distance of two roots below which they count as a double root.
const DISTINCT: f64 = 1e-4;

/// Engine geometry and fuel.
#[derive(Debug, Clone, Copy)]
pub struct Choking {
    /// Angle of the fore-body below the axis, rad: the deflection at the inlet.
    lower_angle: f64,
    /// Tangent of this angle.
    tan_lower: f64,
    /// Distance of the lip from the nose along the fore-body, m.
    lip_distance: f64,
    /// Distance of the lip normal to the fore-body, m.
    height: f64,
    /// Height of the burner, m.
    burner: f64,
    /// Heat per mass of air at equivalence ratio 1, J/kg.
    heat: f64,
    /// Ratio of specific heats.
    gamma: f64,
    /// Exponent (gamma + 1)/(gamma - 1) of the temperature ratio in the squared area ratio, eq. (80).
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
        // Exactly 6 for gamma = 1.4, where a product replaces the power function.
        let power = (gamma + 1.0) / (gamma - 1.0);
        let power = if (power - 6.0).abs() < 1e-12 { 6.0 } else { power };
        Self {
            lower_angle,
            tan_lower: sin / cos,
            lip_distance: vehicle.geometry.fore_body_m.value / cos + duct * sin,
            height: duct * cos,
            burner: duct / engine.nozzle_area_ratio.value,
            heat: engine.stoichiometric_ratio.value
                * engine.combustion_efficiency.value
                * engine.heating_value_j_per_kg.value,
            gamma,
            power,
        }
    }

    /// Equivalence ratio that can be added before the burner chokes; negative if it is choked.
    ///
    /// `inflow`: incidence of the engine's inflow, rad; `sound_speed`: of the free stream, m/s; `phi`:
    /// present equivalence ratio. The result is -phi if the flow is not supersonic up to the burner: free
    /// stream subsonic, shock detached or diffuser choked.
    pub fn margin<S: Scalar>(&self, mach: S, inflow: S, sound_speed: S, phi: S) -> S {
        match self.rise(mach * mach, inflow) {
            Some(rise) => {
                // phi heat = c_p T_0 rise, with c_p T_0 = a^2 (T_0/T)/(gamma - 1).
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

    /// Relative rise of the stagnation temperature at which the burner chokes; `None` without supersonic
    /// flow.
    fn rise<S: Scalar>(&self, mach2: S, inflow: S) -> Option<S> {
        let ahead = Stream { mach2, flux2: S::constant(1.0) };
        let turn = inflow + self.lower_angle;
        let (sin, cos) =
            if turn.value() <= 0.0 { (S::constant(0.0), S::constant(1.0)) } else { turn.sin_cos() };
        // Largest deflection by a shock at infinite Mach number: sin = 1/gamma.
        if cos.value() <= 0.0 || sin.value() * self.gamma >= 1.0 {
            return None;
        }
        let along = self.shock(ahead, sin / cos)?;
        let inside = self.shock(along, S::constant(self.tan_lower))?;
        // A lip in the shock layer captures the flow between itself and the fore-body, one below the bow
        // shock the free stream between nose and lip: the smaller of the two.
        let layer = along.flux2 * (self.height * self.height);
        let whole = sin * self.lip_distance + cos * self.height;
        let captured = if layer.value() < (whole * whole).value() { layer } else { whole * whole };
        self.diffused(inside.mach2, inside.flux2 / captured * (self.burner * self.burner))
    }

    /// The stream behind the weak oblique shock of deflection atan(`tan`); `None` if the shock is
    /// detached or the stream subsonic.
    #[inline]
    fn shock<S: Scalar>(&self, ahead: Stream<S>, tan: S) -> Option<Stream<S>> {
        let (gamma, square) = (self.gamma, ahead.mach2);
        // Eq. (138) is a cubic in the cotangent of the shock angle; its largest root is the weak shock.
        let total = self.total_temperature(square);
        let cubic = [(total + square) * tan, S::constant(1.0) - square, total * tan];
        let value = |cot: S| ((cot + cubic[0]) * cot + cubic[1]) * cot + cubic[2];
        let (root, slope) = largest_root(cubic.map(S::value))?;
        // A Newton step in type S: full accuracy and the derivatives.
        let root = S::constant(root);
        let cot = root - value(root) * (1.0 / slope);
        let normal = square / (cot * cot + 1.0);
        // Eqs. (128) to (130) and conservation of energy.
        let pressure = (normal * (2.0 * gamma) - (gamma - 1.0)) * (1.0 / (gamma + 1.0));
        let density = normal * (gamma + 1.0) / (normal * (gamma - 1.0) + 2.0);
        let kinetic = density * total - pressure;
        let per_half = 2.0 / (gamma - 1.0);
        let mach2 = kinetic / pressure * per_half;
        let flux2 = ahead.flux2 * density * kinetic / square * per_half;
        Some(Stream { mach2, flux2 })
    }

    /// `total` to the power of eq. (80).
    #[inline]
    fn powered(&self, total: f64) -> f64 {
        let cube = total * total * total;
        if self.power == 6.0 { cube * cube } else { libm::pow(total, self.power) }
    }

    /// [`Self::rise`] for a diffuser with the inlet Mach number squared `mach2` and the area ratio
    /// squared `change2`.
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

        // Halley's method for ln(M^2): ln(area) is convex in it and soon linear. Logarithms near zero are
        // replaced by ln x = 2 (x - 1)/(x + 1), and the step is applied as the same fraction. The guess
        // is exact near Mach 5.
        let guess = start * libm::sqrt(libm::sqrt(change2.value()));
        let mut square = guess.max(0.5 * (1.0 + start));
        for _ in 0..MAX_STEPS {
            let (above, total) = (square - 1.0, self.total_temperature(square));
            let (is, wanted) = (self.powered(total / at_throat), target * square);
            let (excess, sum) = (is - wanted, (is + wanted) * (above * above));
            let below = (sum - excess * (at_throat * square)).max(0.5 * sum);
            let step = (2.0 * excess * total * above).max(-below);
            // At most half of the distance to Mach 1.
            let next = square * (2.0 * below - step) / (2.0 * below + step);
            square = next.max(0.5 * (1.0 + square));
            if step.abs() <= CONVERGED * below * above.clamp(1e-3, 1.0) {
                break;
            }
        }

        // Inverse of Anderson's eq. (3.89), less 1; its derivative with respect to area is finite even at
        // choking.
        let (above, total) = (square - 1.0, self.total_temperature(square));
        let part = 0.5 * above / (at_throat * square * total);
        let slope = 0.5 * (1.0 / at_throat - part * (2.0 * total - 1.0)) / target;
        Some(area2.chain(0.5 * above * part, slope))
    }
}

/// Largest root of x^3 + b x^2 + c x + d for b, d >= 0, and the derivative there; `None` unless all three
/// roots are real and c is negative.
#[inline]
fn largest_root([b, c, d]: [f64; 3]) -> Option<(f64, f64)> {
    let third = b / 3.0;
    let radius2 = third * third - c / 3.0;
    let offset = third * (third * third - 0.5 * c) + 0.5 * d;
    if !(c < 0.0 && offset * offset < radius2 * radius2 * radius2) {
        return None;
    }
    // The root for d = 0 is an upper bound, as is the fixed-point step from it; Newton's method then
    // converges monotonically from above.
    let (middle, square) = (0.5 * b, 0.25 * b * b - c);
    let mut x = libm::sqrt(square) - middle;
    x = libm::sqrt(square - d / x) - middle;
    let mut slope = (3.0 * x + 2.0 * b) * x + c;
    for _ in 0..MAX_STEPS {
        let step = (((x + b) * x + c) * x + d) / slope;
        x -= step;
        slope = (3.0 * x + 2.0 * b) * x + c;
        // The derivative is proportional to the distance of the roots.
        if step * -c <= CONVERGED * x * slope || slope <= 0.0 {
            break;
        }
    }
    (slope > -DISTINCT * c).then_some((x, slope))
}
