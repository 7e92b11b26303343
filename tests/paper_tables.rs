//! Against what the paper prints. Cells that a coefficient set does not give are pinned as the
//! distance they have, so that a change shows.
#![allow(missing_docs)]

mod model;

use ahv::dynamics::Vehicle;
use ahv::linear::Linear;
use ahv::trim::trim;
use ahv::vehicle::AeroSet::{Parker2007, Xu2015};
use ahv::vehicle::Configuration;
use model::{
    AERO_SETS, CONFIGURATIONS, assert_close, build, data, deviation, flight, vehicle, vehicle_with,
};
use nalgebra::Complex;

/// Table 1 is met by identified data, to more digits than it prints.
const TABLE1: f64 = 1e-3;
/// "about 1 %": the published fits with the inertia that the paper's short period asks for.
const RIGID_VEHICLE: f64 = 0.01;
/// Pitch inertia, kg m^2/m, with which the published fits give the printed short period. The
/// printed 2.224e5 and the published 2.224e6 both fail.
const INERTIA_OF_THE_POLES: f64 = 6.5e5;

/// Columns with flexible modes.
const FLEXIBLE: [(&str, Configuration); 2] =
    [("even", Configuration::EvenMassBeam), ("slosh", Configuration::SloshBeam)];

fn published() -> toml::Table {
    include_str!("../src/data/published.toml").parse().expect("valid TOML")
}

fn floats(value: &toml::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|entry| entry.as_float().unwrap()).collect()
}

fn linear(vehicle: &Vehicle) -> Linear {
    let condition = build(Configuration::Rigid).condition;
    let trim = trim(vehicle, &condition).expect("the paper's flight condition has a trim");
    Linear::new(vehicle, &trim.state, &trim.control)
}

fn real_parts(values: &[Complex<f64>]) -> Vec<f64> {
    let mut real: Vec<_> = values.iter().filter(|v| v.im == 0.0).map(|v| v.re).collect();
    real.sort_by(|a, b| b.total_cmp(a));
    real
}

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
fn paper_table2_rigid_short_period_asks_for_an_inertia_that_is_not_printed() {
    let printed = floats(&published()["table2"]["rigid"]["short_term"]);
    let mut vehicle = vehicle_with(Parker2007, Configuration::Rigid);
    let short_period = |vehicle: &Vehicle| {
        let real = real_parts(&linear(vehicle).poles());
        [real[0], real[real.len() - 1]]
    };
    vehicle.airframe.inertia = INERTIA_OF_THE_POLES;
    let found = short_period(&vehicle);
    assert_close("unstable pole", found[0], printed[0], RIGID_VEHICLE);
    assert_close("stable pole", found[1], printed[1], RIGID_VEHICLE);
    for inertia in [2.224e5, data().parker2007.inertia.i_yy_kg_m2_per_m.value] {
        vehicle.airframe.inertia = inertia;
        assert!(deviation(short_period(&vehicle)[0], printed[0], 1.0) > 0.4, "{inertia}");
    }
}

#[test]
fn paper_table3_rigid_zeros_cannot_be_unequal() {
    // Eqs (3)-(4) of a rigid body have no q-dependence: its zeros are 0 and an exact +- pair, for
    // any coefficients. The printed 5.4308 and -7.2210 cannot come from them. Their geometric mean
    // is the pair's size for the inertia above.
    let printed = floats(&published()["table3"]["rigid"]["real"]);
    let mut vehicle = vehicle_with(Parker2007, Configuration::Rigid);
    vehicle.airframe.inertia = INERTIA_OF_THE_POLES;
    let zeros = real_parts(&linear(&vehicle).zeros());
    assert_eq!(zeros.len(), 3);
    assert!((zeros[0] + zeros[2]).abs() < 1e-12 * zeros[0]);
    assert!(zeros[1].abs() < 1e-12);
    let mean = (printed[0] * -printed[1]).sqrt();
    assert_close("geometric mean", zeros[0], mean, RIGID_VEHICLE);
}

#[test]
fn paper_table2_phugoid_cannot_be_printed_as_it_is() {
    // Level flight in an exponential atmosphere oscillates with sqrt(g (1 - V^2/(g r))/h_s): about
    // 0.037 rad/s at Mach 8, not 0.0238. No coefficient of the air is in it.
    let printed = floats(&published()["table2"]["rigid"]["long_term"])[1];
    for set in AERO_SETS {
        let vehicle = vehicle_with(set, Configuration::Rigid);
        let poles = linear(&vehicle).poles();
        let phugoid = poles.iter().find(|pole| pole.im > 0.0).unwrap().im;
        let (h, v) = (25_900.0, 8.0 * vehicle.atmosphere.air(25_900.0).sound_speed);
        let (gravity, distance) = vehicle.atmosphere.gravity(h);
        let step = 10.0;
        let density = |h: f64| vehicle.atmosphere.air(h).density;
        let scale_height = 2.0 * step * density(h) / (density(h - step) - density(h + step));
        let expected = ((gravity - v * v / distance) / scale_height).sqrt();
        assert_close("phugoid", phugoid, expected, 0.02);
        assert!(deviation(printed, phugoid, 1.0e-9) > 0.3);
    }
}

