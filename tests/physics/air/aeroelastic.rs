//! The derived elastic terms: a "mode" that moves the body rigidly is an incidence of the whole body and
//! nothing else; loads, thrust and liquid as the rigid body has them.

use super::made_up::{BY_HAND, Case, HEAVE, PITCH, ROUNDING, case, cases};
use crate::explicit::air::speed_and_gravity;
use crate::model::{AERO_SETS, assert_close, data, options, vehicle, vehicle_with};
use ahv::air::curve_fits::{
    Aero, DRAG, ELASTIC_ROWS, Elastic, INCIDENCE, LIFT, MODAL_FORCE, MOMENT, ModalForces, PerMode,
};
use ahv::data::AeroSet;
use ahv::structure::{MODES, Modes};
use ahv::vehicle::{
    ALPHA, Configuration, Factors, GAMMA, GUSTS, Q, V, Vehicle, VehicleOptions, eta, eta_dot,
    structure,
};

#[test]
fn verif_a_rigid_rotation_is_an_incidence() {
    // Of the body and nothing else; its rate is the velocity of the mass centre, up where that is behind
    // the moment centre.
    for (name, case) in cases(0.0) {
        let shift = case.centre - case.aero.moment_centre;
        assert_incidence(&name, &case, PITCH, [-1.0, -shift]);
    }
}

#[test]
fn verif_a_heave_velocity_is_an_incidence() {
    for (name, case) in cases(0.0) {
        assert_incidence(&name, &case, HEAVE, [0.0, -1.0]);
    }
}

fn assert_incidence(name: &str, case: &Case, mode: usize, per: [f64; 2]) {
    for (rows, incidence) in case.elastic.per[mode].iter().zip(per) {
        let mut expected = [0.0; ELASTIC_ROWS];
        expected[INCIDENCE] = incidence;
        case.assert_rows(name, rows, &expected, ROUNDING);
    }
}

