//! The first-principles vehicle: limits with known answers, conservation, symmetry.
#![allow(missing_docs)]

#[path = "../../../tests/model/mod.rs"]
mod model;

use ahv::air::Atmosphere;
use ahv::data::VehicleData;
use ahv_research::gas::GasError;
use ahv_research::shock_expansion::stream::Stream;
use ahv_research::shock_expansion::surface::PANELS;
use ahv_research::shock_expansion::{AirLoads, Attitude, ShockExpansion};
use model::{assert_close, data, deviation};
use proptest::prelude::*;

const ROUNDING: f64 = 1e-9;

fn model(change: impl Fn(&mut VehicleData)) -> ShockExpansion {
    let mut data = data();
    change(&mut data.vehicle);
    ShockExpansion::new(&data.vehicle, &data.earth)
}

fn ahead(model: &ShockExpansion, mach: f64) -> Stream {
    model.medium.ahead(&Atmosphere::new(&data().earth), mach, 25_900.0)
}

fn attitude(alpha: f64, delta_e: f64, phi: f64) -> Attitude {
    Attitude { alpha: alpha.to_radians(), delta_e: delta_e.to_radians(), phi }
}

fn loads(model: &ShockExpansion, mach: f64, attitude: &Attitude) -> AirLoads {
    model.loads(&ahead(model, mach), attitude, &|_| 0.0).unwrap()
}

/// Along the axis, across it.
fn sum(loads: &AirLoads) -> [f64; 2] {
    loads.forces.iter().fold([0.0; 2], |[aft, up], f| [aft + f.aft, up + f.up])
}

#[test]
fn verif_the_outline_closes() {
    let model = model(|_| ());
    assert_close("tail angle, deg", model.tail_angle().to_degrees(), 14.41, 2e-4);
    let arm = model.moment_height - model.thrust_height();
    assert_close("thrust arm", arm, data().parker2007.reference.thrust_arm_m.value, 1e-6);
}

#[test]
fn verif_a_body_without_thickness_feels_nothing() {
    // The nozzle opens what the diffuser has closed, so the engine gives back the free stream.
    let flat = model(|vehicle| {
        vehicle.outline.lower_angle_rad.value = 0.0;
        vehicle.outline.upper_angle_rad.value = 0.0;
    });
    let loads = loads(&flat, 8.0, &attitude(0.0, 0.0, 0.0));
    let size = flat.medium.momentum_flux(&ahead(&flat, 8.0));
    for force in [loads.lift(), loads.drag(), loads.thrust] {
        assert!(force.abs() < ROUNDING * size, "{force}");
    }
    assert_close("pressure", loads.exhaust.pressure, ahead(&flat, 8.0).pressure, ROUNDING);
}

#[test]
fn verif_the_elevator_is_a_symmetric_plate() {
    let model = model(|_| ());
    let stay = sum(&loads(&model, 8.0, &attitude(0.0, 0.0, 0.1)));
    let moved = |delta_e| {
        let [aft, up] = sum(&loads(&model, 8.0, &attitude(0.0, delta_e, 0.1)));
        [aft - stay[0], up - stay[1]]
    };
    let ([drag, lift], [other_drag, other_lift]) = (moved(15.0), moved(-15.0));
    assert!(deviation(other_drag, drag, 1.0) < ROUNDING && drag > 0.0);
    assert!(deviation(-other_lift, lift, 1.0) < ROUNDING && lift > 0.0);
}

