//! The vehicle between the fuel levels at which its modes are solved.

use crate::model::{AERO_SETS, CONFIGURATIONS, assert_close, data, deviation, options};
use ahv::air::curve_fits::{DRAG, INCIDENCE, INFLOW, LIFT, MODAL_FORCE, MOMENT};
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::trim;
use ahv::solve::{Dual, Scalar};
use ahv::structure::MODES;
use ahv::vehicle::{
    Airframe, Body, COEFFICIENTS, Configuration, FUEL, Factors, GUSTS, NOMINAL, RIGID_STATES,
    STATES, Vehicle, VehicleDefinition, VehicleOptions,
};
use nalgebra::{Matrix5, SymmetricEigen};

/// Of a coefficient between two levels, over the largest of its kind. Most keep 1e-6; the lift due
/// to slosh and the damping where two modes cross need the rest.
const INTERPOLATED: f64 = 6e-5;
/// A kind that is no larger is there by rounding: without liquid no mode moves the body rigidly.
pub(super) const NOTHING: f64 = 1e-9;
/// Of a frequency between two levels; that of the liquid in nearly empty tanks needs half of it.
const FREQUENCY: f64 = 1e-5;
/// Of a pole of the vehicle between two levels, over its frequency and 1 rad/s.
const POLE: f64 = 5e-6;
/// Two ways to the same vehicle at a level: rounding, as eigenvectors have it.
const SAME: f64 = 1e-10;
/// Levels compared: none of them but the ends is one at which the modes are solved.
const SAMPLES: usize = 24;

/// Places of the coefficients of each kind in [`Airframe::to_row`], without the turning of the shapes, which
/// a body at one level does not have: an airframe whose numbers are their places tells them.
pub(super) fn kinds() -> Vec<Vec<usize>> {
    let Airframe { mass, inertia, mass_centre, elastic, .. } = places();
    let Airframe { stiffness, damping, floor, slosh, imu, probe, depth, .. } = places();
    let mut kinds = vec![vec![mass], vec![inertia], vec![mass_centre]];
    for rows in [LIFT..LIFT + 1, DRAG..DRAG + 1, MOMENT..MOMENT + 1, INFLOW..INFLOW + 1]
        .into_iter()
        .chain([MODAL_FORCE..MODAL_FORCE + MODES, INCIDENCE..INCIDENCE + 1])
    {
        let per = elastic.per.as_flattened().iter();
        kinds.push(per.flat_map(|per| per[rows.clone()].to_vec()).collect());
        kinds.push(elastic.pitch_rate[rows].to_vec());
    }
    let force = elastic.force;
    kinds.push(force.alpha.concat());
    kinds.extend(
        [force.delta_e, force.plume, force.thrust_across, force.thrust_couple].map(Vec::from),
    );
    kinds.extend([stiffness.concat(), damping.concat(), floor.to_vec(), slosh.concat()]);
    for [deflection, slope] in [imu, probe] {
        kinds.extend([deflection.to_vec(), slope.to_vec()]);
    }
    kinds.push(depth.to_vec());
    kinds.into_iter().map(|kind| kind.into_iter().map(|place| place as usize).collect()).collect()
}

fn places() -> Airframe {
    Airframe::from_row(&std::array::from_fn(|i| i as f64))
}

/// Different enough: full and half full, one mode beside a bending frequency, no slosh at all, with the
/// terms in the pitch rate.
fn builds() -> Vec<VehicleOptions> {
    let beam = |fuel_fraction, slosh_frequency| VehicleOptions {
        fuel_burn: true,
        fuel_fraction,
        slosh_frequency,
        ..options(Configuration::SloshBeam)
    };
    let even = VehicleOptions { fuel_burn: true, ..options(Configuration::EvenMassBeam) };
    let factors = Factors { pitch_rate: 1.0, mass_centre_shift_m: -0.5, ..Factors::default() };
    let pitching = VehicleOptions { factors, ..beam(1.0, 0.0) };
    vec![beam(1.0, 0.0), beam(0.5, 0.0), beam(1.0, 20.0), beam(0.8, 50.0), even, pitching]
}

fn fractions(options: &VehicleOptions) -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|i| options.fuel_fraction * (1.0 - i as f64 / SAMPLES as f64))
}