#[test]
fn paper_table2_rigid_height_pole_must_be_zero() {
    // All forces of eq. (4) go with dynamic pressure, so there is a line of steady flights.
    let printed = published()["table2"]["rigid"]["height"].as_float().unwrap();
    let poles = linear(&vehicle(Configuration::Rigid)).poles();
    assert!(poles[0].norm() < 1e-4 * printed.abs(), "{}", poles[0]);
}

#[test]
fn paper_table2_signs_and_order_hold_with_published_and_identified_coefficients() {
    // One unstable and one stable short-period pole, growing from rigid over even to slosh, and
    // every aeroelastic pair damped, near the printed frequency.
    let table = published();
    for set in [Xu2015, Parker2007] {
        let mut unstable = 0.0;
        for configuration in CONFIGURATIONS {
            let poles = linear(&vehicle_with(set, configuration)).poles();
            let real = real_parts(&poles);
            assert!(real[0] > unstable, "{set:?}, {configuration:?}");
            assert!(real[real.len() - 1] < -unstable, "{set:?}, {configuration:?}");
            unstable = real[0];
            let fast: Vec<_> = poles.iter().filter(|pole| pole.im > 1.0).collect();
            assert!(fast.iter().all(|pole| pole.re < 0.0), "{set:?}, {configuration:?}");
        }
        for (column, configuration) in FLEXIBLE {
            let poles = linear(&vehicle_with(set, configuration)).poles();
            for printed in table["table2"][column]["aeroelastic"].as_array().unwrap() {
                let frequency = floats(printed)[1];
                let nearest = poles
                    .iter()
                    .map(|pole| deviation(pole.im, frequency, 1.0))
                    .fold(f64::INFINITY, f64::min);
                // The air shifts the first slosh-beam mode down by 2.2 %; the paper has it 1.9 % up.
                assert!(nearest < 0.041, "{set:?}, {column}: {frequency} is off by {nearest}");
            }
        }
    }
}

/// What the tanks are identified with: one standard error of the growth (`cargo ahv identify beam`).
const GROWTH: f64 = 0.01;

#[test]
fn paper_table2_short_period_grows_from_even_to_sloshing_mass() {
    let table = published();
    let size = |right: f64, left: f64| (-right * left).sqrt();
    let printed = |column: &str| {
        let pair = floats(&table["table2"][column]["short_term"]);
        size(pair[0], pair[1])
    };
    for set in [Xu2015, Parker2007] {
        let ours = |configuration| {
            let real = real_parts(&linear(&vehicle_with(set, configuration)).poles());
            size(real[0], real[real.len() - 1])
        };
        let growth = ours(Configuration::SloshBeam) / ours(Configuration::EvenMassBeam);
        assert_close(&format!("{set:?}"), growth, printed("slosh") / printed("even"), GROWTH);
    }
}

/// What xu2015 reaches, relative, by column: rigid, even, slosh. Wanted were 5 %: the printed jump
/// of the short period with the beam takes numbers that nobody would believe (`cargo ahv identify
/// xu2015`).
const XU2015_SHORT_PERIOD: [f64; 3] = [0.094, 0.235, 0.247];
/// Size of the pair of real zeros, against the geometric mean of the printed pair.
const XU2015_REAL_ZEROS: [f64; 3] = [0.057, 0.071, 0.083];
/// Frequency and real part of the aeroelastic pairs, by column (even, slosh) and mode. Wanted were
/// 2 and 10 %.
const XU2015_POLES: [[[f64; 2]; 3]; 2] = [
    [[0.015, 0.169], [0.005, 0.087], [0.002, 0.109]],
    [[0.039, 0.423], [0.006, 0.078], [0.0071, 0.165]],
];
const XU2015_ZEROS: [[[f64; 2]; 3]; 2] = [
    [[0.188, 0.508], [0.230, 0.039], [0.186, 0.108]],
    [[0.020, 0.394], [0.072, 0.028], [0.074, 0.151]],
];

