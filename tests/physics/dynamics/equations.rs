//! Flight mechanics: trim, kinematics, derivatives, integration.

use crate::model::{
    AERO_SETS, CONFIGURATIONS, builds, data, deviation, flight, flight_with, vehicle, vehicle_with,
};
use ahv::data::AeroSet;
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::trim;
use ahv::error::{Error, LimitedKind};
use ahv::flight::Inputs;
use ahv::solve::{Dual, Scalar};
use ahv::vehicle::{
    ALPHA, CONTROLS, Condition, Configuration, GAMMA, H, NOMINAL, Q, STATES, State, V, Vehicle,
};
use proptest::prelude::*;

/// Accelerations over g that count as none: a few hundred roundings.
const STEADY: f64 = 1e-13;
/// Central differences at their best step lose a third of the digits.
const DIFFERENCES: f64 = 3e-7;

/// A flight away from trim, with every state in motion, inside one layer of the atmosphere.
fn disturbed(vehicle: &Vehicle, scale: [f64; STATES]) -> State {
    let start = Condition { mach: 8.2, altitude: 26_500.0, gamma: 0.01 }.start(&vehicle.atmosphere);
    std::array::from_fn(|i| {
        if i < vehicle.states() { start[i] + 0.3 * NOMINAL[i] * scale[i] } else { 0.0 }
    })
}

