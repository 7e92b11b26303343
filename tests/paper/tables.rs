//! Against what the paper prints. What the default set reaches is held as a limit for each kind of
//! number, so that a change shows.

use super::printed::{FLEXIBLE, ends, floats, pairs, printed, published, seen, size};
use crate::model::{CONFIGURATIONS, assert_close, data, deviation, options, vehicle, vehicle_with};
use ahv::data::AeroSet::{Parker2007, Xu2015};
use ahv::vehicle::{ALPHA, Configuration, H, V, Vehicle};

/// Table 1 is met by identified data, to more digits than it prints.
const TABLE1: f64 = 1e-3;

#[test]
fn paper_table1_frequencies() {
    let table = published();
    for (column, configuration) in FLEXIBLE {
        let vehicle = vehicle(configuration);
        for (i, printed) in floats(&table["table1"][column]).into_iter().enumerate() {
            assert_close(&format!("{column} mode {}", i + 1), vehicle.omega[i], printed, TABLE1);
        }
    }
}

#[test]
fn paper_table2_signs_and_order_hold_with_published_and_identified_coefficients() {
    // One unstable and one stable short-period pole, growing from rigid over even to slosh, and
    // every aeroelastic pair damped, near the printed frequency.
    for set in [Xu2015, Parker2007] {
        let mut unstable = 0.0;
        for configuration in CONFIGURATIONS {
            let poles = seen(set, configuration).linear.poles();
            let [right, left] = ends(&poles);
            assert!(right > unstable, "{set:?}, {configuration:?}");
            assert!(left < -unstable, "{set:?}, {configuration:?}");
            unstable = right;
            let fast: Vec<_> = poles.iter().filter(|pole| pole.im > 1.0).collect();
            assert!(fast.iter().all(|pole| pole.re < 0.0), "{set:?}, {configuration:?}");
        }
        for (column, configuration) in FLEXIBLE {
            let poles = seen(set, configuration).linear.poles();
            for [_, frequency] in printed(column).poles {
                let nearest = poles
                    .iter()
                    .map(|pole| deviation(pole.im, frequency, 1.0))
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest < 0.041, "{set:?}, {column}: {frequency} is off by {nearest}");
            }
        }
    }
}

/// The growth is one of seven facts that the tanks are identified from; more than one standard error
/// (`cargo ahv identify beam`).
const GROWTH: f64 = 0.015;

#[test]
fn paper_table2_short_period_grows_from_even_to_sloshing_mass() {
    let of = |configuration| size(ends(&seen(Xu2015, configuration).linear.poles()));
    let growth = of(Configuration::SloshBeam) / of(Configuration::EvenMassBeam);
    let wanted = size(printed("slosh").short_period) / size(printed("even").short_period);
    assert_close("growth", growth, wanted, GROWTH);
}

/// What xu2015 reaches with one vehicle for all columns, relative.
const SHORT_PERIOD: f64 = 0.05;
/// Size of the pair of real zeros, against the geometric mean of the printed pair (erratum 14).
const REAL_ZEROS: f64 = 0.08;
const FREQUENCY: f64 = 0.02;
/// Of the first pole of the slosh column: Table 1 prints 23.34 without air and Table 2 23.78 with it,
/// and air lowers it.
const FIRST_SLOSH_FREQUENCY: f64 = 0.04;
const DAMPING: f64 = 0.10;
/// One damping ratio serves the first mode of both columns.
const FIRST_SLOSH_DAMPING: f64 = 0.13;
/// The decay of a zero is not held: it is a small difference of what sensor and controls see.
const ZERO_FREQUENCY: f64 = 0.10;

#[test]
fn paper_tables_2_and_3_as_far_as_xu2015_carries() {
    for (column, configuration) in ["rigid", "even", "slosh"].into_iter().zip(CONFIGURATIONS) {
        let linear = seen(Xu2015, configuration).linear;
        let (poles, zeros, printed) = (linear.poles(), linear.zeros(), printed(column));
        for (found, printed) in ends(&poles).into_iter().zip(printed.short_period) {
            assert_close(&format!("{column}: short period"), found, printed, SHORT_PERIOD);
        }
        let mean = size(printed.zeros);
        assert_close(&format!("{column}: zeros"), size(ends(&zeros)), mean, REAL_ZEROS);
        if configuration == Configuration::Rigid {
            continue;
        }
        for (mode, (found, [decay, omega])) in pairs(&poles).iter().zip(printed.poles).enumerate() {
            let what = format!("{column}: pole of mode {}", mode + 1);
            let (frequency, damping) = match (configuration, mode) {
                (Configuration::SloshBeam, 0) => (FIRST_SLOSH_FREQUENCY, FIRST_SLOSH_DAMPING),
                _ => (FREQUENCY, DAMPING),
            };
            assert_close(&what, found.im, omega, frequency);
            assert_close(&what, found.re, decay, damping);
        }
        for (mode, (found, [_, omega])) in pairs(&zeros).iter().zip(printed.pairs).enumerate() {
            let what = format!("{column}: zero of mode {}", mode + 1);
            assert_close(&what, found.im, omega, ZERO_FREQUENCY);
            assert!(found.re < 0.0, "{what}: {found}");
        }
    }
}

#[test]
fn paper_published_trim_closes_lift_but_not_moment() {
    // Parker et al. print alpha 1.5153 deg, delta_e 11.4635 deg, phi 0.2514 at 85,000 ft and
    // 7702.08 ft/s. The printed fits carry the weight less the centrifugal part there to 1 %;
    // thrust and drag differ by 7 %, and a moment remains, so the digits are not of these fits.
    let vehicle = vehicle_with(Parker2007, Configuration::Rigid);
    let radians = std::f64::consts::PI / 180.0;
    let mut x = [0.0; ahv::vehicle::STATES];
    x[V] = 7702.08 * 0.3048;
    x[H] = 85_000.0 * 0.3048;
    x[ALPHA] = 1.5153 * radians;
    let loads = vehicle.loads(&x, &[11.4635 * radians, 0.2514]);
    let (gravity, distance) = vehicle.atmosphere.gravity(x[H]);
    let weight = vehicle.airframe.mass * (gravity - x[V] * x[V] / distance);
    let up = loads.lift + loads.thrust * x[ALPHA].sin();
    assert_close("lift", up, weight, 1e-2);
    let imbalance = loads.thrust * x[ALPHA].cos() / loads.drag - 1.0;
    assert!((0.05..0.09).contains(&imbalance), "{imbalance}");
    assert!(loads.moment.abs() > 4e4, "{}", loads.moment);
}

#[test]
fn paper_less_propellant_raises_the_frequencies() {
    // Conclusion (1), and the sense of fig. 6.
    let mut last = [0.0; 3];
    for percent in [100, 75, 50, 25, 0] {
        let options = ahv::vehicle::VehicleOptions {
            fuel_fraction: f64::from(percent) / 100.0,
            ..options(Configuration::SloshBeam)
        };
        let vehicle = Vehicle::new(&data(), &options).unwrap();
        for (omega, last) in vehicle.omega.iter().zip(&mut last) {
            assert!(*omega > *last, "{percent} % fuel: {omega} after {last}");
            *last = *omega;
        }
    }
}

#[test]
fn paper_the_default_flight_is_the_papers_condition() {
    let condition = crate::model::setup(&[]).parameters.options.condition;
    assert_eq!((condition.mach, condition.altitude, condition.gamma), (8.0, 25_900.0, 0.0));
}
