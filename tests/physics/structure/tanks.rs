//! Tanks: the limits of Graham and Rodriguez's formulas, and the books of the liquid.

use super::reference::vehicle;
use ahv::error::Error;
use ahv::structure::tanks::{
    SloshSettings, SloshingTank, frequency, mass_ratio, propellant_kg_per_m,
};
use std::f64::consts::PI;

/// Nothing but rounding.
const ROUNDING: f64 = 1e-14;
/// At a depth of 1e-4 of the length, `tanh x = x - x^3/3` leaves 3e-8.
const SHALLOW: f64 = 1e-7;
/// At three lengths depth `1 - tanh(3 pi)` is 1.3e-8.
const DEEP: f64 = 2e-8;

const SETTINGS: SloshSettings =
    SloshSettings { damping_ratio: 0.05, frequency_rad_per_s: 0.0, gravity_m_per_s2: 8.8 };

#[track_caller]
fn close(value: f64, truth: f64, tolerance: f64) {
    assert!((value - truth).abs() <= tolerance * truth.abs(), "{value:e} is not {truth:e}");
}

/// A long wave, half of it in the tank, runs at `sqrt(g h)`; `8/pi^2` of the liquid takes part.
#[test]
fn verif_shallow_liquid_sloshes_as_a_long_wave() {
    let (g, length, depth) = (9.81, 4.0_f64, 4e-4_f64);
    close(frequency(g, length, depth / length), PI / length * (g * depth).sqrt(), SHALLOW);
    close(mass_ratio(depth / length), 8.0 / (PI * PI), SHALLOW);
}

/// A deep-water wave feels no bottom: the sloshing mass stays, the ratio falls with the depth.
#[test]
fn verif_deep_liquid_does_not_feel_the_bottom() {
    let (g, length) = (9.81, 4.0);
    close(frequency(g, length, 3.0), (g * PI / length).sqrt(), DEEP);
    close(3.0 * mass_ratio(3.0), 4.0 * mass_ratio(4.0), DEEP);
    close(3.0 * mass_ratio(3.0), 8.0 / PI.powi(3), DEEP);
}

/// The second antisymmetric mode is the first one of a third of the length: 1/27 of the mass.
#[test]
fn verif_second_mode_is_small_enough_to_freeze() {
    for depth_ratio in [0.75, 1.0, 1.5] {
        let second = mass_ratio(3.0 * depth_ratio) / 9.0;
        close(second / mass_ratio(depth_ratio), 1.0 / 27.0, 0.02);
    }
}

#[test]
fn verif_liquid_is_shared_out_without_loss() {
    let data = vehicle();
    for fuel in [0.0, 0.5, 1.0] {
        let tanks = SloshingTank::pair(&data, fuel, &SETTINGS).unwrap();
        let liquid: f64 = tanks.iter().map(|tank| tank.liquid_mass).sum();
        close(liquid, propellant_kg_per_m(&data, fuel), ROUNDING);
        for tank in tanks {
            close(tank.frozen_mass + tank.sloshing_mass, tank.liquid_mass, ROUNDING);
            assert!(tank.sloshing_mass > 0.0 && tank.frozen_mass > 0.0);
        }
    }
}

#[test]
fn verif_spring_and_damper_give_frequency_and_ratio() {
    let given = SloshSettings { frequency_rad_per_s: 7.5, ..SETTINGS };
    for settings in [SETTINGS, given] {
        for tank in SloshingTank::pair(&vehicle(), 0.4, &settings).unwrap() {
            let omega = (tank.stiffness / tank.sloshing_mass).sqrt();
            close(omega, tank.omega_rad_per_s, ROUNDING);
            let ratio = tank.damping / (2.0 * tank.sloshing_mass * omega);
            close(ratio, settings.damping_ratio, ROUNDING);
        }
    }
    let tanks = SloshingTank::pair(&vehicle(), 0.4, &given).unwrap();
    assert!(tanks.iter().all(|tank| tank.omega_rad_per_s == 7.5));
}

#[test]
fn verif_weightless_liquid_is_refused_unless_its_frequency_is_given() {
    let weightless = SloshSettings { gravity_m_per_s2: -0.1, ..SETTINGS };
    let refused = SloshingTank::pair(&vehicle(), 1.0, &weightless);
    assert!(matches!(refused, Err(Error::NoSloshFrequency { .. })), "{refused:?}");
    let given = SloshSettings { frequency_rad_per_s: 2.0, ..weightless };
    assert!(SloshingTank::pair(&vehicle(), 1.0, &given).is_ok());
}
