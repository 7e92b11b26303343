//! Air in vertical motion.

use crate::model::{builds, data, deviation, flight_with, vehicle};
use ahv::flight::Flight;
use ahv::solve::{Dual, Scalar};
use ahv::vehicle::{
    ALPHA, Condition, Configuration, GAMMA, H, NOMINAL, RIGID_STATES, STATES, State, V, Vehicle,
};

/// Forces turned from one pair of axes into another, over g: a few roundings.
const TURNED: f64 = 1e-12;
/// Central differences at their best step lose a third of the digits.
const DIFFERENCES: f64 = 1e-8;
const CONTROL: [f64; 2] = [0.1, 0.3];

/// Climbing, with every state in motion.
fn climbing(vehicle: &Vehicle) -> State {
    let start = Condition { mach: 8.2, altitude: 26_500.0, gamma: 0.05 }.start(&vehicle.atmosphere);
    std::array::from_fn(|i| if i < vehicle.states() { start[i] + 0.3 * NOMINAL[i] } else { 0.0 })
}

/// Number of the vertical gust among the inputs.
const W_GUST: usize = 2;
const STILL: [f64; 2] = [0.0; 2];

/// Acceleration in earth axes, forward and up, without gravity and the earth's curvature, m/s^2.
fn specific_force(vehicle: &Vehicle, x: &State, rates: &State) -> [f64; 2] {
    let (gravity, distance) = vehicle.atmosphere.gravity(x[H]);
    let (sin, cos) = x[GAMMA].sin_cos();
    let along = rates[V] + gravity * sin;
    let across = x[V] * rates[GAMMA] + (gravity - x[V] * x[V] / distance) * cos;
    [along * cos - across * sin, along * sin + across * cos]
}

#[test]
fn verif_moving_air_is_still_air_seen_by_a_moving_observer() {
    // Galilei: the forces on a vehicle in rising air are those on one that sinks through still air.
    for options in builds() {
        let vehicle = Vehicle::new(&data(), &options).unwrap();
        let x = climbing(&vehicle);
        for gust in [[-80.0, 0.0], [-3.0, 20.0], [1e-9, 0.0], [25.0, -60.0], [0.0, 90.0]] {
            let ahead = x[V] * x[GAMMA].cos() - gust[1];
            let up = x[V] * x[GAMMA].sin() - gust[0];
            let mut still = x;
            (still[V], still[GAMMA]) = (ahead.hypot(up), up.atan2(ahead));
            still[ALPHA] = x[ALPHA] + x[GAMMA] - still[GAMMA];

            let moving = vehicle.derivatives(&x, &CONTROL, gust);
            let seen = vehicle.derivatives(&still, &CONTROL, STILL);
            let forces =
                [(&x, &moving), (&still, &seen)].map(|(x, r)| specific_force(&vehicle, x, r));
            for (a, b) in forces[0].into_iter().zip(forces[1]) {
                assert!(deviation(a, b, 10.0) < TURNED, "{gust:?} m/s: {forces:?}");
            }
            for i in std::iter::once(4).chain(RIGID_STATES..vehicle.states()) {
                assert!(deviation(moving[i], seen[i], 10.0) < TURNED, "{gust:?} m/s, state {i}");
            }
            let [a, b] = [(&x, gust), (&still, STILL)]
                .map(|(x, w)| vehicle.derivatives_and_outputs(x, &CONTROL, w).1);
            assert!(deviation(a.alpha_probe, b.alpha_probe, 0.01) < TURNED);
            assert!(deviation(a.imu.n_x, b.imu.n_x, 1.0) < TURNED);
            assert!(deviation(a.loads.mach, b.loads.mach, 0.0) < TURNED);
            assert!(deviation(a.n_z, b.n_z, 1.0) < TURNED);
        }
    }
}

#[test]
fn verif_a_gust_has_exact_derivatives_also_where_it_is_zero() {
    let vehicle = vehicle(Configuration::SloshBeam);
    let x = climbing(&vehicle);
    for (gust, component) in [(0.0, 0), (12.0, 0), (0.0, 1), (12.0, 1)] {
        let along = |size: f64| std::array::from_fn(|i| if i == component { size } else { 0.0 });
        let dual = vehicle.derivatives(
            &x.map(Dual::constant),
            &CONTROL.map(Dual::constant),
            std::array::from_fn(|i| Dual::<1> {
                re: along(gust)[i],
                eps: [f64::from(i == component)],
            }),
        );
        let [ahead, behind] =
            [1.0, -1.0].map(|step| vehicle.derivatives(&x, &CONTROL, along(gust + step)));
        for i in 0..STATES {
            let difference = (ahead[i] - behind[i]) / 2.0;
            // What the second-order difference leaves: the gust's cube over V's square.
            let floor = 1e-6 * NOMINAL[i].max(dual[i].re.abs());
            assert!(
                deviation(dual[i].eps[0], difference, floor / DIFFERENCES) < DIFFERENCES,
                "{gust} m/s, component {component}, state {i}: {} against {difference}",
                dual[i].eps[0]
            );
        }
    }
}

#[test]
fn verif_the_envelope_is_that_of_the_incidence_to_the_moving_air() {
    let gusty = |gust: f64, alpha: f64| {
        let mut flight = flight_with(|parameters| {
            parameters.options.configuration = Configuration::Rigid;
            parameters.offsets.alpha = alpha;
        });
        flight.set_input(W_GUST, gust);
        flight
    };
    let up = |flight: &mut Flight| flight.advance(0.01).map(|()| flight.state()[GAMMA]);
    assert!(up(&mut gusty(30.0, 0.0)).unwrap() > up(&mut gusty(0.0, 0.0)).unwrap());
    // 10 degrees of incidence end the curve fits: here from the first instant on.
    let mut flight = gusty(150.0, 0.1);
    let error = flight.advance(0.01).unwrap_err().to_string();
    assert!(error.contains("incidence"), "{error}");
    assert_eq!(flight.time(), 0.0);
}