#[test]
fn verif_between_the_levels_every_coefficient_is_what_a_direct_solution_gives() {
    // The direct solution is in the basis nearest to the start, which knows nothing of the levels:
    // agreement also shows that this basis has no jump, where the slosh frequencies cross included.
    let data = data();
    for options in builds() {
        let vehicle = Vehicle::new(&data, &options).unwrap();
        let definition = VehicleDefinition::new(&data, &options);
        let (burn, start) = (vehicle.fuel_table.as_ref().unwrap(), Body::new(&definition).unwrap());
        for fuel_fraction in fractions(&options) {
            let level = definition.at(fuel_fraction);
            let direct = Body::aligned(&level, &start).unwrap();
            let direct = direct.airframe(&level).unwrap().to_row();
            let fuel = vehicle.fuel * fuel_fraction / options.fuel_fraction;
            let between = burn.airframe(fuel).to_row();
            for kind in kinds() {
                let size = kind.iter().fold(NOTHING, |a: f64, i| a.max(direct[*i].abs()));
                for i in kind {
                    let error = (between[i] - direct[i]).abs();
                    assert!(
                        error <= INTERPOLATED * size,
                        "{options:?} at {fuel_fraction}, coefficient {i}: {:.1e}",
                        error / size
                    );
                }
            }
        }
    }
}

#[test]
fn verif_the_start_is_the_vehicle_without_burning() {
    let data = data();
    for configuration in CONFIGURATIONS {
        let still = VehicleOptions { fuel_fraction: 0.7, ..options(configuration) };
        let burning = Vehicle::new(&data, &VehicleOptions { fuel_burn: true, ..still }).unwrap();
        let still = Vehicle::new(&data, &still).unwrap();
        assert_eq!(burning.fuel, still.fuel);
        let [one, other] = [
            burning.fuel_table.as_ref().unwrap().airframe(burning.fuel).to_row(),
            still.airframe.to_row(),
        ];
        for i in kinds().concat() {
            let error = deviation(one[i], other[i], 1e-12);
            assert!(error < 1e-12, "{configuration:?}, coefficient {i}: {error:.1e}");
        }
    }
}

#[test]
fn verif_frequencies_go_through_the_crossing() {
    let data = data();
    for options in builds() {
        let vehicle = Vehicle::new(&data, &options).unwrap();
        for fuel_fraction in fractions(&options) {
            let level =
                Vehicle::new(&data, &VehicleOptions { fuel_fraction, fuel_burn: false, ..options });
            let mut expected = level.unwrap().omega;
            let fuel = vehicle.fuel * fuel_fraction / options.fuel_fraction;
            let airframe = vehicle.fuel_table.as_ref().unwrap().airframe(fuel);
            // Symmetric in the modes with modal mass 1; the eigenvalues are the same.
            let symmetric = Matrix5::from_fn(|i, k| {
                let product = airframe.stiffness[i][k] * airframe.stiffness[k][i];
                product.max(0.0).sqrt().copysign(airframe.stiffness[i][k])
            });
            let mut found: Vec<f64> = SymmetricEigen::new(symmetric)
                .eigenvalues
                .iter()
                .map(|square| square.max(0.0).sqrt())
                .collect();
            found.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (found, expected) in found.into_iter().zip(expected) {
                let error = deviation(found, expected, 1.0);
                assert!(error < FREQUENCY, "{options:?} at {fuel_fraction}: {error:.1e}");
            }
        }
    }
}