#[test]
fn verif_trim_leaves_no_acceleration() {
    for options in builds() {
        for fuel_fraction in [0.0, 0.3, 1.0] {
            for mach in [7.0, 8.0, 9.0] {
                let options = ahv::vehicle::VehicleOptions { fuel_fraction, ..options };
                let vehicle = Vehicle::new(&data(), &options).unwrap();
                let condition = Condition { mach, ..options.condition };
                let trimmed = trim(&vehicle, &condition).unwrap();
                let rates = vehicle.derivatives(&trimmed.state, &trimmed.control, [0.0; 2]);
                for (i, rate) in rates.into_iter().enumerate() {
                    // Modal accelerations against omega^2 times the static deflection.
                    let size = if i < 5 { 10.0 } else { 1e4 };
                    assert!(
                        rate.abs() < STEADY * size,
                        "{options:?}, fuel {fuel_fraction}, Mach {mach}: rate {i} = {rate:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn verif_a_climb_can_be_trimmed_too() {
    let vehicle = vehicle(Configuration::SloshBeam);
    let condition = Condition { mach: 8.0, altitude: 26_000.0, gamma: 0.02 };
    let trimmed = trim(&vehicle, &condition).unwrap();
    let rates = vehicle.derivatives(&trimmed.state, &trimmed.control, [0.0; 2]);
    assert!(deviation(rates[H], trimmed.state[V] * 0.02_f64.sin(), 1.0) < STEADY);
    assert!(rates[V].abs() < STEADY * 10.0 && rates[GAMMA].abs() < STEADY);
}

#[test]
fn verif_an_impossible_trim_names_the_limit() {
    for (mach, altitude, kind) in
        [(2.0, 25_900.0, LimitedKind::Mach), (8.0, 60_000.0, LimitedKind::Altitude)]
    {
        let condition = Condition { mach, altitude, gamma: 0.0 };
        let error = trim(&vehicle(Configuration::SloshBeam), &condition).unwrap_err();
        let Error::Trim { residual, limit, .. } = &error else { panic!("{error}") };
        assert_eq!(limit.map(|limited| limited.kind), Some(kind), "{error}");
        assert!(residual.is_finite() && *residual > 0.0, "{error}");
    }
    // Inside the envelope, but no thrust climbs that steeply.
    let steep = Condition { mach: 8.0, altitude: 25_900.0, gamma: 1.2 };
    let error = trim(&vehicle(Configuration::Rigid), &steep).unwrap_err().to_string();
    assert!(
        error.contains("fuel ratio = ") && error.contains("flight-path angle 1.2 rad"),
        "{error}"
    );
    // And where the air is too thin for any incidence there is no solution at all.
    let thin = Condition { mach: 6.2, altitude: 41_000.0, gamma: 0.0 };
    let error = trim(&vehicle_with(AeroSet::Parker2007, Configuration::Rigid), &thin)
        .unwrap_err()
        .to_string();
    assert!(error.contains("no solution"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn verif_angles_are_kinematically_consistent(scale in prop::array::uniform16(-1.0..1.0_f64)) {
        // alpha' + gamma' = q: the sign missing in the printed eq. (3).
        for options in builds() {
            let vehicle = Vehicle::new(&data(), &options).unwrap();
            let x = disturbed(&vehicle, scale);
            let rates = vehicle.derivatives(&x, &[0.1, 0.3], [0.0; 2]);
            prop_assert!((rates[GAMMA] + rates[ALPHA] - x[Q]).abs() <= 4.0 * f64::EPSILON);
            prop_assert!(rates[vehicle.states()..].iter().all(|&rate| rate == 0.0));
        }
    }

    #[test]
    fn verif_dual_numbers_agree_with_differences(scale in prop::array::uniform16(-1.0..1.0_f64)) {
        for options in builds() {
            let vehicle = Vehicle::new(&data(), &options).unwrap();
            let (x, u) = (disturbed(&vehicle, scale), [0.1, 0.3]);
            let linear = LinearModel::new(&vehicle, &x, &u);
            let n = vehicle.states();
            let step = 1e-3;
            for column in 0..n + CONTROLS {
                let size = if column < n { NOMINAL[column] } else { 1.0 };
                let shifted = |sign: f64| {
                    let (mut x, mut u) = (x, u);
                    if column < n {
                        x[column] += sign * step * size;
                    } else {
                        u[column - n] += sign * step * size;
                    }
                    vehicle.derivatives(&x, &u, [0.0; 2])
                };
                let (one, two) = ((shifted(1.0), shifted(-1.0)), (shifted(2.0), shifted(-2.0)));
                for row in 0..n {
                    // Fourth order.
                    let difference = (8.0 * (one.0[row] - one.1[row]) - (two.0[row] - two.1[row]))
                        / (12.0 * step * size);
                    let exact = if column < n { linear.a[(row, column)] } else { linear.b[(row, column - n)] };
                    // What rounding of f leaves in a difference.
                    let floor = (one.0[row].abs() + 1e-3) / size;
                    prop_assert!(
                        deviation(difference, exact, floor) < DIFFERENCES,
                        "{options:?} ({row}, {column}): {difference} against {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn verif_dual_numbers_carry_the_plain_value() {
    for options in builds() {
        let vehicle = Vehicle::new(&data(), &options).unwrap();
        let x = disturbed(&vehicle, [0.3; STATES]);
        let dual = vehicle.derivatives(
            &x.map(|v| Dual::<1> { re: v, eps: [0.0] }),
            &[0.1, 0.3].map(|v| Dual { re: v, eps: [0.0] }),
            [Dual::constant(0.0); 2],
        );
        assert_eq!(dual.map(|d| d.re), vehicle.derivatives(&x, &[0.1, 0.3], [0.0; 2]));
    }
}

#[test]
fn verif_examples_stay_inside_the_envelope() {
    // Two seconds of open loop: the unstable pole multiplies what a manoeuvre leaves by up to 2000.
    let files = [
        include_str!("../../../examples/elevator_doublet.csv"),
        include_str!("../../../examples/throttle_step.csv"),
    ];
    for (file, set) in files.into_iter().flat_map(|file| AERO_SETS.map(|set| (file, set))) {
        let mut lines = file.lines().filter(|line| !line.starts_with('#'));
        let names: Vec<_> = lines.next().unwrap().split(',').collect();
        let rows: Vec<Vec<f64>> =
            lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
        for configuration in CONFIGURATIONS {
            let mut flight = flight_with(|p| {
                p.options.configuration = configuration;
                p.options.aero = set;
            });
            for (i, row) in rows.iter().enumerate() {
                for (name, value) in names.iter().zip(row).skip(1) {
                    flight.set_input(usize::from(*name == "phi"), *value);
                }
                let end = rows.get(i + 1).map_or(2.0, |next| next[0]);
                // A jump: two rows with the same time.
                if end == row[0] {
                    continue;
                }
                let flown = flight.advance(end);
                assert!(flown.is_ok(), "{names:?}, {set:?}, {configuration:?}: {flown:?}");
            }
        }
    }
}

#[test]
fn verif_zeros_are_where_the_rosenbrock_matrix_is_singular() {
    use nalgebra::{Complex, DMatrix};
    for configuration in CONFIGURATIONS {
        let flight = flight(configuration);
        let (vehicle, trim) = (flight.vehicle(), flight.trim());
        let linear = LinearModel::new(vehicle, &trim.state, &trim.control);
        let n = vehicle.states();
        let zeros = linear.zeros();
        assert_eq!(zeros.len(), n - 2);
        let singular = |s: Complex<f64>| {
            let mut matrix = DMatrix::<Complex<f64>>::zeros(n + 2, n + 2);
            for row in 0..n {
                for column in 0..n {
                    // Scaled to comparable sizes, so that the smallest singular value says something.
                    let scale = NOMINAL[column] / NOMINAL[row];
                    matrix[(row, column)] = Complex::from(linear.a[(row, column)] * scale);
                }
                matrix[(row, row)] -= s;
                for column in 0..2 {
                    matrix[(row, n + column)] =
                        Complex::from(linear.b[(row, column)] / NOMINAL[row]);
                    matrix[(n + column, row)] = Complex::from(linear.c[(column, row)]);
                }
            }
            let values = matrix.singular_values();
            values.min() / values.max()
        };
        for zero in zeros {
            let here = singular(zero);
            let beside = singular(zero + Complex::new(0.02, 0.02) * (1.0 + zero.norm()));
            assert!(
                here < 1e-9 * beside.max(1e-3),
                "{configuration:?}: zero {zero}, {here:e}, {beside:e}"
            );
        }
    }
}

#[test]
fn verif_inputs_after_a_step_are_the_same_polynomial_from_there() {
    // p(t) = a + b t + c t^2 / 2 + d t^3 / 6, of numbers that leave no rounding.
    const T: f64 = 1.5;
    let courses =
        [[1.0, -0.5, 3.0, 6.0], [-2.0, 4.0, 0.25, -12.0], [0.5, 0.0, -8.0, 18.0], [8.0; 4]];
    let mut inputs = Inputs::ZERO;
    for (index, [value, derivatives @ ..]) in courses.into_iter().enumerate() {
        inputs.set(index, value);
        for (order, derivative) in (1..).zip(derivatives) {
            inputs.set_derivative(index, order, derivative);
        }
    }
    let after = inputs.after(T);
    for (index, [a, b, c, d]) in courses.into_iter().enumerate() {
        let value = a + b * T + c * T * T / 2.0 + d * T * T * T / 6.0;
        assert_eq!(after.values[index], value, "input {index}");
        let expected = [b + c * T + d * T * T / 2.0, c + d * T, d];
        assert_eq!(after.derivatives.map(|order| order[index]), expected, "input {index}");
    }
    // They tell how the inputs moved until now; the next step holds them.
    assert!(!after.moving());
    assert_eq!(after.after(T), Inputs { derivatives: Inputs::ZERO.derivatives, ..after });
}
