//! The coefficient set `shock_expansion` against the model that it is a regression of.
#![allow(missing_docs)]

#[path = "../../../tests/model/mod.rs"]
mod model;

use ahv::air::curve_fits::Aero;

use ahv::air::curve_fits::MODAL_FORCE;

use ahv::air::Atmosphere;
use ahv::air::curve_fits::LIFT;
use ahv::air::strip_theory::{StripIntegrals, elastic_derivatives};
use ahv::data::AeroSet;
use ahv::dynamics::trim::{Trim, trim};
use ahv::structure::{Beam, FLEXIBLE, Modes, Shape};
use ahv::vehicle::{ALPHA, Configuration, Vehicle, VehicleOptions, structure};
use ahv_research::shock_expansion::elastic::{COMPARED, deviation};
use ahv_research::shock_expansion::stream::Stream;
use ahv_research::shock_expansion::{Attitude, ShockExpansion};
use model::{assert_close, data, options};

/// Strips of uniform load in place of the true distribution, and one lift slope each: the share of
/// the elastic terms that this may cost; most for C_M per rate of the even beam.
const STRIPS: f64 = 0.53;

fn own_options(configuration: Configuration) -> VehicleOptions {
    VehicleOptions { aero: AeroSet::ShockExpansion, ..options(configuration) }
}

fn trimmed(configuration: Configuration) -> (Vehicle, Trim, Attitude) {
    let options = own_options(configuration);
    let vehicle = Vehicle::new(&data(), &options).unwrap();
    let trim = trim(&vehicle, &options.condition).unwrap();
    let [delta_e, phi] = trim.control;
    let attitude = Attitude { alpha: trim.state[ALPHA], delta_e, phi };
    (vehicle, trim, attitude)
}

fn model_and_air() -> (ShockExpansion, Stream) {
    let data = data();
    let model = ShockExpansion::new(&data.vehicle, &data.earth);
    let condition = options(Configuration::Rigid).condition;
    let atmosphere = Atmosphere::new(&data.earth);
    let ahead = model.medium.ahead(&atmosphere, condition.mach, condition.altitude);
    (model, ahead)
}

#[test]
fn verif_the_fit_has_the_forces_of_the_model_in_trimmed_flight() {
    let (vehicle, trim, attitude) = trimmed(Configuration::Rigid);
    let (model, ahead) = model_and_air();
    let fitted = vehicle.loads(&trim.state, &trim.control);
    let exact = model.loads(&ahead, &attitude, &|_| 0.0).unwrap();
    let size = fitted.lift;
    // Largest residuals of the fit, C_L 0.045 and C_M 0.08, are at the corners of its range.
    assert!((fitted.lift - exact.lift()).abs() < 0.06 * size, "{}", exact.lift());
    assert!((fitted.drag - exact.drag()).abs() < 0.03 * size, "{}", exact.drag());
    assert!((fitted.thrust - exact.thrust).abs() < 0.01 * size, "{}", exact.thrust);
    let arm = model.moment_height - model.thrust_height();
    let moment = exact.moment(vehicle.aero.moment_centre, model.moment_height) + arm * exact.thrust;
    assert!((fitted.moment - moment).abs() < 0.5 * size, "{moment}");
}

#[test]
fn verif_panels_turn_like_the_whole_vehicle() {
    // A rotated body is a body at another incidence, so direct integration has the model's slope.
    let (_, _, attitude) = trimmed(Configuration::Rigid);
    let (model, ahead) = model_and_air();
    let data = data();
    let aero = Aero::new(&data.shock_expansion);
    let beam = Beam::even(&data.vehicle, 1.0);
    let nodes = 0..beam.elements() + 1;
    let shape = Shape {
        w: nodes.clone().map(|i| beam.station(i) - aero.moment_centre).collect(),
        slope: vec![1.0; nodes.len()],
    };
    let modes = Modes { count: 1, modal_mass: [1.0; 5], shape: vec![shape], ..Modes::default() };
    let direct = model.elastic(&ahead, &attitude, &aero, &beam, &modes).unwrap();
    let qbar = model.medium.gas.dynamic_pressure(ahead.mach) * ahead.pressure;
    let up = |alpha: f64| {
        let run = model.loads(&ahead, &Attitude { alpha, ..attitude }, &|_| 0.0).unwrap();
        // Lift and drag of the bent body are along the undisturbed stream.
        let (sin, cos) = (alpha - attitude.alpha).sin_cos();
        (run.lift() * cos + run.drag() * sin) / (qbar * aero.area)
    };
    let slope = (up(attitude.alpha + 1e-4) - up(attitude.alpha - 1e-4)) / 2e-4;
    assert_close("lift", -direct.per[0][0][LIFT], slope, 0.02);
    // The fit's own slope, over a wider range, is near it; so is that of the strips, which a mass
    // centre one metre further ahead meets with one more q/V of incidence everywhere.
    let strips = StripIntegrals::new(&beam, &modes, &data.vehicle.geometry);
    let [ahead, at] = [-1.0, 0.0].map(|moved| {
        elastic_derivatives(&aero, &beam, &modes, &strips, aero.moment_centre + moved, 1.0)
            .pitch_rate[LIFT]
    });
    assert_close("strips", at - ahead, direct.per[0][0][LIFT], 0.15);
}

#[test]
fn verif_strips_stand_for_panels_within_the_stated_bound() {
    let (model, ahead) = model_and_air();
    let (_, _, attitude) = trimmed(Configuration::Rigid);
    for configuration in [Configuration::EvenMassBeam, Configuration::SloshBeam] {
        let (vehicle, ..) = trimmed(configuration);
        let (beam, oscillators) = structure(&data(), &own_options(configuration)).unwrap();
        let modes = Modes::solve(&beam, &oscillators).unwrap();
        let direct = model.elastic(&ahead, &attitude, &vehicle.aero, &beam, &modes).unwrap();
        let found = deviation(&vehicle.airframe.elastic, &direct, FLEXIBLE);
        for (name, value) in COMPARED.into_iter().zip(found) {
            assert!(value < STRIPS, "{configuration:?}, {name}: {value}");
        }
        // What damps or drives each mode by itself has the same sign and size.
        for i in 0..FLEXIBLE {
            let [strip, panel] = [&vehicle.airframe.elastic, &direct]
                .map(|elastic| elastic.per[i][1][MODAL_FORCE + i]);
            assert!(strip < 0.0 && panel < 0.0, "{configuration:?}, mode {i}");
            assert_close("damping", strip, panel, STRIPS);
        }
    }
}