#[test]
fn verif_the_elevator_meets_ackeret_and_newton() {
    let model = model(|_| ());
    let coefficient = |mach: f64, delta_e: f64| {
        let force =
            |d| *loads(&model, mach, &attitude(0.0, d, 0.0)).forces.iter().rev().nth(1).unwrap();
        let (moved, stay) = (force(delta_e), force(0.0));
        assert_eq!(stay.up, 0.0);
        let area = data().vehicle.outline.elevator_area_m2_per_m.value;
        let dynamic = 0.5 * model.medium.momentum_flux(&ahead(&model, mach));
        moved.up.hypot(moved.aft) / dynamic / area
    };
    // Ackeret: 4 alpha / sqrt(M^2 - 1).
    let small = 0.01_f64;
    let slope = coefficient(8.0, small) / small.to_radians();
    assert_close("Ackeret", slope, 4.0 / 63_f64.sqrt(), 1e-3);
    // A strong shock: above Newton's 2 sin^2, by a little more than the (gamma + 1) sin^2 of a thin
    // shock layer, for its thickness; hypersonic similarity gives 2.6.
    let newton = 20_f64.to_radians().sin().powi(2);
    let strong = coefficient(12.0, 20.0) / newton;
    assert!((2.4..2.8).contains(&strong), "{strong} sin^2");
}

#[test]
fn verif_capture_conserves_axial_momentum_when_the_shock_is_on_the_lip() {
    // There the stream tube between nose and lip has walls of known pressure only: the fore-body,
    // the shock (nothing ahead of it), the inlet plane.
    let model = model(|_| ());
    let geometry = &data().vehicle.geometry;
    let depth = model.engine.height - model.shoulder_height();
    let alpha = 0.02_f64;
    let turn = data().vehicle.outline.lower_angle_rad.value + alpha;
    let shock = |mach| model.medium.gas.oblique_shock(mach, turn).unwrap().angle - alpha;
    let on_lip = (depth / geometry.fore_body_m.value).atan();
    let (mut low, mut high) = (5.0, 25.0);
    for _ in 0..60 {
        let mach = 0.5 * (low + high);
        if shock(mach) > on_lip { low = mach } else { high = mach }
    }
    let ahead = ahead(&model, low);
    let inflow = model.medium.turned(&ahead, turn).unwrap();
    let run = model.loads(&ahead, &Attitude { alpha, delta_e: 0.0, phi: 0.0 }, &|_| 0.0).unwrap();
    let tube = geometry.fore_body_m.value * alpha.sin() + depth * alpha.cos();
    assert_close("mass", run.mass_flow, model.medium.mass_flux(&ahead) * tube, ROUNDING);
    let lower = turn - alpha;
    let rise = run.mass_flow
        * (model.medium.speed(&ahead) * alpha.cos() - model.medium.speed(&inflow) * lower.cos());
    let push = (inflow.pressure - ahead.pressure) * depth;
    assert_close("axial momentum", push, rise, ROUNDING);
}

#[test]
fn verif_even_bend_is_an_incidence() {
    let model = model(|_| ());
    let stream = ahead(&model, 8.0);
    let bend = 0.013;
    let bent = model.loads(&stream, &attitude(1.0, 5.0, 0.2), &|_| bend).unwrap();
    let mut turned = attitude(1.0, 5.0, 0.2);
    turned.alpha += bend;
    let turned = model.loads(&stream, &turned, &|_| 0.0).unwrap();
    assert_close("aft", sum(&bent)[0], sum(&turned)[0], ROUNDING);
    assert_close("up", sum(&bent)[1], sum(&turned)[1], ROUNDING);
    assert_close("thrust", bent.thrust, turned.thrust, ROUNDING);
}

#[test]
fn verif_panels_integrate_the_plume() {
    // Mean of p_e/(1 + s (p_e/p - 1)) over s in 0..1 is p_e ln(p_e/p)/(p_e/p - 1).
    let model = model(|_| ());
    let stream = ahead(&model, 8.0);
    let run = loads(&model, 8.0, &attitude(2.0, 0.0, 0.3));
    let start = data().vehicle.geometry.fore_body_m.value + data().vehicle.geometry.nacelle_m.value;
    let length = data().vehicle.geometry.length_m.value - start;
    // Upper side, fore-body, nacelle, aft-body: a wall's panels stand together.
    let aft_body = &run.forces[3 * PANELS..4 * PANELS];
    assert!(aft_body.iter().all(|f| f.x > start && f.aft < 0.0));
    let up: f64 = aft_body.iter().map(|f| f.up).sum();
    let ratio = run.exhaust.pressure / stream.pressure;
    let mean = stream.pressure * (ratio * ratio.ln() / (ratio - 1.0) - 1.0);
    assert_close("plume", up, mean * length, 1e-3);
}

