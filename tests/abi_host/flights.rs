//! Flights of every vehicle through both interfaces.

use crate::common::configurations;
use crate::common::fmi2::Api;
use crate::host::Host;
use crate::watch::Watch;
use ahv::flight::Setup;
use ahv::vehicle::NOMINAL;
use fmi_model::instance::Interface;
use fmi_model::v2::sys::Status;
use fmi_model::{Kind, table::find};

/// Configuration, coefficient set, whether fuel burns.
pub type Vehicle = (i32, i32, i32);

pub fn vehicles() -> impl Iterator<Item = Vehicle> {
    let built_in = Setup::new().expect("the embedded data are valid");
    let Kind::Enumeration(_, sets) = find::<Setup>("aero").unwrap().kind_in(&built_in) else {
        unreachable!()
    };
    configurations().into_iter().flat_map(move |configuration| {
        sets.iter().flat_map(move |&(_, set, _)| [0, 1].map(|burn| (configuration, set, burn)))
    })
}

pub fn choose(host: &mut Host, (configuration, set, burn): Vehicle) {
    host.scene.clear();
    assert_eq!(host.set_integer("configuration", configuration), Status::Ok);
    assert_eq!(host.set_integer("aero", set), Status::Ok);
    assert_eq!(host.set_boolean("fuel_burn", burn), Status::Ok);
}

pub fn co_simulation(api: &Api, watch: &mut Watch, vehicle: Vehicle) {
    let mut host = Host::new(api, watch, Interface::CoSimulation, "co-simulation");
    choose(&mut host, vehicle);
    assert!(host.start());
    host.read();
    host.directional_derivatives(1.0);
    host.output_rates();
    // At rest, with gusts and saturated controls, with inputs that move, and into the envelope's edge.
    let flown = host.scene.clone();
    let scenes: [&[(&str, f64)]; 5] = [
        &[],
        &[("delta_e", 1e-3), ("phi", 0.01)],
        &[("w_gust", 20.0), ("u_gust", -30.0)],
        &[("w_gust", 0.0), ("u_gust", 1e-300), ("delta_e", -1e300), ("phi", 1e300)],
        &[("delta_e", 0.2), ("phi", -1e-3), ("u_gust", 0.0)],
    ];
    for inputs in scenes {
        for (name, value) in inputs {
            host.set(name, *value);
        }
        for moves in [false, true] {
            host.scene = format!("{flown} {inputs:?} moves={moves}");
            if moves {
                host.lead("delta_e", 1, 1e-3);
                host.lead("w_gust", 3, -2.0);
            }
            let point = host.time();
            host.step(point, 0.01);
            host.output_rates();
            host.round_trip();
        }
        host.read();
        host.directional_derivatives(1.0);
    }
    let point = host.time();
    assert_ne!(host.step(point, 1e3), Status::Ok, "{}", host.scene);
    host.read();
    host.round_trip();
    host.finish();
}

pub fn model_exchange(api: &Api, watch: &mut Watch, vehicle: Vehicle) {
    let mut host = Host::new(api, watch, Interface::ModelExchange, "model exchange");
    choose(&mut host, vehicle);
    assert!(host.start());
    host.enter_continuous_time_mode();
    let start = host.states();
    host.rates();
    assert!(!host.completed());
    for i in 0..start.len() {
        // Off the trim, at zero, beyond the envelope, far beyond.
        for offset in [1e-3 * NOMINAL[i], -start[i], 1e3 * NOMINAL[i], -1e4 * NOMINAL[i], 1e300] {
            host.scene = format!("{vehicle:?} state {i} + {offset:e}");
            let mut x = start;
            x[i] += offset;
            host.set_time(0.5);
            host.set_states(&x);
            host.rates();
            host.completed();
            host.directional_derivatives(1.0);
            host.read();
        }
    }
    host.enter_event_mode();
    host.round_trip();
    host.finish();
}

/// A little of everything, for hosts that do not forgive.
pub fn short(api: &Api, vehicle: Vehicle) {
    let mut watch = Watch::idle();
    let mut host = Host::new(api, &mut watch, Interface::CoSimulation, "");
    choose(&mut host, vehicle);
    assert!(host.start());
    host.set("delta_e", 1e-3);
    host.lead("w_gust", 1, 1.0);
    assert_eq!(host.step(0.0, 0.01), Status::Ok);
    assert_eq!(host.step(0.01, 0.01), Status::Ok);
    host.round_trip();
    host.directional_derivatives(1.0);
    host.finish();
    let mut host = Host::new(api, &mut watch, Interface::ModelExchange, "");
    choose(&mut host, vehicle);
    assert!(host.start());
    host.enter_continuous_time_mode();
    let x = host.states();
    host.set_states(&x);
    host.rates();
    host.directional_derivatives(1.0);
    host.enter_event_mode();
    host.round_trip();
    host.finish();
}