#[test]
fn verif_rigid_motions_act_in_the_published_fits_as_incidence_does() {
    for set in AERO_SETS {
        let mut vehicle = vehicle_with(set, Configuration::SloshBeam);
        let shift = 0.7;
        let case = case(set, shift, 0.0);
        vehicle.airframe.elastic = case.elastic;
        // The thrust across the body goes with the incidence of the axes, not of the body.
        vehicle.airframe.elastic.force.thrust_across = [0.0; MODES];
        vehicle.airframe.stiffness = [[0.0; MODES]; MODES];
        vehicle.airframe.damping = [[0.0; MODES]; MODES];
        let mut x = options(Configuration::Rigid).condition.start(&vehicle.atmosphere);
        (x[GAMMA], x[ALPHA], x[Q]) = (0.01, 0.03, 0.02);
        let (turned, up, nose_down) = (0.011, 4.0, 0.6);
        let mut moved = x;
        moved[eta(PITCH)] = turned;
        moved[eta_dot(HEAVE)] = up;
        moved[eta_dot(PITCH)] = nose_down;
        let mut inclined = x;
        inclined[ALPHA] -= turned + (up + nose_down * shift) / x[V];
        let shown = [&moved, &inclined].map(|x| {
            let (rates, outputs) = vehicle.derivatives_and_outputs(x, &[0.1, 0.4], [0.0; GUSTS]);
            let loads = outputs.loads;
            let arm = vehicle.airframe.mass_centre - vehicle.aero.moment_centre;
            let modal = [0, 1, 2].map(|mode| rates[eta_dot(mode)]);
            ([loads.lift, loads.drag, loads.thrust, loads.moment - loads.normal * arm], modal)
        });
        for (a, b) in shown[0].0.into_iter().zip(shown[1].0) {
            assert_close(&format!("{set:?}: {shown:?}"), a, b, BY_HAND);
        }
        for (a, b) in shown[0].1.into_iter().zip(shown[1].1) {
            assert_close(&format!("{set:?}: {shown:?}"), a, b, BY_HAND);
        }
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
    let Case { aero, elastic, .. } = case(AeroSet::Parker2007, 0.0, 0.0);
    let ([heave, pitch], force) = ([HEAVE, PITCH], elastic.force);
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
    let Case { aero, elastic, .. } = case(AeroSet::Parker2007, 0.0, 0.0);
    let ([heave, pitch], force) = ([HEAVE, PITCH], elastic.force);
    assert_close("lift of the thrust", force.thrust_across[heave], 1.0, ROUNDING);
    assert_close("couple", force.thrust_couple[pitch], -aero.thrust_arm, ROUNDING);
    assert!(
        force.thrust_couple[heave].abs() < ROUNDING && force.thrust_across[pitch].abs() < ROUNDING
    );
}

#[test]
fn verif_liquid_at_rest_lies_on_the_floor() {
    // In steady flight every force on a sloshing mass is balanced without its spring, but for one: eq. (4)
    // has no modal force across the body by drag, and by lift that is turned, which the equation of pitch
    // has where the mass centre is off the moment centre. What is left beside it is what the modes
    // beyond the kept ones would carry.
    let data = data();
    for (aero, fuel_fraction) in
        AERO_SETS.into_iter().flat_map(|set| [0.0, 0.5, 1.0].map(|fuel| (set, fuel)))
    {
        let options = VehicleOptions { aero, fuel_fraction, ..options(Configuration::SloshBeam) };
        let vehicle = Vehicle::new(&data, &options).unwrap();
        let trim = ahv::dynamics::trim::trim(&vehicle, &options.condition).unwrap();
        let shown = vehicle.derivatives_and_outputs(&trim.state, &trim.control, [0.0; GUSTS]).1;
        let airframe = &vehicle.airframe;
        let moment = (shown.loads.normal - shown.loads.lift)
            * (airframe.mass_centre - vehicle.aero.moment_centre);
        let [_, gravity] = speed_and_gravity(&data.earth, &options.condition);
        let liquids = crate::explicit::books::liquids(&data.vehicle, &(&options).into(), gravity);
        for (slosh, liquid) in shown.slosh.into_iter().zip(liquids) {
            let turn = moment / airframe.inertia * (liquid.station - airframe.mass_centre);
            let left = slosh + turn * liquid.sloshing / liquid.spring;
            assert!(left.abs() < 2e-3, "{aero:?}, fuel {fuel_fraction}: {slosh} m, {left} m");
        }
    }
}

#[test]
fn verif_the_air_damps_every_mode() {
    // Every surface has a positive lift slope, so by strip theory alone (pitch rate included, bending not
    // scaled) the matrix mu_i N_rate is negative: no flutter from quasi-steady damping.
    let data = data();
    for set in AERO_SETS {
        for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
            let elastic = 1.0 / data.aero(set).reference.elastic_scale.value;
            let factors = Factors { pitch_rate: 1.0, elastic, ..Factors::default() };
            let options = VehicleOptions { aero: set, factors, ..options(configuration) };
            let vehicle = Vehicle::new(&data, &options).unwrap();
            let (beam, oscillators) = structure(&data, &options).unwrap();
            let mass = Modes::solve(&beam, &oscillators).unwrap().modal_mass;
            let whole = whole_rates(&vehicle);
            let damping = nalgebra::DMatrix::from_fn(vehicle.modes, vehicle.modes, |i, k| {
                0.5 * (whole[k][i] * mass[i] + whole[i][k] * mass[k])
            });
            let eigenvalues = damping.symmetric_eigenvalues();
            // Three surfaces make a semidefinite matrix of any rank; rounding may lift a zero.
            let name = format!("{set:?} {configuration:?}: {eigenvalues}");
            assert!(eigenvalues.max() < 1e-12 * -eigenvalues.min(), "{name}");
        }
    }
}

/// What the rate of each mode does to the force on each, rigid part included.
fn whole_rates(vehicle: &Vehicle) -> [PerMode; MODES] {
    let Elastic { per, force: ModalForces { alpha, .. }, .. } = vehicle.airframe.elastic;
    per.map(|[_, rate]| {
        std::array::from_fn(|i| {
            let slope = alpha[1][i] + 2.0 * alpha[2][i] * vehicle.aero.elastic_alpha;
            rate[MODAL_FORCE + i] + rate[INCIDENCE] * slope
        })
    })
}

#[test]
fn verif_the_full_build_scales_inertia_with_fuel() {
    let full = vehicle(Configuration::SloshBeam);
    let options = VehicleOptions { fuel_fraction: 0.0, ..options(Configuration::SloshBeam) };
    let empty = Vehicle::new(&data(), &options).unwrap();
    let dry = 1.0 - data().vehicle.mass.propellant_fraction.value;
    assert!(
        empty.airframe.mass < 0.36 * full.airframe.mass
            && empty.airframe.mass > dry * full.airframe.mass
    );
    assert!(
        empty.airframe.inertia < 0.6 * full.airframe.inertia
            && empty.airframe.inertia > 0.3 * full.airframe.inertia
    );
    let of_set = data().xu2015.inertia.i_yy_kg_m2_per_m.value;
    // A sum of what the densities give and what the body takes beyond.
    assert_close("full", full.airframe.inertia, of_set, ROUNDING);
}
