//! Pitch, heave and slosh are one body: the library's modes on mean axes against a rigid body with two
//! sloshing masses, written in coordinates of the body, from the data files (`explicit`); and the bending
//! body against all nodes of a finite-element model of its own.

use crate::explicit::beam::Beam;
use crate::explicit::elastic::Elastic;
use crate::explicit::flight::{Directions, Explicit};
use crate::model::{AERO_SETS, assert_close, data, options};
use ahv::air::curve_fits::INCIDENCE;
use ahv::data::Data;
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::{Trim, trim};
use ahv::error::Error;
use ahv::structure::MODES;
use ahv::vehicle::{ALPHA, Configuration, DELTA_E, Factors, PHI, Vehicle, VehicleOptions, eta};
use nalgebra::Complex;

const FUEL_FRACTIONS: [f64; 4] = [0.05, 0.25, 0.5, 1.0];
/// rad/s.
const SLOSH_FREQUENCIES: [f64; 4] = [2.0, 5.0, 10.0, 30.0];
const SLOSH_DAMPINGS: [f64; 3] = [0.01, 0.05, 0.3];
/// Aft, m.
const SHIFTS: [f64; 2] = [0.0, 0.5];
const PITCH_RATES: [f64; 2] = [0.0, 1.0];
/// Bending moves a pole by up to 2 %, by one over the stiffness: 2e-5 is left, and 8e-5 where liquid is fast.
const STIFF: f64 = 1000.0;
/// Of poles and zeros, with forces in the directions of eq. (3).
const AS_THE_EQUATIONS: f64 = 2e-4;
/// Of short-period poles and real zeros, with forces in the directions of plane motion. Where slow liquid
/// turns the body against the mean axes, a thrust that turns with it moves a zero by 1.2e-3; the
/// lever of liquid that has moved across the axis moves a pole by 1.0e-3.
const PLANE_MOTION: f64 = 1.3e-3;
/// The same of what sloshes at 2 rad/s: the lever makes 4.6e-3.
const PLANE_SLOSH: f64 = 5e-3;
/// Of short-period poles of the beam as it is. Modes beyond the kept five carry a part of the static
/// bending; directions as above; the phugoid, 1e-4.
const BENDING_BODY: f64 = 1e-3;
/// What bending does to them.
const BENDING: f64 = 0.022;
/// Elements of the bending body: with 80 a pole moves by 3e-5.
const ELEMENTS: usize = 40;
/// Slower ones are the phugoid and the height, where digits go: 1e-6 rad/s out of numbers of 100.
const SLOWEST_RAD_PER_S: f64 = 0.5;
/// Sums over 500 elements.
const ROUNDING: f64 = 1e-12;
/// rad, and of a fuel ratio: bending moves them by 1e-3 and more over the stiffness.
const SAME_TRIM: f64 = 2e-5;
/// A set's mass centre that is this far from that by the densities, m, doubles what the levers do.
const FAR_M: f64 = 3.0;
/// One in this many may be refused.
const FEW: usize = 10;

fn cases(stiffness: f64) -> Vec<VehicleOptions> {
    let mut cases = Vec::new();
    for aero in AERO_SETS {
        for fuel_fraction in FUEL_FRACTIONS {
            for slosh_frequency in SLOSH_FREQUENCIES {
                for slosh_damping in SLOSH_DAMPINGS {
                    for mass_centre_shift_m in SHIFTS {
                        for pitch_rate in PITCH_RATES {
                            let factors = Factors {
                                stiffness,
                                mass_centre_shift_m,
                                pitch_rate,
                                ..Factors::default()
                            };
                            cases.push(VehicleOptions {
                                aero,
                                fuel_fraction,
                                slosh_frequency,
                                slosh_damping,
                                factors,
                                ..options(Configuration::SloshBeam)
                            });
                        }
                    }
                }
            }
        }
    }
    cases
}

