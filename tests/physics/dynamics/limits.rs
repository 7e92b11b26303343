//! A flight ends where the liquid would leave its depth.

use crate::model::{data, setup, shown};
use ahv::error::{Error, LimitedKind, LimitedQuantity};
use ahv::flight::Flight;
use ahv::fmu::Message;
use ahv::vehicle::{GUSTS, STATES};

const NAMES: [&str; 2] = ["slosh1", "slosh2"];
/// The instant is located to a nanosecond, in which a sloshing mass moves by less than this, m.
const MOVED: f64 = 1e-7;
/// Enough for a sloshing mass to swing to both sides, s.
const SWING_S: f64 = 2.0;

/// A flight whose sloshing mass is thrown with a speed that carries it a number of depths far.
fn thrown(tank: usize, depths: f64, fuel_burn: bool) -> (Flight, f64) {
    let burn = ("fuel_burn", f64::from(fuel_burn));
    let flight = setup(&[burn]).fly().unwrap();
    let airframe = &flight.vehicle().airframe;
    let depth = airframe.depth[tank];
    let speed = depths * depth * flight.vehicle().omega[3 + tank];
    let offset = (["slosh1_dot_offset", "slosh2_dot_offset"][tank], speed);
    (setup(&[burn, offset]).fly().unwrap(), depth)
}

/// Depth of the liquid in a tank with what is on board, m.
fn depth_of(tank: usize, flight: &Flight) -> f64 {
    let data = data();
    let mass = &data.vehicle.mass;
    let joint = mass.beam_joint_m.value;
    let full = mass.propellant_fraction.value
        * (mass.fore_beam_kg_per_m2.value * joint
            + mass.aft_beam_kg_per_m2.value * (data.vehicle.geometry.length_m.value - joint));
    let on_board = flight.state()[STATES - 1] + mass.residual_fraction.value * full;
    data.vehicle.tank[tank].depth_full_m.value * on_board / full
}

#[test]
fn verif_liquid_that_reaches_its_depth_ends_the_step_at_the_last_valid_instant() {
    for fuel_burn in [false, true] {
        for (tank, name) in NAMES.into_iter().enumerate() {
            for depths in [1.5, -1.5] {
                let (mut flight, depth) = thrown(tank, depths, fuel_burn);
                let error = flight.advance(SWING_S).unwrap_err();
                let Error::Envelope { limited, time_s } = error else { panic!("{error}") };
                let LimitedQuantity { kind, value, limits: [min, max] } = limited;
                assert_eq!(kind, LimitedKind::Slosh(tank), "{error}");
                assert!(time_s > 0.0 && time_s < SWING_S && time_s == flight.time(), "{error}");
                let limit = depth_of(tank, &flight);
                assert!((max - limit).abs() < 1e-6 && min == -max, "{error}: {limit}");
                assert!(if fuel_burn { max < depth } else { max == depth }, "{error}: {depth}");
                let left = max - value.abs();
                assert!((0.0..MOVED).contains(&left), "{error}: {left:.1e}");
                assert!(value * depths > 0.0, "{error}: thrown to the other side");

                // The state is that instant's: it holds, shows the value, and goes no further.
                flight.check().unwrap_or_else(|error| panic!("{error}"));
                assert_eq!(shown(&mut flight, name), value);
                let control = flight.evaluate().unwrap().control;
                let vehicle = flight.vehicle();
                assert!(vehicle.holds(flight.state(), &control, [0.0; GUSTS]));
                let (state, time) = (*flight.state(), flight.time());
                let again = flight.advance(time + 1e-3).unwrap_err();
                let same = matches!(again, Error::Envelope { limited, .. } if limited.kind == kind);
                assert!(same, "{again}");
                assert!(flight.time() - time < 1e-8, "{again}");
                assert!(crate::model::distance(flight.state(), &state) < 1e-3, "{again}");
            }
        }
    }
}

#[test]
fn verif_liquid_that_stays_within_its_depth_flies_on() {
    for fuel_burn in [false, true] {
        for tank in 0..NAMES.len() {
            let (mut flight, _) = thrown(tank, 0.5, fuel_burn);
            flight.advance(0.5).unwrap_or_else(|error| panic!("{error}"));
        }
    }
}

#[test]
fn verif_a_fast_engine_is_not_too_far_from_choking() {
    // At Mach 10 the burner takes more than its air can burn: the margin has no upper limit.
    let setup = setup(&[("aero", 3.0), ("mach0", 10.5), ("altitude0", 28_000.0)]);
    let mut flight = setup.fly().unwrap_or_else(|error| panic!("{error}"));
    assert!(shown(&mut flight, "choking_margin") > 1.0);
    flight.advance(0.1).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn verif_a_state_beyond_the_depth_is_refused_also_from_outside() {
    for (tank, name) in NAMES.into_iter().enumerate() {
        let (mut flight, depth) = thrown(tank, 0.1, false);
        let mut state = *flight.state();
        let slosh = flight.vehicle().airframe.slosh[tank];
        let mode = if slosh[3].abs() > slosh[4].abs() { 3 } else { 4 };
        state[5 + 2 * mode] += 1.01 * depth / slosh[mode];
        flight.set_state(&state);
        let error = flight.check().unwrap_err();
        let Error::Envelope { limited, .. } = error else { panic!("{error}") };
        let LimitedQuantity { kind, value, limits: [_, max] } = limited;
        assert_eq!(kind, LimitedKind::Slosh(tank), "{error}");
        assert!(value > max && max == depth, "{error}");
        let told = Message(error).to_string();
        assert!(told.starts_with(&format!("{name} = ")), "{told}");
    }
}
