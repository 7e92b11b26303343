//! The derived elastic terms, against the published rigid ones: a "mode" that is a rigid motion
//! must answer as the rigid body does.
#![allow(missing_docs)]

mod model;

use ahv::aero::{Aero, DRAG, Elastic, FORCE, INFLOW, LIFT, MOMENT};
use ahv::aeroelastic::{Strips, derive};
use ahv::beam::Beam;
use ahv::hermite::Shape;
use ahv::modes::Modes;
use ahv::vehicle::{AeroSet, Configuration, structure};
use model::{assert_close, build, data, vehicle};

/// Sets whose elastic terms are as derived.
const UNSCALED: [AeroSet; 2] = [AeroSet::Parker2007, AeroSet::ShockExpansion];
/// Sums over 2,000 quadrature points.
const ROUNDING: f64 = 1e-12;

struct Case {
    aero: Aero,
    elastic: Elastic,
    centre: f64,
}

/// Elastic terms of two made-up modes of unit modal mass: heave, and nose-down pitch about the
/// moment centre (w up, slope dw/dx = 1).
fn rigid_motions(set: AeroSet) -> Case {
    let data = data();
    let aero = Aero::new(data.aero(set));
    let beam = Beam::even(&data.vehicle, 1.0);
    let nodes = 0..beam.elements() + 1;
    let heave = Shape { w: nodes.clone().map(|_| 1.0).collect(), slope: vec![0.0; nodes.len()] };
    let pitch = Shape {
        w: nodes.clone().map(|i| beam.station(i) - aero.moment_centre).collect(),
        slope: vec![1.0; nodes.len()],
    };
    let modes =
        Modes { count: 2, modal_mass: [1.0; 5], shape: vec![heave, pitch], ..Modes::default() };
    let centre = aero.moment_centre;
    let strips = Strips::new(&beam, &modes, &data.vehicle.geometry);
    Case { aero, elastic: derive(&aero, &beam, &modes, &strips, centre), centre }
}

#[test]
fn verif_a_rigid_rotation_is_an_incidence() {
    for set in UNSCALED {
        let Case { aero, elastic, .. } = rigid_motions(set);
        let slope = |row| aero.fits.row(row).slope(aero.elastic_alpha, aero.elastic_delta_e);
        assert_close("C_L", elastic.per[1][0][LIFT], -slope(LIFT), ROUNDING);
        assert_close("C_M", elastic.per[1][0][MOMENT], -slope(MOMENT), ROUNDING);
        assert_close("C_D", elastic.per[1][0][DRAG], -slope(DRAG), ROUNDING);
        assert_close("inflow", elastic.per[1][0][INFLOW], -1.0, ROUNDING);
    }
}

#[test]
fn verif_a_heave_velocity_is_an_incidence() {
    for set in UNSCALED {
        let Case { aero, elastic, .. } = rigid_motions(set);
        let slope = |row| aero.fits.row(row).slope(aero.elastic_alpha, aero.elastic_delta_e);
        assert_close("C_L", elastic.per[0][1][LIFT], -slope(LIFT), ROUNDING);
        assert_close("C_M", elastic.per[0][1][MOMENT], -slope(MOMENT), ROUNDING);
        assert_close("C_D", elastic.per[0][1][DRAG], -slope(DRAG), ROUNDING);
        assert!(
            elastic.per[0][0][LIFT].abs() < ROUNDING && elastic.per[0][0][MOMENT].abs() < ROUNDING
        );
    }
}

#[test]
fn verif_slope_of_a_fit_counts_the_elevator() {
    // C_D of shock_expansion has a term in alpha delta_e, as large as the slope without it.
    let drag = Aero::new(&data().shock_expansion).fits.row(DRAG);
    let (alpha, delta_e, step) = (0.03, 0.16, 1e-4);
    let quotient = (drag.at(alpha + step, delta_e) - drag.at(alpha - step, delta_e)) / (2.0 * step);
    assert!(drag.cross != 0.0);
    assert_close("dC_D/d alpha", drag.slope(alpha, delta_e), quotient, 1e-9);
}

#[test]
fn verif_loads_add_up_to_the_published_lift_and_moment() {
    let Case { aero, elastic, .. } = rigid_motions(AeroSet::Parker2007);
    let ([heave, pitch], force) = ([0, 1], elastic.force);
    for power in 0..3 {
        // Work on a heave is lift; work on a nose-down pitch is minus the nose-up moment.
        let [lift, moment] =
            [aero.fits.alpha[power][LIFT], -aero.chord * aero.fits.alpha[power][MOMENT]];
        assert!((force.alpha[power][heave] - lift).abs() < ROUNDING, "lift, power {power}");
        assert!(
            (force.alpha[power][pitch] - moment).abs() < 100.0 * ROUNDING,
            "moment, power {power}"
        );
    }
    assert_close("elevator lift", force.delta_e[heave], aero.fits.delta_e[0][LIFT], ROUNDING);
    assert_close(
        "elevator moment",
        force.delta_e[pitch],
        -aero.chord * aero.fits.delta_e[0][MOMENT],
        ROUNDING,
    );
}