#[test]
fn verif_a_slow_burn_is_the_family_of_vehicles_at_rest() {
    // Trim and poles at a level reached by burning, against those of a vehicle with that level.
    let data = data();
    for aero in AERO_SETS {
        for configuration in CONFIGURATIONS {
            let full = VehicleOptions { aero, fuel_burn: true, ..options(configuration) };
            let mut burning = Vehicle::new(&data, &full).unwrap();
            // Slow, in the limit: nothing flows.
            burning.intake.stoichiometric_ratio = 0.0;
            let full_load = burning.fuel;
            // Before and behind the crossing: in it, at 0.23, two poles are so nearly one that they
            // answer with the root of any change.
            for fuel_fraction in [0.93, 0.6, 0.31, 0.15, 0.05] {
                burning.fuel = full_load * fuel_fraction;
                let level = VehicleOptions { fuel_fraction, fuel_burn: false, ..full };
                let level = Vehicle::new(&data, &level).unwrap();
                let [one, other] = [&burning, &level].map(|v| trim(v, &full.condition).unwrap());
                let what = format!("{configuration:?} {aero:?} at {fuel_fraction}");
                assert_close(&what, one.state[FUEL], other.state[FUEL], SAME);
                let pairs = one.state.iter().zip(other.state).zip(NOMINAL).take(RIGID_STATES);
                for ((one, other), nominal) in pairs {
                    assert!((one - other).abs() < 1e-7 * nominal, "{what}");
                }
                for (one, other) in one.control.iter().zip(other.control) {
                    assert!((one - other).abs() < 1e-7, "{what}");
                }
                let [shown, expected] = [(&burning, one), (&level, other)]
                    .map(|(v, t)| v.derivatives_and_outputs(&t.state, &t.control, [0.0; GUSTS]).1);
                assert_close(&what, shown.loads.lift, expected.loads.lift, 1e-7);
                assert_close(&what, shown.n_z, expected.n_z, 1e-7);
                let [poles, expected] = [(&burning, one), (&level, other)]
                    .map(|(v, t)| LinearModel::new(v, &t.state, &t.control).poles());
                for pole in &expected {
                    let distance = |other: &nalgebra::Complex<f64>| (pole - other).norm();
                    let nearest = poles.iter().map(distance).fold(f64::INFINITY, f64::min);
                    assert!(nearest < POLE * pole.norm().max(1.0), "{what}: {pole}, {nearest:.1e}");
                }
            }
        }
    }
}

#[test]
fn verif_dual_numbers_know_what_the_fuel_does() {
    let data = data();
    for options in builds() {
        let vehicle = Vehicle::new(&data, &options).unwrap();
        let mut x = [0.0; STATES];
        x[..5].copy_from_slice(&[2500.0, 26_000.0, 0.01, 0.03, 0.02]);
        for i in 0..2 * vehicle.modes {
            x[5 + i] = 0.5 * NOMINAL[5 + i];
        }
        // Inside one of the cubics, and beyond the ends of all.
        for part in [1.001, 0.997, 0.4, 0.1, 0.003, -0.001, -0.5, 1.8] {
            x[FUEL] = vehicle.fuel * part;
            let u = [0.1, 0.4];
            let dual: [Dual<1>; STATES] =
                std::array::from_fn(|i| Dual { re: x[i], eps: [f64::from(i == FUEL)] });
            let still = [Dual::constant(0.0); GUSTS];
            let (rates, outputs) =
                vehicle.derivatives_and_outputs(&dual, &u.map(Dual::constant), still);
            let size = 1e-4 * vehicle.fuel;
            let shifted = |steps: f64| {
                let mut x = x;
                x[FUEL] += steps * size;
                vehicle.derivatives_and_outputs(&x, &u, [0.0; GUSTS])
            };
            let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(shifted);
            let check = |what: &str, dual: Dual<1>, [a, b, c, d]: [f64; 4]| {
                let slope = (8.0 * (a - b) - (c - d)) / (12.0 * size);
                let scale = (a.abs() + 1e-3) / vehicle.fuel;
                let error = (dual.eps[0] - slope).abs() / scale.max(slope.abs());
                assert!(error < 1e-6, "{what} at {part}: {} against {slope}", dual.eps[0]);
                assert!((dual.re - 0.5 * (a + b)).abs() <= 1e-4 * (a.abs() + 1.0), "{what}");
            };
            for i in 0..STATES {
                check("rate", rates[i], [&a, &b, &c, &d].map(|(rates, _)| rates[i]));
            }
            let four = [&a, &b, &c, &d].map(|(_, outputs)| outputs);
            check("lift", outputs.loads.lift, four.map(|o| o.loads.lift));
            check("slosh", outputs.slosh[0], four.map(|o| o.slosh[0]));
            check("n_z", outputs.n_z, four.map(|o| o.n_z));
            check("n_z_imu", outputs.imu.n_z, four.map(|o| o.imu.n_z));
            check("alpha_probe", outputs.alpha_probe, four.map(|o| o.alpha_probe));
        }
    }
}

#[test]
fn verif_all_numbers_of_an_airframe_come_back_from_its_row() {
    let row: [f64; COEFFICIENTS] = std::array::from_fn(|i| i as f64);
    assert_eq!(places().to_row(), row);
    // Each is in one kind or in the turning, and in no other.
    let turning = places().turning.concat().into_iter().map(|place| place as usize);
    let mut all: Vec<usize> = kinds().concat().into_iter().chain(turning).collect();
    all.sort_unstable();
    assert_eq!(all, (0..COEFFICIENTS).collect::<Vec<_>>());
}
