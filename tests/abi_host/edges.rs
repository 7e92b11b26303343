//! Parameters at the ends of their ranges, and arguments that make no sense.

use crate::INTERFACES;
use crate::common::configurations;
use crate::common::fmi2::Api;
use crate::flights::{choose, vehicles};
use crate::host::Host;
use crate::watch::Watch;
use ahv::variables::TABLE;
use fmi_model::instance::Interface;
use fmi_model::v2::sys::Status;
use fmi_model::{Kind, Role};

/// Finite, and senseless.
const ABSURD: [f64; 9] = [1e300, -1e300, f64::MAX, f64::MIN, 1e-300, 5e-324, -5e-324, 1e30, -1e18];

fn fly(host: &mut Host) {
    if host.start() {
        host.set("delta_e", 1e-3);
        host.step(0.0, 0.02);
        host.lead("phi", 1, 0.1);
        let point = host.time();
        host.step(point, 0.02);
        host.read();
        host.directional_derivatives(1.0);
        host.round_trip();
    }
}

/// Each parameter at both ends of its range, and settings that belong together.
pub fn parameters(api: &Api, watch: &mut Watch) {
    let together: [&[(&str, f64)]; 20] = [
        &[("fuel_fraction", 0.0), ("slosh_damping", 0.0)],
        &[("fuel_fraction", 1e-6)],
        &[("fuel_fraction", 1e-300)],
        &[("fuel_fraction", 0.0), ("slosh_frequency", 10.0)],
        &[("slosh_frequency", 0.1)],
        &[("slosh_frequency", 19.0)],
        &[("mach0", 6.0)],
        &[("mach0", 11.0)],
        &[("mach0", 11.0), ("altitude0", 18000.0)],
        &[("mach0", 2.0), ("altitude0", 60000.0), ("gamma0", 1.5)],
        &[("mach0", 0.1), ("altitude0", 85000.0)],
        &[("mach0", 30.0), ("altitude0", 0.0), ("gamma0", -1.5)],
        &[("mach0", 26.0), ("altitude0", 80000.0)],
        &[("alpha_offset", 0.05), ("q_offset", 1.0)],
        &[("alpha_offset", 1.5), ("q_offset", -10.0), ("eta1_offset", 5.0)],
        &[("slosh1_offset", 0.05), ("slosh2_dot_offset", 0.1)],
        &[("eta1_dot_offset", 500.0), ("eta3_dot_offset", -500.0)],
        &[("mass_factor", 0.5), ("inertia_factor", 10.0), ("density_factor", 10.0)],
        &[("elevator_factor", 0.1), ("thrust_factor", 0.1), ("lift_factor", 10.0)],
        &[("stiffness_factor", 1000.0), ("structural_damping_factor", 0.1)],
    ];
    let ends = TABLE
        .iter()
        .filter(|variable| matches!(variable.role, Role::Parameter { .. }))
        .flat_map(|v| v.range.into_iter().flatten().map(|end| vec![(v.name, end)]));
    let settings: Vec<_> = together.iter().map(|list| list.to_vec()).chain(ends).collect();
    for configuration in configurations() {
        for (number, setting) in settings.iter().enumerate() {
            for trim in [1, 0] {
                // The burning vehicle is thirty ones: only where settings meet.
                for burn in 0..=i32::from(number < together.len() && trim == 1) {
                    let set = 1 + (number % 3) as i32;
                    let mut host = Host::new(api, watch, Interface::CoSimulation, "");
                    choose(&mut host, (configuration, set, burn));
                    host.set_boolean("trim", trim);
                    for (name, value) in setting {
                        host.set(name, *value);
                    }
                    fly(&mut host);
                    host.finish();
                }
            }
        }
    }
}

/// Absurd numbers to every setter and wherever else a number is taken.
pub fn arguments(api: &Api, watch: &mut Watch) {
    for vehicle in vehicles().filter(|(_, set, burn)| *set == 1 && *burn == 0) {
        for interface in INTERFACES {
            for value in ABSURD {
                before_a_start(api, watch, interface, vehicle, value);
                let mut host = Host::new(api, watch, interface, "");
                choose(&mut host, vehicle);
                assert!(host.start());
                in_flight(&mut host, interface, value);
                host.finish();
            }
        }
    }
}

fn before_a_start(
    api: &Api,
    watch: &mut Watch,
    interface: Interface,
    vehicle: (i32, i32, i32),
    value: f64,
) {
    let mut host = Host::new(api, watch, interface, "");
    choose(&mut host, vehicle);
    for variable in TABLE.iter().filter(|variable| matches!(variable.kind, Kind::Real(_))) {
        if !matches!(variable.role, Role::Input(_)) {
            host.scene.clear();
            host.set(variable.name, value);
        }
    }
    host.set_integer("configuration", i32::MAX);
    host.set_boolean("trim", i32::MIN);
    host.scene = format!("experiment {value:e}");
    for (tolerance, start) in [(value, 0.0), (1e-8, value)] {
        host.setup(tolerance, start, f64::MAX);
    }
    // One that is taken has a step of one second, as far as time has digits for it.
    if host.initialise() && interface == Interface::CoSimulation {
        let point = host.time();
        host.step(point, 1.0);
        host.step(point, point.abs());
        host.read();
    }
    host.finish();
}

fn in_flight(host: &mut Host, interface: Interface, value: f64) {
    let flying = host.scene.clone();
    if interface == Interface::ModelExchange {
        host.enter_continuous_time_mode();
        host.set_time(value);
        let start = host.states();
        for scale in [0.0, 1.0] {
            host.scene = format!("{flying} states {value:e}");
            host.set_states(&start.map(|x| scale * x + value));
            host.rates();
            host.completed();
            host.directional_derivatives(value);
            host.read();
        }
        host.set_states(&start);
    }
    for variable in &TABLE {
        host.scene.clone_from(&flying);
        host.set(variable.name, value);
    }
    host.scene = format!("{flying} {value:e}");
    host.read();
    host.directional_derivatives(value);
    host.directional_derivatives(1.0);
    if interface == Interface::ModelExchange {
        host.rates();
        host.completed();
        return;
    }
    host.step(0.0, 0.01);
    for name in ["delta_e", "phi", "w_gust", "u_gust"] {
        for order in 1..=3 {
            host.scene = format!("{flying} derivative {order} of {name} {value:e}");
            host.lead(name, order, value);
        }
        let point = host.time();
        if host.step(point, 1e-3) == Status::Ok {
            host.output_rates();
            host.round_trip();
        }
        host.lead(name, 2, value);
    }
    host.scene = format!("{flying} step {value:e}");
    let point = host.time();
    host.step(value, 0.01);
    host.step(value, value);
    host.step(point, value);
    host.read();
    host.round_trip();
}
