//! Panels of the figure of a flight.

const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const MILLIMETRES: f64 = 1e3;

/// A panel: curves in one unit.
pub struct Panel {
    /// Quantity, with symbol and unit.
    pub title: &'static str,
    /// Variable and, if there are several curves, label of each.
    pub curves: &'static [(&'static str, &'static str)],
    /// Displayed value over value.
    pub factor: f64,
    /// Whether the deviation from the first value is shown.
    pub deviation: bool,
    /// Half of the smallest range shown, so that rounding errors are not magnified.
    pub min_half_range: f64,
}

const PANEL: Panel =
    Panel { title: "", curves: &[], factor: 1.0, deviation: false, min_half_range: 1e-3 };

/// In reading order: inputs, then response.
pub const PANELS: [Panel; 9] = [
    Panel {
        title: "Elevator in effect δe, deg",
        curves: &[("delta_e_effective", "")],
        factor: DEGREES,
        min_half_range: 0.1,
        ..PANEL
    },
    Panel {
        title: "Fuel ratio in effect φ",
        curves: &[("phi_effective", "")],
        min_half_range: 0.01,
        ..PANEL
    },
    Panel {
        title: "Gust, m/s",
        curves: &[("w_gust", "upwards"), ("u_gust", "tail wind")],
        min_half_range: 0.1,
        ..PANEL
    },
    Panel { title: "Airspeed V − V(0), m/s", curves: &[("V", "")], deviation: true, ..PANEL },
    Panel {
        title: "Flight-path angle γ, deg", curves: &[("gamma", "")], factor: DEGREES, ..PANEL
    },
    Panel {
        title: "Angles, deg",
        curves: &[("alpha", "incidence α"), ("theta", "attitude θ")],
        factor: DEGREES,
        ..PANEL
    },
    Panel { title: "Pitch rate q, deg/s", curves: &[("q", "")], factor: DEGREES, ..PANEL },
    Panel {
        title: "Modes, mm at the nose",
        curves: &[("eta1", "η1"), ("eta2", "η2"), ("eta3", "η3")],
        factor: MILLIMETRES,
        deviation: true,
        min_half_range: 0.05,
    },
    Panel {
        title: "Slosh s − s(0), mm",
        curves: &[("slosh1", "fore"), ("slosh2", "aft")],
        factor: MILLIMETRES,
        deviation: true,
        min_half_range: 0.05,
    },
];