#[test]
fn verif_too_much_fuel_chokes_the_burner() {
    let model = model(|_| ());
    let run = |phi| model.loads(&ahead(&model, 8.0), &attitude(1.5, 10.0, phi), &|_| 0.0);
    assert!(run(0.5).is_ok());
    assert!(matches!(run(1.0), Err(GasError::ThermallyChoked { .. })));
}

#[test]
fn verif_level_flight_exists_near_mach_8() {
    // Newton with differences on weight, drag and moment.
    let model = model(|_| ());
    let stream = ahead(&model, 8.0);
    let atmosphere = Atmosphere::new(&data().earth);
    let (gravity, distance) = atmosphere.gravity(25_900.0);
    let speed = model.medium.speed(&stream);
    let weight = model::vehicle(ahv::vehicle::Configuration::Rigid).airframe.mass
        * (gravity - speed * speed / distance);
    let centre = data().parker2007.reference.moment_centre_m.value;
    let arm = model.moment_height - model.thrust_height();
    let balance = |z: &nalgebra::Vector3<f64>| {
        let run = model
            .loads(&stream, &Attitude { alpha: z[0], delta_e: z[1], phi: z[2] }, &|_| 0.0)
            .unwrap();
        nalgebra::Vector3::new(
            (run.lift() + run.thrust * z[0].sin()) / weight - 1.0,
            (run.thrust * z[0].cos() - run.drag()) / weight,
            (run.moment(centre, model.moment_height) + arm * run.thrust) / (10.0 * weight),
        )
    };
    let mut z = nalgebra::Vector3::new(0.02, 0.1, 0.1);
    for _ in 0..20 {
        let value = balance(&z);
        let jacobian = nalgebra::Matrix3::from_fn(|row, column| {
            let mut moved = z;
            moved[column] += 1e-6;
            (balance(&moved)[row] - value[row]) / 1e-6
        });
        z -= jacobian.lu().solve(&value).unwrap();
    }
    assert!(balance(&z).amax() < 1e-9);
    let [alpha, delta_e] = [z[0].to_degrees(), z[1].to_degrees()];
    assert!((0.0..3.0).contains(&alpha), "alpha = {alpha} deg");
    assert!((2.0..15.0).contains(&delta_e), "delta_e = {delta_e} deg");
    assert!((0.02..0.4).contains(&z[2]), "phi = {}", z[2]);
}

proptest! {
    #[test]
    fn property_loads_are_numbers_or_an_error(
        mach in 0.5..20.0f64, alpha in -30.0..30.0f64, delta_e in -40.0..40.0f64,
        phi in 0.0..2.0f64, bend in -0.2..0.2f64,
    ) {
        let model = model(|_| ());
        let run = model.loads(&ahead(&model, mach), &attitude(alpha, delta_e, phi), &|x| bend * x / 30.0);
        if let Ok(run) = run {
            prop_assert!(run.thrust.is_finite() && run.lift().is_finite() && run.drag().is_finite());
            prop_assert!(run.moment(16.0, 0.0).is_finite() && run.mass_flow > 0.0);
        }
    }

    #[test]
    fn property_fuel_adds_thrust(alpha in -2.0..5.0f64, phi in 0.0..0.4f64) {
        let model = model(|_| ());
        let thrust = |phi| loads(&model, 8.0, &attitude(alpha, 0.0, phi)).thrust;
        prop_assert!(thrust(phi + 0.05) > thrust(phi));
    }
}
