//! Gas relations against printed tables and against the conservation laws they come from.
#![allow(missing_docs)]

#[path = "../../../tests/model/mod.rs"]
mod model;

use ahv_research::gas::{Gas, GasError};
use model::assert_close;
use proptest::prelude::*;

const AIR: Gas = Gas { gamma: 1.4 };
/// Sums and powers of a handful of terms.
const ROUNDING: f64 = 1e-12;
/// A root of a function that is flat there keeps half of the digits less than its value does.
const INVERSE: f64 = 1e-9;

/// Agreement to the digits of a printed table: half a unit of the last one, and as much again for
/// tables that were rounded from rounded numbers.
fn printed(what: &str, got: f64, table: &str) {
    let digits = table.split('.').nth(1).map_or(0, str::len);
    let expected: f64 = table.parse().unwrap();
    let unit = 10f64.powi(-(digits as i32));
    assert!((got - expected).abs() <= unit, "{what}: {got}, printed {table}");
}

#[test]
fn verif_normal_shock_as_printed_in_naca_1135_table_2() {
    for (mach, behind, pressure, density, temperature, total) in [
        (1.5, "0.7011", "2.458", "1.862", "1.320", "0.9298"),
        (2.0, "0.5774", "4.500", "2.667", "1.688", "0.7209"),
        (3.0, "0.4752", "10.33", "3.857", "2.679", "0.3283"),
        (5.0, "0.4152", "29.00", "5.000", "5.800", "0.06172"),
        (8.0, "0.3929", "74.50", "5.565", "13.39", "0.008488"),
    ] {
        let shock = AIR.normal_shock(mach).unwrap();
        printed("M2", shock.mach, behind);
        printed("p2/p1", shock.pressure, pressure);
        printed("rho2/rho1", shock.density, density);
        printed("T2/T1", shock.temperature, temperature);
        printed("p02/p01", shock.total_pressure, total);
    }
}

#[test]
fn verif_isentropic_ratios_and_expansion_as_printed_in_naca_1135_table_2() {
    for (mach, pressure, temperature, area, angle) in [
        (1.5, "0.2724", "0.6897", "1.176", "11.91"),
        (2.0, "0.1278", "0.5556", "1.688", "26.38"),
        (3.0, "0.02722", "0.3571", "4.235", "49.76"),
        (5.0, "0.001890", "0.1667", "25.00", "76.92"),
        (8.0, "0.0001024", "0.07246", "190.1", "95.62"),
    ] {
        printed("p/p0", 1.0 / AIR.total_pressure(mach), pressure);
        printed("T/T0", 1.0 / AIR.total_temperature(mach), temperature);
        printed("A/A*", AIR.area(mach), area);
        printed("nu", AIR.prandtl_meyer(mach).unwrap().to_degrees(), angle);
    }
}

#[test]
fn verif_oblique_shocks_as_read_from_naca_1135_chart_2() {
    for (mach, turn, angle) in
        [(2.0, 10.0, "39.31"), (3.0, 20.0, "37.76"), (5.0, 10.0, "19.38"), (5.0, 20.0, "29.80")]
    {
        let shock = AIR.oblique_shock(mach, f64::to_radians(turn)).unwrap();
        printed("beta", shock.angle.to_degrees(), angle);
    }
    let (angle, turn) = AIR.largest_turn(2.0);
    printed("theta_max", turn.to_degrees(), "22.97");
    printed("beta_max", angle.to_degrees(), "64.67");
}

#[test]
fn verif_heat_addition_as_printed_in_anderson_table_a3() {
    for (mach, total, pressure) in
        [(1.5, "0.9093", "0.5783"), (2.0, "0.7934", "0.3636"), (3.0, "0.6540", "0.1765")]
    {
        printed("T0/T0*", AIR.rayleigh_total_temperature(mach), total);
        printed("p/p*", AIR.rayleigh_pressure(mach), pressure);
    }
}

#[test]
fn verif_what_does_not_exist_is_an_error() {
    assert!(matches!(AIR.normal_shock(0.9), Err(GasError::Subsonic { .. })));
    assert!(matches!(AIR.prandtl_meyer(f64::NAN), Err(GasError::Subsonic { .. })));
    assert!(matches!(AIR.oblique_shock(2.0, 0.41), Err(GasError::Detached { .. })));
    assert!(matches!(AIR.oblique_shock(2.0, -0.1), Err(GasError::Detached { .. })));
    assert!(matches!(AIR.oblique_shock(2.0, f64::NAN), Err(GasError::Detached { .. })));
    assert!(matches!(AIR.mach_from_prandtl_meyer(-0.1), Err(GasError::Expansion { .. })));
    // Vacuum: 130.45 deg.
    assert!(matches!(AIR.mach_from_prandtl_meyer(2.277), Err(GasError::Expansion { .. })));
    assert!(matches!(AIR.mach_from_area(0.99), Err(GasError::Choked { .. })));
    let error = AIR.heated(2.0, 1.3).unwrap_err();
    let GasError::ThermallyChoked { limit, .. } = error else { panic!("{error}") };
    assert_close("limit", limit, 1.0 / AIR.rayleigh_total_temperature(2.0), ROUNDING);
    assert!(error.to_string().contains("takes 1.26"), "{error}");
}

