//! The vehicle between its fuel levels, at levels with no system.

use super::fuel_table::{NOTHING, kinds};
use crate::model::{data, options};
use ahv::vehicle::{Airframe, Body, Configuration, Vehicle, VehicleDefinition, VehicleOptions};

/// Error of a coefficient over the largest of its kind; two thirds of it are needed.
const INTERPOLATED: f64 = 1e-5;
/// The same of the turning of the shapes.
const TURNING: f64 = 1e-4;
/// A turning that is no larger, m/kg, is there by rounding: the shapes of an even beam stay.
const STILL: f64 = 1e-8;
/// Step of a difference quotient, as a part of the filling.
const STEP: f64 = 2e-3;
const SAMPLES: u32 = 40;

fn builds() -> Vec<VehicleOptions> {
    let build = |configuration, fuel_fraction| VehicleOptions {
        fuel_burn: true,
        fuel_fraction,
        ..options(configuration)
    };
    let slosh = [1.0, 0.5, 0.1].map(|fraction| build(Configuration::SloshBeam, fraction));
    let even = [1.0, 0.1].map(|fraction| build(Configuration::EvenMassBeam, fraction));
    [&slosh[..], &even].concat()
}

/// Levels by the golden ratio; every second is in nearly empty tanks.
fn fractions(options: &VehicleOptions) -> impl Iterator<Item = f64> {
    let places = (1..=SAMPLES).map(|i| (f64::from(i) * 0.618_033_988_749_894_9).fract());
    let full = options.fuel_fraction;
    places.enumerate().map(move |(i, x)| full * if i % 2 == 0 { x } else { x * x * x })
}

/// Checks the error at a fuel fraction in all builds, against a limit.
fn check(limit: f64, error: impl Fn(&Case, f64) -> f64) {
    let data = data();
    for options in builds() {
        let definition = VehicleDefinition::new(&data, &options);
        let start = Body::new(&definition).unwrap();
        let vehicle = Vehicle::with_body(&definition, &start).unwrap();
        let case = Case { definition, start, vehicle };
        for fraction in fractions(&options) {
            let error = error(&case, fraction);
            let configuration = options.configuration;
            assert!(error < limit, "{configuration:?} at {fraction}: {error:.1e}");
        }
    }
}

/// A vehicle that burns fuel, and what it is at the start.
struct Case {
    definition: VehicleDefinition,
    start: Body,
    vehicle: Vehicle,
}

impl Case {
    /// Solved directly.
    fn body(&self, fraction: f64) -> Body {
        Body::aligned(&self.definition.at(fraction), &self.start).unwrap()
    }

    /// From the table.
    fn between(&self, fraction: f64) -> Airframe {
        let fuel = self.vehicle.fuel * fraction / self.definition.options.fuel_fraction;
        self.vehicle.fuel_table.as_ref().unwrap().airframe(fuel)
    }
}

#[test]
fn verif_at_any_level_the_coefficients_are_right_to_five_digits() {
    check(INTERPOLATED, |case, fraction| {
        let direct = case.body(fraction).airframe(&case.definition.at(fraction)).unwrap().to_row();
        let between = case.between(fraction).to_row();
        let error = |kind: Vec<usize>| {
            let size = kind.iter().fold(NOTHING, |a, i| a.max(direct[*i].abs()));
            kind.into_iter().map(|i| (between[i] - direct[i]).abs() / size).fold(0.0, f64::max)
        };
        kinds().into_iter().map(error).fold(0.0, f64::max)
    });
}

#[test]
fn verif_at_any_level_the_shapes_turn_as_their_difference_quotient_says() {
    check(TURNING, |case, fraction| {
        let step = STEP * (fraction + case.definition.vehicle.mass.residual_fraction.value);
        let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0]
            .map(|steps| case.body(fraction + steps * step).displacements().concat());
        let fraction_per_fuel = case.definition.options.fuel_fraction / case.vehicle.fuel;
        let slopes: Vec<f64> = (0..a.len())
            .map(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * step) * fraction_per_fuel)
            .collect();
        let body = case.body(fraction);
        let slopes: Vec<_> = slopes.chunks(a.len() / body.modes.count).map(Vec::from).collect();
        let expected = body.products(&slopes).concat();
        let turning = case.between(fraction).turning.concat();
        let size = expected.iter().fold(STILL, |a, b| a.max(b.abs()));
        turning.iter().zip(&expected).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max)
    });
}
