//! Unit and range of each number, from the ending of its key.

use crate::short::short;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Ending of a key, unit and range; the first match applies. The ranges exceed those of any vehicle, and
/// the equations are finite within them. Relations between numbers are checked in `validate`.
const KINDS: [(&str, &str, [f64; 2]); 48] = [
    // The lower limit resolves three bending modes. Beyond 2,000 the frequencies change by 1e-6, and a
    // start with fuel burn, with modes at 17 fuel levels, is slow.
    ("elements", "1", [8.0, 2000.0]),
    ("_kg_m2_per_m", "kg m^2/m", [1.0, 1e10]),
    ("_n_m2_per_m", "N m^2/m", [1.0, 1e13]),
    ("_kg_per_m2", "kg/m^2", [1e-3, 1e6]),
    ("_j_per_kg_k", "J/(kg K)", [1.0, 1e5]),
    // As for the parameter.
    ("slosh_frequency_rad_per_s", "rad/s", [0.0, 100.0]),
    ("_rad_per_s", "rad/s", [0.0, 1e4]),
    ("_j_per_kg", "J/kg", [1e3, 1e10]),
    ("_m_per_s2", "m/s^2", [1e-3, 1e3]),
    ("_m2_per_m", "m^2/m", [1e-3, 1e3]),
    ("_k_per_m", "K/m", [-1.0, 1.0]),
    // Slender body: at most 45 deg.
    ("lower_angle_rad", "rad", [1e-3, FRAC_PI_4]),
    ("upper_angle_rad", "rad", [1e-3, FRAC_PI_4]),
    ("_limit_rad", "rad", [1e-6, FRAC_PI_2]),
    ("_rad", "rad", [-FRAC_PI_2, FRAC_PI_2]),
    ("_pa", "Pa", [1e-3, 1e8]),
    ("_k", "K", [1.0, 1e4]),
    ("radius_m", "m", [1e3, 1e9]),
    ("altitude_m", "m", [0.0, 85_000.0]),
    ("layer_base_m", "m", [0.0, 1e5]),
    ("top_m", "m", [1.0, 1e5]),
    // Corrections of stations.
    ("_shift_m", "m", [-100.0, 100.0]),
    ("_offset_m", "m", [-100.0, 100.0]),
    ("length_m", "m", [1e-3, 1e3]),
    ("chord_m", "m", [1e-3, 1e3]),
    ("depth_full_m", "m", [1e-3, 1e3]),
    ("duct_height_m", "m", [1e-3, 1e3]),
    ("_station_m", "m", [0.0, 1e3]),
    ("_m", "m", [-1e3, 1e3]),
    // Coefficients of eq. (4).
    ("alpha3", "1/rad^3", [-1e5, 1e5]),
    ("delta_e3", "1/rad^3", [-1e5, 1e5]),
    ("alpha_delta_e", "1/rad^2", [-1e4, 1e4]),
    ("alpha2", "1/rad^2", [-1e4, 1e4]),
    ("delta_e2", "1/rad^2", [-1e4, 1e4]),
    ("alpha", "1/rad", [-1e3, 1e3]),
    ("delta_e", "1/rad", [-1e3, 1e3]),
    ("constant", "1", [-100.0, 100.0]),
    // Fractions and ratios.
    ("_fraction", "1", [0.0, 1.0]),
    ("share", "1", [1e-6, 1.0]),
    ("_damping", "1", [0.0, 1.0]),
    ("_efficiency", "1", [1e-3, 1.0]),
    ("elastic_scale", "1", [1e-3, 1e3]),
    ("area_ratio", "1", [1.0, 1e3]),
    ("stoichiometric_ratio", "1", [1e-6, 1.0]),
    ("heat_capacity_ratio", "1", [1.01, 2.0]),
    ("choking_margin", "1", [-1.0, 1.0]),
    ("phi_limit", "1", [1e-3, 10.0]),
    // As for the parameter.
    ("mach", "1", [0.1, 30.0]),
];

/// What is wrong with a number, by its key and unit.
pub fn problem(key: &str, unit: &str, value: f64) -> Option<String> {
    let known = KINDS.iter().find(|(ending, ..)| key.ends_with(ending));
    let Some((_, promised, [min, max])) = known else {
        return Some("unknown quantity".into());
    };
    if unit != *promised {
        return Some(format!("the unit is {unit}, must be {promised}"));
    }
    if (*min..=*max).contains(&value) {
        return None;
    }
    let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
    let [value, min, max] = [value, *min, *max].map(short);
    Some(format!("{value} must lie in [{min}, {max}]{unit}"))
}