#[test]
fn verif_a_shock_that_turns_nothing_is_a_mach_wave() {
    for mach in [1.0, 1.2, 8.0, 30.0] {
        let shock = AIR.oblique_shock(mach, 0.0).unwrap();
        assert_close("wave", shock.angle, (1.0 / mach).asin(), INVERSE);
        // The jump is proportional to the turn, so it inherits the rounding of the angle.
        assert_close("pressure", shock.jump.pressure, 1.0, INVERSE);
        assert_close("Mach", shock.jump.mach, mach, INVERSE);
    }
}

proptest! {
    #[test]
    fn property_oblique_shock_conserves_mass_momentum_and_energy(
        mach in 1.05..25.0f64, share in 0.001..0.999f64, gamma in 1.1..1.67f64,
    ) {
        let gas = Gas { gamma };
        let turn = share * gas.largest_turn(mach).1;
        let shock = gas.oblique_shock(mach, turn).unwrap();
        let (jump, angle) = (shock.jump, shock.angle);
        // In units of the pressure, density and speed of sound over sqrt(gamma) ahead.
        let (ahead, behind) =
            (mach * gamma.sqrt(), jump.mach * (gamma * jump.temperature).sqrt());
        let normal = [ahead * angle.sin(), behind * (angle - turn).sin()];
        let along = [ahead * angle.cos(), behind * (angle - turn).cos()];
        assert_close("mass", jump.density * normal[1], normal[0], INVERSE);
        assert_close("tangential momentum", along[1], along[0], INVERSE);
        let momentum = [
            1.0 + normal[0] * normal[0],
            jump.pressure + jump.density * normal[1] * normal[1],
        ];
        assert_close("normal momentum", momentum[1], momentum[0], INVERSE);
        let energy = jump.temperature * gas.total_temperature(jump.mach);
        assert_close("energy", energy, gas.total_temperature(mach), INVERSE);
        let total = jump.pressure * gas.total_pressure(jump.mach) / gas.total_pressure(mach);
        assert_close("stagnation pressure", jump.total_pressure, total, INVERSE);
        // The weak branch lies between the Mach wave and the shock that turns most.
        prop_assert!(angle >= (1.0 / mach).asin() && angle <= gas.largest_turn(mach).0);
        prop_assert!(jump.total_pressure <= 1.0 + ROUNDING && jump.pressure >= 1.0 - ROUNDING);
    }

    #[test]
    fn property_inverses_return_to_where_they_started(mach in 1.001..40.0f64) {
        let angle = AIR.prandtl_meyer(mach).unwrap();
        assert_close("nu", AIR.mach_from_prandtl_meyer(angle).unwrap(), mach, INVERSE);
        assert_close("A/A*", AIR.mach_from_area(AIR.area(mach)).unwrap(), mach, INVERSE);
    }

    #[test]
    fn property_heat_addition_conserves_mass_and_impulse(
        mach in 1.1..20.0f64, share in 0.0..0.999f64,
    ) {
        let ratio = 1.0 + share * (1.0 / AIR.rayleigh_total_temperature(mach) - 1.0);
        let hot = AIR.heated(mach, ratio).unwrap();
        prop_assert!(hot >= 1.0 && hot <= mach * (1.0 + ROUNDING));
        let pressure = AIR.rayleigh_pressure(hot) / AIR.rayleigh_pressure(mach);
        let impulse = |mach: f64| 1.0 + 1.4 * mach * mach;
        assert_close("impulse", pressure * impulse(hot), impulse(mach), ROUNDING);
        let temperature =
            ratio * AIR.total_temperature(mach) / AIR.total_temperature(hot);
        // Mass flow is p M / sqrt(T).
        assert_close("mass", pressure * hot / temperature.sqrt(), mach, INVERSE);
    }

    #[test]
    fn property_weak_shock_and_expansion_agree_to_second_order(mach in 2.0..20.0f64) {
        let turn = 1e-3 / mach;
        let shock = AIR.oblique_shock(mach, turn).unwrap().jump.pressure;
        let slower = AIR.mach_from_prandtl_meyer(AIR.prandtl_meyer(mach).unwrap() - turn).unwrap();
        let wave = AIR.total_pressure(mach) / AIR.total_pressure(slower);
        prop_assert!(((shock - 1.0) / (wave - 1.0) - 1.0).abs() < 1e-6);
    }
}
