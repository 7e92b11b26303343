//! Air against the printed tables of the US Standard Atmosphere 1976.

use crate::model::{assert_close, data};
use ahv::air::Atmosphere;
use ahv::solve::Dual;

/// The tables print five digits.
const PRINTED_DIGITS: f64 = 5e-5;
/// The fit of Parker et al. is local: exact near its centre, 85,000 ft.
const LOCAL_FIT: f64 = 2e-4;

/// Rounding of a dozen operations, grown through seven layers.
const ROUNDING: f64 = 1e-14;

/// Geometric altitude (m), temperature (K), density (kg/m^3), speed of sound (m/s): NOAA-S/T
/// 76-1562, table I.
const TABLE: [[f64; 4]; 7] = [
    [0.0, 288.150, 1.2250, 340.29],
    [5000.0, 255.676, 7.3643e-1, 320.55],
    [11000.0, 216.774, 3.6480e-1, 295.15],
    [20000.0, 216.650, 8.8910e-2, 295.07],
    [25000.0, 221.552, 4.0084e-2, 298.39],
    [30000.0, 226.509, 1.8410e-2, 301.71],
    [50000.0, 270.650, 1.0269e-3, 329.80],
];

#[test]
fn verif_air_matches_the_printed_standard_atmosphere() {
    let atmosphere = Atmosphere::new(&data().earth);
    for [h, temperature, density, sound_speed] in TABLE {
        let air = atmosphere.air(h);
        assert_close("temperature", air.temperature, temperature, PRINTED_DIGITS);
        assert_close("density", air.density, density, PRINTED_DIGITS);
        assert_close("speed of sound", air.sound_speed, sound_speed, PRINTED_DIGITS);
    }
}

#[test]
fn verif_density_is_the_one_the_published_fits_assume() {
    // rho = 6.7429e-5 slug/ft^3 exp(-(h - 85000 ft)/21358 ft): one atmosphere serves all sets.
    let atmosphere = Atmosphere::new(&data().earth);
    let h = 85_000.0 * 0.3048;
    assert_close("density", atmosphere.air(h).density, 6.7429e-5 * 515.3788, LOCAL_FIT);
}

#[test]
fn verif_density_is_the_closed_form_in_every_layer() {
    // US Standard Atmosphere 1976, eqs. 33a and 33b, every 100 m and on both sides of every edge.
    let data = data();
    let (atmosphere, air) = (Atmosphere::new(&data.earth), &data.earth.air);
    let radius = data.earth.earth.radius_m.value;
    let gas_constant = air.gas_constant_j_per_kg_k.value;
    let gravity_over_gas_constant = data.earth.earth.gravity_m_per_s2.value / gas_constant;

    let edges: Vec<f64> = air.layer_base_m.value.iter().copied().chain([air.top_m.value]).collect();
    let (mut base_temperature, mut base_pressure) =
        (air.sea_level_temperature_k.value, air.sea_level_pressure_pa.value);
    for (edge, lapse) in edges.windows(2).zip(&air.layer_lapse_k_per_m.value) {
        let at = |geopotential: f64| {
            let height = geopotential - edge[0];
            let temperature = base_temperature + lapse * height;
            let fall = match lapse {
                0.0 => height / base_temperature,
                _ => (lapse * height / base_temperature).ln_1p() / lapse,
            };
            (temperature, base_pressure * (-gravity_over_gas_constant * fall).exp())
        };
        let inside = (1..).map(|i| edge[0] + 100.0 * f64::from(i)).take_while(|h| *h < edge[1]);
        for geopotential in [edge[0] + 1e-6, edge[1] - 1e-6].into_iter().chain(inside) {
            let air = atmosphere.air(radius * geopotential / (radius - geopotential));
            let (temperature, pressure) = at(geopotential);
            assert_close("temperature", air.temperature, temperature, ROUNDING);
            assert_close("density", air.density, pressure / (gas_constant * temperature), ROUNDING);
        }
        (base_temperature, base_pressure) = at(edge[1]);
    }
}

#[test]
fn verif_pressure_falls_with_the_weight_of_the_air() {
    // Hydrostatic balance dp/dh = -rho g, with p = rho R T, by dual numbers; in every layer.
    let data = data();
    let atmosphere = Atmosphere::new(&data.earth);
    let gas = data.earth.air.gas_constant_j_per_kg_k.value;
    for h in [500.0, 8000.0, 15000.0, 25900.0, 40000.0, 49000.0, 60000.0, 80000.0] {
        let air = atmosphere.air(Dual::<1>::variable(h, 0));
        let pressure = air.density * air.temperature * gas;
        let weight = air.density.re * atmosphere.gravity(h).0;
        assert_close("dp/dh", pressure.eps[0], -weight, 1e-10);
    }
}

#[test]
fn verif_air_is_finite_wherever_an_integrator_may_look() {
    let atmosphere = Atmosphere::new(&data().earth);
    for h in [-1e9, -1e4, -1.0, 9e4, 1e6, 1e12, f64::NAN] {
        let air = atmosphere.air(h);
        assert!(air.density > 0.0 && air.sound_speed > 0.0, "{h} m: {air:?}");
    }
}
