//! What sensors show, against the motion of their place: positions in earth axes of a disturbed flight, by
//! differences in time.

use crate::explicit::extrapolation::extrapolated;
use crate::model::{CONFIGURATIONS, data, options};
use ahv::dynamics::Outputs;
use ahv::solve::{Dual, Scalar};
use ahv::vehicle::{
    ALPHA, Body, Condition, Configuration, GAMMA, Gust, H, NOMINAL, Q, STATES, State, V, Vehicle,
    VehicleDefinition, VehicleOptions, eta,
};

const CONTROL: [f64; 2] = [0.1, 0.3];
/// Vertical and horizontal, m/s.
const GUSTS: [Gust; 4] = [[0.0, 0.0], [25.0, 0.0], [0.0, -40.0], [-12.0, 30.0]];
/// Nodes of the beam on which sensors are put, out of 500.
const NODES: [[usize; 2]; 4] = [[275, 0], [0, 500], [50, 275], [500, 450]];
/// Instants before and after, and their spacing, s: the fastest mode turns by a tenth of a radian.
const HALF: usize = 4;
const SPACING_S: f64 = 1e-3;
/// Weights of differences of eighth order, first and second (Fornberg 1988, table 1).
const FIRST: [f64; HALF] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
const SECOND: [f64; HALF + 1] = [-205.0 / 72.0, 8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
/// Of angles, rad, and pitch rates, rad/s: roundings of 10 m over a millisecond and the speed.
const ANGLE: f64 = 1e-11;
/// Of load factors: roundings of 5e-14 m, as the extrapolation leaves them, times the sum of the weights, 6.5,
/// over the square of the spacing and 9.8 m/s^2.
const LOAD_FACTOR: f64 = 3.5e-8;
/// While fuel burns the mass centre creeps through the body by 1 mm/s (errata, 22), and shapes turn.
const CREEP_ANGLE: f64 = 1e-6;
const CREEP_LOAD_FACTOR: f64 = 1e-4;
/// Central differences of fourth order, with steps of a hundredth of the typical size.
const DIFFERENCES: f64 = 1e-7;

/// A vehicle with sensors on nodes, and the displacements of these in each mode: nose first, deflection and
/// slope.
struct Case {
    vehicle: Vehicle,
    options: VehicleOptions,
    nodes: [usize; 2],
    shapes: Vec<Vec<f64>>,
}

impl Case {
    fn new(options: &VehicleOptions, nodes: [usize; 2]) -> Self {
        let data = data();
        let elements = f64::from(data.vehicle.beam.elements.value);
        let [imu, probe] =
            nodes.map(|n| data.vehicle.geometry.length_m.value * n as f64 / elements);
        let mut options = *options;
        (options.stations.imu, options.stations.probe) = (imu, probe);
        let shapes = match options.configuration {
            Configuration::Rigid => Vec::new(),
            _ => Body::new(&VehicleDefinition::new(&data, &options)).unwrap().displacements(),
        };
        Self { vehicle: Vehicle::new(&data, &options).unwrap(), options, nodes, shapes }
    }

    /// Every state in motion.
    fn start(&self) -> State {
        let condition = Condition { mach: 8.2, altitude: 26_500.0, gamma: 0.03 };
        let start = condition.start(&self.vehicle.atmosphere);
        let mut x: State = std::array::from_fn(|i| start[i] + 2.0 * NOMINAL[i]);
        x[Q] = 0.08;
        x[eta(self.vehicle.modes)..].fill(0.0);
        x[STATES - 1] = 0.8 * self.vehicle.fuel;
        x
    }

    /// Deflection and slope of a sensor's place.
    fn bent(&self, x: &State, node: usize) -> [f64; 2] {
        [0, 1].map(|entry| {
            let modes = self.shapes.iter().enumerate();
            modes.map(|(i, shape)| shape[2 * node + entry] * x[eta(i)]).sum()
        })
    }

    /// Forward and up, m, and attitude, rad, of a sensor at a state; the mass centre is at `at`.
    fn place(&self, x: &State, at: [f64; 2], sensor: usize) -> [f64; 3] {
        let [w, slope] = self.bent(x, self.nodes[sensor]);
        let station = [self.options.stations.imu, self.options.stations.probe][sensor];
        let centre = match &self.vehicle.fuel_table {
            None => self.vehicle.airframe.mass_centre,
            Some(burn) => burn.airframe(x[STATES - 1]).mass_centre,
        };
        let (sin, cos) = (x[GAMMA] + x[ALPHA]).sin_cos();
        let ahead = centre - station;
        [at[0] + ahead * cos - w * sin, at[1] + ahead * sin + w * cos, x[GAMMA] + x[ALPHA] - slope]
    }

    /// Both sensors before, at and after the start, in the plane that is level there: the earth's
    /// curvature is in the rates of the state, and not in the way.
    fn flown(&self, start: &State, gust: Gust) -> Vec<[[f64; 3]; 2]> {
        let rates = |x: &[f64; STATES + 2]| {
            let state: State = std::array::from_fn(|i| x[i]);
            let rates = self.vehicle.derivatives(&state, &CONTROL, gust);
            let (sin, cos) = state[GAMMA].sin_cos();
            std::array::from_fn(|i| match i {
                // Beside what goes straight on: that would cost digits.
                STATES => state[V] * cos - start[V] * start[GAMMA].cos(),
                i if i > STATES => state[V] * sin - start[V] * start[GAMMA].sin(),
                i => rates[i],
            })
        };
        let begin = std::array::from_fn(|i| if i < STATES { start[i] } else { 0.0 });
        let one_way = |step: f64| {
            let mut x = begin;
            let mut states = Vec::new();
            for _ in 0..HALF {
                x = extrapolated(&x, step, rates);
                states.push(x);
            }
            states
        };
        let mut states = one_way(-SPACING_S);
        states.reverse();
        states.push(begin);
        states.extend(one_way(SPACING_S));
        let places = states.iter().map(|x| {
            let state: State = std::array::from_fn(|i| x[i]);
            [0, 1].map(|sensor| self.place(&state, [x[STATES], x[STATES + 1]], sensor))
        });
        places.collect()
    }

    /// What the sensors would show by the motion of their places.
    fn expected(&self, start: &State, gust: Gust) -> Shown {
        let flown = self.flown(start, gust);
        let of =
            |sensor: usize, k: usize, step: isize| flown[HALF.wrapping_add_signed(step)][sensor][k];
        let rate = |sensor: usize, k: usize| {
            let pairs = FIRST.iter().zip(1..);
            let rate = pairs.map(|(c, n)| c * (of(sensor, k, n) - of(sensor, k, -n))).sum::<f64>();
            let straight = [start[V] * start[GAMMA].cos(), start[V] * start[GAMMA].sin(), 0.0];
            rate / SPACING_S + straight[k]
        };
        let acceleration = |k: usize| {
            let pairs = SECOND[1..].iter().zip(1..);
            let sum: f64 = pairs.map(|(c, n)| c * (of(0, k, n) + of(0, k, -n))).sum();
            (sum + SECOND[0] * of(0, k, 0)) / (SPACING_S * SPACING_S)
        };
        let (gravity, distance) = self.vehicle.atmosphere.gravity(start[H]);
        let (sin, cos) = start[GAMMA].sin_cos();
        // Gravity and curvature of eq. (3), along and across the path of the mass centre.
        let (along, across) = (gravity * sin, (gravity - start[V] * start[V] / distance) * cos);
        let forward = acceleration(0) + along * cos - across * sin;
        let up = acceleration(1) + along * sin + across * cos;
        let theta = of(0, 2, 0);
        let (sin, cos) = theta.sin_cos();
        let in_g = 1.0 / data().earth.earth.gravity_m_per_s2.value;
        Shown {
            angles: [
                theta,
                rate(0, 2),
                rate(0, 1).atan2(rate(0, 0)),
                of(1, 2, 0) - (rate(1, 1) - gust[0]).atan2(rate(1, 0) - gust[1]),
            ],
            load_factors: [(up * cos - forward * sin) * in_g, (forward * cos + up * sin) * in_g],
        }
    }
}

#[derive(Debug)]
struct Shown {
    /// theta_imu, q_imu, gamma_imu, alpha_probe.
    angles: [f64; 4],
    /// n_z_imu, n_x_imu.
    load_factors: [f64; 2],
}

impl From<Outputs> for Shown {
    fn from(outputs: Outputs) -> Self {
        let imu = outputs.imu;
        Self {
            angles: [imu.theta, imu.q, imu.gamma, outputs.alpha_probe],
            load_factors: [imu.n_z, imu.n_x],
        }
    }
}

fn assert_shown(case: &Case, gust: Gust, [angle, load_factor]: [f64; 2]) {
    let start = case.start();
    let shown = Shown::from(case.vehicle.derivatives_and_outputs(&start, &CONTROL, gust).1);
    let expected = case.expected(&start, gust);
    let what = format!("{:?}, {:?}, {gust:?}", case.options.configuration, case.nodes);
    for (got, wanted) in shown.angles.into_iter().zip(expected.angles) {
        let off = (got - wanted).abs();
        assert!(off < angle, "{what}: {shown:?}, {expected:?}: {off:.1e}");
    }
    for (got, wanted) in shown.load_factors.into_iter().zip(expected.load_factors) {
        let off = (got - wanted).abs();
        assert!(off < load_factor, "{what}: {shown:?}, {expected:?}: {off:.1e}");
    }
}

#[test]
fn verif_sensors_show_the_motion_of_their_place() {
    for configuration in CONFIGURATIONS {
        for nodes in NODES {
            let case = Case::new(&options(configuration), nodes);
            for gust in GUSTS {
                assert_shown(&case, gust, [ANGLE, LOAD_FACTOR]);
            }
        }
    }
}

#[test]
fn verif_sensors_show_the_motion_of_their_place_while_fuel_burns() {
    for nodes in NODES {
        let burning = VehicleOptions { fuel_burn: true, ..options(Configuration::SloshBeam) };
        let mut case = Case::new(&burning, nodes);
        // The shapes of the start are those of its level.
        let level = VehicleDefinition::new(&data(), &case.options).at(0.8);
        let full = Body::new(&VehicleDefinition::new(&data(), &case.options)).unwrap();
        case.shapes = Body::aligned(&level, &full).unwrap().displacements();
        assert_shown(&case, GUSTS[3], [CREEP_ANGLE, CREEP_LOAD_FACTOR]);
    }
}

#[test]
fn verif_sensors_have_exact_derivatives() {
    const KNOWN: usize = STATES + 4;
    const STEP: f64 = 0.01;
    for fuel_burn in [false, true] {
        let burning = VehicleOptions { fuel_burn, ..options(Configuration::SloshBeam) };
        let case = Case::new(&burning, NODES[2]);
        let start = case.start();
        let size = |k: usize| match k {
            k if k < STATES => NOMINAL[k],
            k if k < STATES + 2 => 0.1,
            _ => 10.0,
        };
        for k in 0..KNOWN {
            let known: [f64; KNOWN] = std::array::from_fn(|i| match i {
                i if i < STATES => start[i],
                i if i < STATES + 2 => CONTROL[i - STATES],
                i => GUSTS[3][i - STATES - 2],
            });
            let at = |steps: f64| {
                let moved = |i: usize| known[i] + if i == k { STEP * steps * size(k) } else { 0.0 };
                let x = std::array::from_fn(moved);
                let u = std::array::from_fn(|i| moved(STATES + i));
                let gust = std::array::from_fn(|i| moved(STATES + 2 + i));
                let shown = Shown::from(case.vehicle.derivatives_and_outputs(&x, &u, gust).1);
                [&shown.angles[..], &shown.load_factors].concat()
            };
            let dual = |i: usize| Dual::<1> { re: known[i], eps: [f64::from(i == k)] };
            let (x, u) = (std::array::from_fn(dual), std::array::from_fn(|i| dual(STATES + i)));
            let gust = std::array::from_fn(|i| dual(STATES + 2 + i));
            let outputs = case.vehicle.derivatives_and_outputs(&x, &u, gust).1;
            let re = Shown::from(outputs.map(Dual::value));
            let eps = Shown::from(outputs.map(|dual| dual.eps[0]));
            let [re, eps] =
                [re, eps].map(|shown| [&shown.angles[..], &shown.load_factors].concat());
            assert_eq!(re, at(0.0));
            let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(at);
            for i in 0..re.len() {
                let change = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * STEP);
                let off = (eps[i] * size(k) - change).abs();
                assert!(off < DIFFERENCES, "{fuel_burn}: {i} by {k}: {off:.1e}, {change}");
            }
        }
    }
}