#[test]
fn verif_thrust_works_on_rigid_motions_as_on_the_rigid_body() {
    let Case { aero, elastic, .. } = rigid_motions(AeroSet::Parker2007);
    let ([heave, pitch], force) = ([0, 1], elastic.force);
    assert_close("lift of the thrust", force.thrust_across[heave], 1.0, ROUNDING);
    assert_close("couple", force.thrust_couple[pitch], -aero.thrust_arm, ROUNDING);
    assert!(
        force.thrust_couple[heave].abs() < ROUNDING && force.thrust_across[pitch].abs() < ROUNDING
    );
}

#[test]
fn verif_liquid_at_rest_lies_on_the_floor() {
    // In steady flight every force on a sloshing mass is balanced without its spring. What is left
    // is what the modes beyond the kept ones would carry.
    for fuel_fraction in [0.0, 0.5, 1.0] {
        let build = ahv::vehicle::Build { fuel_fraction, ..build(Configuration::SloshBeam) };
        let vehicle = ahv::dynamics::Vehicle::new(&data(), &build).unwrap();
        let trim = ahv::trim::trim(&vehicle, &build.condition).unwrap();
        let slosh = vehicle.outputs(&trim.state, &trim.control, 0.0).slosh;
        assert!(slosh.iter().all(|s| s.abs() < 2e-3), "fuel {fuel_fraction}: {slosh:?} m");
    }
}

#[test]
fn verif_pitch_rate_and_pitching_shape_are_the_same_motion() {
    // q > 0 lifts the nose: w = -(x - x_cg), so a rate of the nose-down shape is -q.
    let Case { elastic, centre, aero } = rigid_motions(AeroSet::Parker2007);
    assert_eq!(centre, aero.moment_centre);
    for i in 0..2 {
        let force = &elastic.force;
        assert_close("rate", force.pitch_rate[i], -elastic.per[1][1][FORCE + i], ROUNDING);
    }
}

#[test]
fn verif_the_air_damps_every_mode() {
    // Every surface has a positive lift slope, so the matrix mu_i N_rate is negative: no flutter
    // from quasi-steady damping.
    for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
        let vehicle = vehicle(configuration);
        let (beam, oscillators) = structure(&data(), &build(configuration)).unwrap();
        let mass = Modes::solve(&beam, &oscillators).unwrap().modal_mass;
        let n = vehicle.modes;
        let damping = nalgebra::DMatrix::from_fn(n, n, |i, k| {
            let entry =
                |i: usize, k: usize| vehicle.airframe.elastic.per[k][1][FORCE + i] * mass[i];
            0.5 * (entry(i, k) + entry(k, i))
        });
        let eigenvalues = damping.symmetric_eigenvalues();
        // Three surfaces make a semidefinite matrix of any rank; rounding may lift a zero.
        assert!(eigenvalues.max() < 1e-12 * -eigenvalues.min(), "{configuration:?}: {eigenvalues}");
    }
}

#[test]
fn verif_two_strips_are_plausible() {
    // The fore-body carries more of the lift slope than the rest; both push the right way, as
    // tangent-wedge theory demands (0.9 per rad of fore-body area at Mach 8).
    let Case { aero, elastic, .. } = rigid_motions(AeroSet::Parker2007);
    let data = data();
    let length = data.vehicle.geometry.length_m.value;
    let fore = data.vehicle.geometry.fore_body_m.value;
    let [lift, arm] = [-elastic.per[1][0][LIFT], elastic.per[1][0][MOMENT] * aero.chord];
    let elevator = aero.fits.delta_e[0][LIFT];
    let elevator_x = aero.moment_centre - aero.chord * aero.fits.delta_e[0][MOMENT] / elevator;
    // From total lift slope and its arm, by hand.
    let (body, body_arm) = (lift - elevator, arm - elevator * (elevator_x - aero.moment_centre));
    let [x1, x2] = [0.5 * fore, 0.5 * (fore + length)].map(|x| x - aero.moment_centre);
    let first = (body * x2 - body_arm) / (x2 - x1);
    let per_area = first * aero.area / fore;
    assert!((0.7..1.2).contains(&per_area), "{per_area} per rad");
    assert!(first < body && first > 0.5 * body, "{first} of {body}");
}

#[test]
fn verif_the_full_build_scales_inertia_with_fuel() {
    let full = vehicle(Configuration::SloshBeam);
    let build = ahv::vehicle::Build { fuel_fraction: 0.0, ..build(Configuration::SloshBeam) };
    let empty = ahv::dynamics::Vehicle::new(&data(), &build).unwrap();
    let dry = 1.0 - data().vehicle.mass.propellant_fraction.value;
    assert!(
        empty.airframe.mass < 0.36 * full.airframe.mass
            && empty.airframe.mass > dry * full.airframe.mass
    );
    assert!(
        empty.airframe.inertia < 0.6 * full.airframe.inertia
            && empty.airframe.inertia > 0.3 * full.airframe.inertia
    );
    assert_eq!(full.airframe.inertia, data().xu2015.inertia.i_yy_kg_m2_per_m.value);
}
