//! A pitch inertia that no body with these masses has is refused, with the numbers.

use crate::explicit::air::speed_and_gravity;
use crate::explicit::books::Books;
use crate::model::{AERO_SETS, CONFIGURATIONS, assert_close, data, options};
use ahv::error::Error;
use ahv::vehicle::{Configuration, Factors, Vehicle, VehicleOptions};

/// Sums over 500 elements; the least inertia is a difference of them.
const ROUNDING: f64 = 1e-9;
/// Beside the least inertia.
const ASIDE: f64 = 1e-4;

#[test]
fn verif_an_inertia_that_leaves_the_body_none_is_refused_with_its_numbers() {
    let data = data();
    for aero in AERO_SETS {
        for fuel_fraction in [0.05, 0.5, 1.0] {
            for mass_centre_shift_m in [0.0, 0.5, -2.0] {
                let with = |inertia: f64| {
                    let factors = Factors { mass_centre_shift_m, inertia, ..Factors::default() };
                    VehicleOptions {
                        aero,
                        fuel_fraction,
                        factors,
                        ..options(Configuration::SloshBeam)
                    }
                };
                let plain = with(1.0);
                let [_, gravity] = speed_and_gravity(&data.earth, &plain.condition);
                let books = |inertia: f64| {
                    let wanted = (&with(inertia)).into();
                    Books::new(&data.vehicle, data.aero(aero), &wanted, gravity)
                };
                let factor = books(1.0).least_inertia() / books(1.0).total.inertia;

                let enough = Vehicle::new(&data, &with(factor * (1.0 + ASIDE)));
                let body = enough.unwrap_or_else(|error| panic!("{error}"));
                let expected = books(factor * (1.0 + ASIDE));
                assert_close("inertia", body.airframe.inertia, expected.total.inertia, ROUNDING);

                for factor in [factor * (1.0 - ASIDE), 0.5 * factor, 0.0] {
                    let refused = Vehicle::new(&data, &with(factor));
                    let Err(Error::Inertia { inertia, least, own, shift_m }) = refused else {
                        panic!("{aero:?}, {fuel_fraction}, {mass_centre_shift_m}: {factor}");
                    };
                    let books = books(factor);
                    assert!(inertia < least, "{inertia} {least}");
                    assert!((inertia - books.total.inertia).abs() < ROUNDING * least);
                    assert_close("least", least, books.least_inertia(), ROUNDING);
                    assert_close("own", own, books.own.inertia, ROUNDING);
                    assert!((shift_m - (books.total.centre - books.own.centre)).abs() < ROUNDING);
                }
            }
        }
    }
}

#[test]
fn verif_no_configuration_flies_without_inertia() {
    let data = data();
    for configuration in CONFIGURATIONS {
        for inertia in [0.0, -1.0] {
            let factors = Factors { inertia, ..Factors::default() };
            let refused =
                Vehicle::new(&data, &VehicleOptions { factors, ..options(configuration) });
            assert!(matches!(refused, Err(Error::Inertia { .. })), "{configuration:?}");
        }
    }
}
