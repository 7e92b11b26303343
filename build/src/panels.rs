//! What the figure of a flight shows.

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const MILLIMETRES: f64 = 1e3;

/// Curves in one unit.
pub struct Panel {
    /// Quantity, with symbol and unit.
    pub title: &'static str,
    /// Name of the variable, and its label if there are several.
    pub curves: &'static [(&'static str, &'static str)],
    /// Shown = value * factor.
    pub factor: f64,
    /// Show the deviation from the first value.
    pub deviation: bool,
    /// Constant between communication points, so drawn with steps.
    pub held: bool,
    /// Half of the smallest range shown, so that rounding noise stays flat.
    pub least: f64,
}

const PANEL: Panel =
    Panel { title: "", curves: &[], factor: 1.0, deviation: false, held: false, least: 1e-3 };

/// Left column, then right column.
pub const PANELS: [[Panel; 4]; 2] = [
    [
        Panel { title: "Airspeed V − V(0), m/s", curves: &[("V", "")], deviation: true, ..PANEL },
        Panel {
            title: "Flight-path angle γ, deg",
            curves: &[("gamma", "")],
            factor: DEGREES,
            ..PANEL
        },
        Panel {
            title: "Incidence and attitude, deg",
            curves: &[("alpha", "α"), ("theta", "θ")],
            factor: DEGREES,
            ..PANEL
        },
        Panel { title: "Pitch rate q, deg/s", curves: &[("q", "")], factor: DEGREES, ..PANEL },
    ],
    [
        Panel {
            title: "Flexible modes η − η(0), mm at the nose",
            curves: &[("eta1", "η1"), ("eta2", "η2"), ("eta3", "η3")],
            factor: MILLIMETRES,
            deviation: true,
            least: 0.5,
            ..PANEL
        },
        Panel {
            title: "Slosh displacement s − s(0), mm",
            curves: &[("slosh1", "fore"), ("slosh2", "aft")],
            factor: MILLIMETRES,
            deviation: true,
            least: 0.5,
            ..PANEL
        },
        Panel {
            title: "Elevator in effect δe, deg",
            curves: &[("delta_e_effective", "")],
            factor: DEGREES,
            held: true,
            least: 0.1,
            ..PANEL
        },
        Panel {
            title: "Fuel equivalence ratio in effect φ",
            curves: &[("phi_effective", "")],
            held: true,
            least: 0.01,
            ..PANEL
        },
    ],
];