/// Calls `f` with every case that flies; the others must be few and say why.
fn for_all(stiffness: f64, mut f: impl FnMut(&VehicleOptions, &Vehicle, &Trim)) {
    let (data, cases) = (data(), cases(stiffness));
    let mut refused = Vec::new();
    for options in &cases {
        let flown = Vehicle::new(&data, options)
            .and_then(|vehicle| trim(&vehicle, &options.condition).map(|trim| (vehicle, trim)));
        match flown {
            Ok((vehicle, trim)) => f(options, &vehicle, &trim),
            Err(error @ (Error::Inertia { .. } | Error::Trim { .. })) => refused.push(error),
            Err(error) => panic!("{options:?}: {error}"),
        }
    }
    assert!(refused.len() * FEW <= cases.len(), "{} of {}", refused.len(), cases.len());
}

fn name(options: &VehicleOptions) -> String {
    let VehicleOptions { aero, fuel_fraction, slosh_frequency, slosh_damping, factors, .. } =
        options;
    let Factors { mass_centre_shift_m, pitch_rate, .. } = factors;
    format!(
        "{aero:?}, fuel {fuel_fraction}, slosh {slosh_frequency} rad/s, damping {slosh_damping}, mass \
         centre {mass_centre_shift_m} m, pitch rate {pitch_rate}"
    )
}

/// Largest relative distance of the expected numbers from the nearest found; bending adds fast ones.
fn farthest(found: &[Complex<f64>], expected: &[Complex<f64>]) -> f64 {
    let nearest = |e: &Complex<f64>| {
        found.iter().map(|f| (f - e).norm() / e.norm()).fold(f64::INFINITY, f64::min)
    };
    let considered = expected.iter().filter(|e| e.norm() > SLOWEST_RAD_PER_S);
    considered.map(nearest).fold(0.0, f64::max)
}

fn is_pair(value: &Complex<f64>) -> bool {
    value.im.abs() > 1e-9 * value.norm()
}

/// Real numbers that are farthest to the right and to the left.
fn real_pair(values: &[Complex<f64>]) -> [f64; 2] {
    let reals = || values.iter().filter(|v| !is_pair(v)).map(|v| v.re);
    [reals().fold(0.0, f64::max), reals().fold(0.0, f64::min)]
}

fn explicit<'a>(data: &'a Data, options: &VehicleOptions, directions: Directions) -> Explicit<'a> {
    Explicit::new(data, options.aero, &options.into(), &options.condition, directions)
}

/// Both short-period poles, both real zeros for either flight-path angle, and what sloshes among them;
/// tolerances of real and of complex numbers.
fn compare(directions: Directions, [real, sloshing]: [f64; 2]) {
    let data = data();
    let station = data.vehicle.default.imu_station_m.value;
    for_all(STIFF, |options, vehicle, trim| {
        let name = name(options);
        let of_set = &data.aero(options.aero).inertia.mass_centre_shift_m;
        let levers = match directions {
            Directions::Equations => 1.0,
            Directions::Plane => {
                1.0 + of_set.as_ref().map_or(0.0, |shift| shift.value.abs()) / FAR_M
            }
        };
        let explicit = explicit(&data, options, directions);
        let [mean, sensed] = [None, Some(station)].map(|station| explicit.linear(station));
        let own = LinearModel::new(vehicle, &trim.state, &trim.control);
        let imu = LinearModel::with_imu_gamma(vehicle, &trim.state, &trim.control);
        for (what, found, expected) in [
            ("poles", own.poles(), mean.poles()),
            ("zeros", own.zeros(), mean.zeros()),
            ("zeros of the sensed path", imu.zeros(), sensed.zeros()),
        ] {
            // A pair is real, fast and among those compared.
            let [right, left] = real_pair(&expected);
            assert!(right > 1.0 && left < -1.0, "{name}: {what} {expected:?}");
            let (pairs, reals): (Vec<Complex<f64>>, Vec<Complex<f64>>) =
                expected.iter().partition(|e| is_pair(e));
            let sloshes = pairs.iter().filter(|pair| pair.norm() > SLOWEST_RAD_PER_S).count();
            assert_eq!(sloshes, 4, "{name}: {what} {expected:?}");
            for (expected, tolerance) in [(reals, real), (pairs, sloshing)] {
                let off = farthest(&found, &expected);
                assert!(
                    off < tolerance * levers,
                    "{name}: {what} off by {off:.2e}: {found:?}, {expected:?}"
                );
            }
        }
    });
}

