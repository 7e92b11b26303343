//! Intake and burner of the FMU against the engine of the first-principles model.
#![allow(missing_docs)]

#[path = "../../../tests/model/mod.rs"]
mod model;

use ahv::air::{Atmosphere, Choking, Intake};
use ahv::data::Data;
use ahv_research::gas::GasError;
use ahv_research::shock_expansion::{Attitude, ShockExpansion};
use model::{assert_close, data, other_engine};
use proptest::prelude::*;

/// Equivalence ratio, over 1 plus itself: both solve the same equations, each by its own iterations.
const SAME: f64 = 1e-11;
const ALTITUDE: f64 = 25_900.0;
/// Captured height against the first-principles model, up to Mach 10 and beyond.
const CAPTURE: f64 = 4e-3;
const CAPTURE_BEYOND: f64 = 4e-2;

fn assert_same(what: &str, got: f64, expected: f64) {
    assert!((got - expected).abs() <= SAME * (1.0 + expected), "{what}: {got} against {expected}");
}

/// The equivalence ratio at which the burner of the first-principles model chokes, by bisection.
fn exact(data: &Data, mach: f64, altitude: f64, alpha: f64) -> Result<f64, GasError> {
    let model = ShockExpansion::new(&data.vehicle, &data.earth);
    let ahead = model.medium.ahead(&Atmosphere::new(&data.earth), mach, altitude);
    let run = |phi| model.loads(&ahead, &Attitude { alpha, delta_e: 0.0, phi }, &|_| 0.0);
    run(0.0)?;
    let (mut low, mut high) = (0.0, 64.0);
    while high - low > 1e-14 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        match run(middle) {
            Ok(_) => low = middle,
            Err(GasError::ThermallyChoked { .. }) => high = middle,
            Err(error) => return Err(error),
        }
    }
    Ok(low)
}

/// The same by the function under test.
fn limit(data: &Data, mach: f64, altitude: f64, alpha: f64) -> f64 {
    let sound_speed = Atmosphere::new(&data.earth).sound_speed(altitude);
    Choking::new(&data.vehicle, &data.earth).margin(mach, alpha, sound_speed, 0.0)
}

#[test]
fn verif_the_intake_takes_what_the_first_principles_model_takes() {
    let data = data();
    let intake = Intake::new(&data.vehicle, &data.earth);
    let model = ShockExpansion::new(&data.vehicle, &data.earth);
    let atmosphere = Atmosphere::new(&data.earth);
    for altitude in [20_000.0, 26_000.0, 40_000.0] {
        for mach in [6.0, 7.0, 8.0, 9.0, 10.0, 11.0] {
            for degrees in [-4.5_f64, -2.0, 0.0, 1.5, 3.0, 6.0, 9.5] {
                let alpha = degrees.to_radians();
                let ahead = model.medium.ahead(&atmosphere, mach, altitude);
                let attitude = Attitude { alpha, delta_e: 0.0, phi: 0.0 };
                let loads = model.loads(&ahead, &attitude, &|_| 0.0).unwrap();
                let expected = loads.mass_flow / model.medium.mass_flux(&ahead);
                let limit = if mach > 10.0 { CAPTURE_BEYOND } else { CAPTURE };
                let found = intake.captured_height(mach, alpha);
                assert_close(&format!("Mach {mach}, {degrees} deg"), found, expected, limit);
            }
        }
    }
}

#[test]
fn verif_the_burner_chokes_where_that_of_the_first_principles_model_does() {
    // From Mach 10.7 on the lip is below the bow shock at small incidence: it takes in less than
    // `intake`, which looks at the shock layer alone, lets the fuel flow for.
    let data = data();
    for altitude in [20_000.0, ALTITUDE, 40_000.0] {
        for mach in (12..=22).map(|half| 0.5 * f64::from(half)) {
            for degrees in -5..=10 {
                let alpha = f64::from(degrees).to_radians();
                let got = limit(&data, mach, altitude, alpha);
                match exact(&data, mach, altitude, alpha) {
                    Ok(expected) => {
                        assert_same(&format!("Mach {mach}, {degrees} deg"), got, expected);
                    }
                    Err(GasError::Choked { .. }) => assert_eq!(got, 0.0, "{mach} {degrees}"),
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
}

#[test]
fn verif_far_outside_the_envelope_too_while_the_fore_body_meets_the_stream() {
    let data = data();
    let mut choked = 0;
    for mach in [2.0, 3.0, 4.0, 5.0, 13.0, 17.0, 22.0, 28.0] {
        for degrees in -6..=15 {
            let alpha = f64::from(degrees).to_radians();
            let got = limit(&data, mach, ALTITUDE, alpha);
            match exact(&data, mach, ALTITUDE, alpha) {
                Ok(expected) => assert_same(&format!("Mach {mach}, {degrees} deg"), got, expected),
                Err(GasError::Choked { .. }) => {
                    assert_eq!(got, 0.0, "{mach} {degrees}");
                    choked += 1;
                }
                // Elsewhere on the vehicle.
                Err(_) => (),
            }
        }
    }
    assert!(choked > 20, "{choked}");
}

#[test]
fn verif_where_the_fore_body_turns_away_the_margin_is_on_the_safe_side() {
    let data = data();
    let lower = data.vehicle.outline.lower_angle_rad.value;
    for mach in [4.0, 6.0, 8.0, 11.0, 15.0] {
        let along = limit(&data, mach, ALTITUDE, -lower);
        for degrees in [0.5, 1.0, 2.0, 4.0] {
            let alpha = -lower - f64::to_radians(degrees);
            assert_eq!(limit(&data, mach, ALTITUDE, alpha), along);
            assert!(exact(&data, mach, ALTITUDE, alpha).unwrap() > along);
        }
    }
}

proptest! {
    #[test]
    fn property_the_limit_holds_for_other_vehicles_and_gases(
        lower in 0.02..0.3f64, duct in 0.3..3.0f64, contraction in 1.0..10.0f64,
        gamma in 1.2..1.66f64, mach in 3.0..25.0f64, turn in 1e-4..0.3f64,
    ) {
        let data = other_engine(lower, duct, contraction, gamma);
        let got = limit(&data, mach, ALTITUDE, turn - lower);
        match exact(&data, mach, ALTITUDE, turn - lower) {
            Ok(expected) => assert_same("other vehicle", got, expected),
            Err(GasError::Choked { .. }) => prop_assert_eq!(got, 0.0),
            Err(_) => (),
        }
    }
}