#[test]
fn paper_tables_2_and_3_as_far_as_xu2015_carries() {
    let table = published();
    let columns = ["rigid", "even", "slosh"];
    for (i, (column, configuration)) in columns.into_iter().zip(CONFIGURATIONS).enumerate() {
        let linear = linear(&vehicle_with(Xu2015, configuration));
        let (poles, zeros) = (linear.poles(), linear.zeros());
        let ends = |values: &[Complex<f64>]| {
            let real = real_parts(values);
            [real[0], real[real.len() - 1]]
        };
        let printed = floats(&table["table2"][column]["short_term"]);
        for (found, printed) in ends(&poles).into_iter().zip(printed) {
            let what = format!("{column}: short period");
            assert_close(&what, found, printed, XU2015_SHORT_PERIOD[i]);
        }
        let printed = floats(&table["table3"][column]["real"]);
        let size = |[right, left]: [f64; 2]| (-right * left).sqrt();
        let mean = size([printed[0], printed[1]]);
        assert_close(&format!("{column}: zeros"), size(ends(&zeros)), mean, XU2015_REAL_ZEROS[i]);
        if configuration == Configuration::Rigid {
            continue;
        }
        let sides = [("table2", poles, XU2015_POLES), ("table3", zeros, XU2015_ZEROS)];
        for (name, roots, limits) in sides {
            // The three fastest pairs, by frequency.
            let pairs: Vec<_> = roots.iter().filter(|root| root.im > 0.0).collect();
            let flexible = &pairs[pairs.len() - 3..];
            let printed = table[name][column]["aeroelastic"].as_array().unwrap();
            for (mode, (root, printed)) in flexible.iter().zip(printed).enumerate() {
                let [frequency, decay] = limits[i - 1][mode];
                let what = format!("{name}, {column}, mode {}", mode + 1);
                assert_close(&what, root.im, floats(printed)[1], frequency);
                assert_close(&what, root.re, floats(printed)[0], decay);
            }
        }
    }
}

#[test]
fn paper_table3_even_zeros_contradict_table2() {
    // The even column's poles stand on the frequencies without air, to every printed digit: no
    // elastic stiffness from the air. Its zeros stand a fifth and more above them: elastic stiffness
    // of half the beam's, in all three modes.
    let table = published();
    let without_air = floats(&table["table1"]["even"]);
    let of = |name: &str, mode: usize| floats(&table[name]["even"]["aeroelastic"][mode])[1];
    for (mode, omega) in without_air.into_iter().enumerate() {
        assert_close("pole", of("table2", mode), omega, 1e-4);
        assert!(of("table3", mode) > 1.2 * omega);
    }
}

#[test]
fn paper_published_trim_closes_lift_but_not_moment() {
    // Parker et al. print alpha 1.5153 deg, delta_e 11.4635 deg, phi 0.2514 at 85,000 ft and
    // 7702.08 ft/s. The printed fits carry the weight less the centrifugal part there to 1 %;
    // thrust and drag differ by 7 %, and a moment remains, so the digits are not of these fits.
    let vehicle = vehicle_with(Parker2007, Configuration::Rigid);
    let radians = std::f64::consts::PI / 180.0;
    let mut x = [0.0; ahv::dynamics::STATES];
    x[0] = 7702.08 * 0.3048;
    x[1] = 85_000.0 * 0.3048;
    x[3] = 1.5153 * radians;
    let loads = vehicle.loads(&x, &[11.4635 * radians, 0.2514]);
    let (gravity, distance) = vehicle.atmosphere.gravity(x[1]);
    let weight = vehicle.airframe.mass * (gravity - x[0] * x[0] / distance);
    let up = loads.lift + loads.thrust * x[3].sin();
    assert_close("lift", up, weight, 1e-2);
    let imbalance = loads.thrust * x[3].cos() / loads.drag - 1.0;
    assert!((0.05..0.09).contains(&imbalance), "{imbalance}");
    assert!(loads.moment.abs() > 4e4, "{}", loads.moment);
}

#[test]
fn paper_less_propellant_raises_the_frequencies() {
    // Conclusion (1), and the sense of fig. 6.
    let mut last = [0.0; 3];
    for percent in [100, 75, 50, 25, 0] {
        let build = ahv::vehicle::Build {
            fuel_fraction: f64::from(percent) / 100.0,
            ..build(Configuration::SloshBeam)
        };
        let vehicle = Vehicle::new(&data(), &build).unwrap();
        for (omega, last) in vehicle.omega.iter().zip(&mut last) {
            assert!(*omega > *last, "{percent} % fuel: {omega} after {last}");
            *last = *omega;
        }
    }
}

#[test]
fn paper_the_default_flight_is_the_papers_condition() {
    let flight = flight(Configuration::SloshBeam);
    let condition = flight.parameters().build.condition;
    assert_eq!((condition.mach, condition.altitude, condition.gamma), (8.0, 25_900.0, 0.0));
}