#[test]
fn verif_a_stiff_vehicle_flies_as_one_body_with_two_sloshing_masses() {
    compare(Directions::Equations, [AS_THE_EQUATIONS; 2]);
}

#[test]
fn verif_directions_that_the_equations_leave_out_matter_little() {
    compare(Directions::Plane, [PLANE_MOTION, PLANE_SLOSH]);
}

/// Both short-period poles of the beam as it is: of the library, of the rigid body, of all nodes.
fn bending_poles(
    data: &Data,
    options: &VehicleOptions,
    vehicle: &Vehicle,
    trim: &Trim,
) -> [[f64; 3]; 2] {
    let explicit = explicit(data, options, Directions::Plane);
    let beam = Beam::new(&data.vehicle, &explicit.books, ELEMENTS, 1.0);
    // The point of linearisation is the library's.
    let per_eta = vehicle.airframe.elastic.per.map(|[per_eta, _]| per_eta[INCIDENCE]);
    let turned: f64 = (0..MODES).map(|k| per_eta[k] * trim.state[eta(k)]).sum();
    let steady = [trim.state[ALPHA] + turned, trim.control[DELTA_E], trim.control[PHI]];
    let mut set = data.aero(options.aero).clone();
    set.reference.elastic_scale.value *= options.factors.elastic;
    let rate = options.factors.pitch_rate;
    let bending = Elastic::new(&explicit, &beam, (&data.vehicle, &set), steady, rate);
    let rigid = real_pair(&explicit.linear(None).poles());
    let found = real_pair(&LinearModel::new(vehicle, &trim.state, &trim.control).poles());
    [0, 1].map(|k| [found[k], rigid[k], bending.pole(rigid[k])])
}

#[test]
fn verif_the_beam_as_it_is_flies_as_all_its_nodes_do() {
    let data = data();
    for_all(1.0, |options, vehicle, trim| {
        if options.slosh_damping != SLOSH_DAMPINGS[1] {
            return;
        }
        for [found, rigid, bending] in bending_poles(&data, options, vehicle, trim) {
            assert_close(&name(options), found, rigid, BENDING);
            assert_close(&name(options), found, bending, BENDING_BODY);
        }
    });
}

#[test]
fn verif_the_air_answers_to_bending_by_the_elastic_factor_alone() {
    let data = data();
    for aero in AERO_SETS {
        for elastic in [0.0, 1.5] {
            let factors = Factors { elastic, ..Factors::default() };
            let options = VehicleOptions { aero, factors, ..options(Configuration::SloshBeam) };
            let vehicle = Vehicle::new(&data, &options).unwrap();
            let trim = trim(&vehicle, &options.condition).unwrap();
            for [found, _, bending] in bending_poles(&data, &options, &vehicle, &trim) {
                assert_close(&format!("{aero:?}, {elastic}"), found, bending, BENDING_BODY);
            }
        }
    }
}

#[test]
fn verif_mass_books_are_those_of_the_data_files() {
    let data = data();
    for_all(1.0, |options, vehicle, _| {
        let name = name(options);
        let (got, expected) =
            (&vehicle.airframe, explicit(&data, options, Directions::Plane).books.total);
        assert_close(&name, got.mass, expected.mass, ROUNDING);
        assert_close(&name, got.mass_centre, expected.centre, ROUNDING);
        assert_close(&name, got.inertia, expected.inertia, ROUNDING);
    });
}

#[test]
fn verif_a_stiff_vehicle_is_trimmed_as_a_rigid_one() {
    let data = data();
    for_all(STIFF, |options, vehicle, trim| {
        let steady = explicit(&data, options, Directions::Plane).steady;
        let [delta_e, phi] = [0, 1].map(|k| trim.control[k] - steady.control[k]);
        // Liquid that lies askew, by millimetres at 2 rad/s, turns the mean axes, not the body.
        let per = vehicle.airframe.elastic.per;
        let turned = (0..MODES).map(|k| per[k][0][INCIDENCE] * trim.state[eta(k)]);
        let alpha = trim.state[ALPHA] + turned.sum::<f64>();
        let off = [alpha - steady.alpha, delta_e, phi];
        assert!(off.iter().all(|off| off.abs() < SAME_TRIM), "{}: {off:?}", name(options));
    });
}
