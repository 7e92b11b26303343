//! The same flight through both versions of the standard: the same bits, under the same watch.

use crate::common::{fmi2, fmi3, reference};
use crate::flights::{Vehicle, vehicles};
use crate::host::references;
use crate::master::order::Order;
use crate::master::{Api, Slave};
use crate::watch::Watch;
use ahv::flight::Setup;
use ahv::vehicle::{NOMINAL, STATES};
use fmi_model::Role;
use fmi_model::instance::Interface;
use fmi_model::status::Status;

/// What a flight came to, as bits.
type Bits = Vec<u64>;

fn made<'a, A: Api<Model = Setup>>(
    api: &'a A,
    interface: Interface,
    (configuration, set, burn): Vehicle,
) -> Slave<'a, A> {
    let slave = Slave::with(api, interface, false);
    assert_eq!(slave.set_enumeration("configuration", configuration), Status::Ok);
    assert_eq!(slave.set_enumeration("aero", set), Status::Ok);
    assert_eq!(slave.set_boolean("fuel_burn", burn != 0), Status::Ok);
    slave
}

/// Values and derivatives of an instance.
fn looked_at<A: Api<Model = Setup>>(slave: &Slave<A>, watch: &mut Watch, scene: &str) -> Bits {
    let unknowns = references(|role| {
        matches!(role, Role::Output(_) | Role::OutputState(_) | Role::Derivative(_))
    });
    let mut bits = watch.call("values", scene, || slave.bits());
    for known in ["q", "eta1", "delta_e", "w_gust"].map(reference) {
        let mut changes = vec![f64::NAN; unknowns.len()];
        let status = watch.call("directional derivative", scene, || {
            slave.api.directional(slave.c, &unknowns, &[known], &[1.0], &mut changes)
        });
        assert_eq!(status, Status::Ok, "{scene}");
        bits.extend(changes.into_iter().map(f64::to_bits));
    }
    bits
}

fn co_simulation<A: Api<Model = Setup>>(api: &A, watch: &mut Watch, vehicle: Vehicle) -> Bits {
    let slave = made(api, Interface::CoSimulation, vehicle);
    let scene = format!("co-simulation {vehicle:?}");
    assert_eq!(watch.call("begin", &scene, || slave.begin_with(Some(1e-8), 0.0, None)), Status::Ok);
    assert_eq!(watch.call("exit", &scene, || slave.exit()), Status::Ok);
    let (mut bits, mut ended) = (Bits::new(), false);
    let inputs: [&[(&str, f64)]; 5] = [
        &[],
        &[("delta_e", 1e-3), ("phi", 0.01)],
        &[("w_gust", 20.0), ("u_gust", -30.0)],
        &[("w_gust", 0.0), ("u_gust", 1e-300), ("delta_e", -1e300), ("phi", 1e300)],
        &[("phi", 0.0)],
    ];
    for (i, now) in inputs.iter().enumerate() {
        let scene = format!("{scene} {now:?}");
        for (name, value) in *now {
            assert_eq!(watch.call("set", &scene, || slave.set(name, *value)), Status::Ok);
        }
        // The last one is too long for any flight.
        let step = if i + 1 == inputs.len() { 1e3 } else { 0.01 };
        let point = slave.time();
        let stepped = watch.call("step", &scene, || slave.stepped(point, step));
        bits.extend([stepped.time.to_bits(), stepped.ended.into()]);
        bits.extend(looked_at(&slave, watch, &scene));
        let (_, rate) = watch.call("rate", &scene, || slave.output_derivative("lift", 1));
        bits.push(rate.to_bits());
        // The bytes of a state are those of the other version.
        let state = watch.call("save", &scene, || slave.present());
        bits.extend(state.into_iter().map(u64::from));
        ended = stepped.ended;
        if ended {
            break;
        }
    }
    assert!(ended, "{scene}");
    assert_eq!(watch.call("terminate", &scene, || slave.terminate()), Status::Ok);
    bits
}

fn model_exchange<A: Api<Model = Setup>>(api: &A, watch: &mut Watch, vehicle: Vehicle) -> Bits {
    let slave = made(api, Interface::ModelExchange, vehicle);
    let c = slave.c;
    assert_eq!((slave.begin(), slave.exit()), (Status::Ok, Status::Ok));
    assert_eq!(watch.call("update", "", || api.update(c)), (Status::Ok, false));
    assert_eq!(api.enter_continuous_time_mode(c), Status::Ok);
    let mut bits = looked_at(&slave, watch, "model exchange");
    let mut start = [f64::NAN; STATES];
    assert_eq!(api.get_states(c, &mut start), Status::Ok);
    for i in 0..STATES {
        for offset in [1e-3 * NOMINAL[i], -start[i], 1e3 * NOMINAL[i], 1e300] {
            let scene = format!("{vehicle:?} state {i} + {offset:e}");
            let (mut x, mut rates) = (start, [f64::NAN; STATES]);
            x[i] += offset;
            assert_eq!(watch.call("states", &scene, || api.set_states(c, &x)), Status::Ok);
            let status = watch.call("rates", &scene, || api.get_rates(c, &mut rates));
            let completed = watch.call("completed", &scene, || api.completed(c));
            bits.extend([status as u64, completed.status as u64, completed.end.into()]);
            bits.extend(rates.map(f64::to_bits));
        }
    }
    bits
}

/// Flights of every vehicle, with the same bits.
pub fn compare(watch: &mut Watch) {
    let (old, new) = (fmi2::Api::load(), fmi3::Api::load());
    for vehicle in vehicles() {
        let idle = &mut Watch::idle();
        let (ours, theirs) =
            (co_simulation(&new, watch, vehicle), co_simulation(&old, idle, vehicle));
        assert!(ours == theirs, "co-simulation {vehicle:?}");
        let (ours, theirs) =
            (model_exchange(&new, watch, vehicle), model_exchange(&old, idle, vehicle));
        assert!(ours == theirs, "model exchange {vehicle:?}");
    }
}

/// Steps of FMI 3.0 into which the master looks.
pub fn look(watch: &mut Watch, vehicle: Vehicle) {
    let api = fmi3::Api::load();
    let slave = fmi3::Slave::open(&api, true, &[]);
    assert_eq!(slave.set_enumeration("configuration", vehicle.0), Status::Ok);
    assert_eq!((slave.begin(), slave.exit()), (Status::Ok, Status::Ok));
    let answers = watch.call("look into a step", "", || {
        slave.step_with(0.0, 0.1, |moment| {
            slave.get("V");
            (moment.time > 0.05).then_some(moment.time)
        })
    });
    assert_eq!((answers.status, answers.early), (Status::Ok, answers.time < 0.1));
}

/// Every function of FMI 3.0 with harmless arguments, wherever it is legal or not.
pub fn every_function(watch: &mut Watch) {
    let api = fmi3::Api::load();
    for interface in crate::INTERFACES {
        for (name, _) in fmi3::Api::TABLE {
            for modes in 0..4 {
                let slave = made(&api, interface, (1, 1, 0));
                let other = made(&api, interface, (1, 1, 0));
                let go_on: [fn(&fmi3::Slave) -> Status; 3] =
                    [|slave| slave.begin(), |slave| slave.exit(), |slave| slave.terminate()];
                for go_on in &go_on[..modes] {
                    assert_eq!(go_on(&slave), Status::Ok);
                }
                watch.call(name, "", || fmi3::Api::call(&slave, &other, name));
            }
        }
    }
}

/// A little of everything, for hosts that do not forgive.
pub fn short(vehicle: Vehicle) {
    let watch = &mut Watch::idle();
    let api = fmi3::Api::load();
    co_simulation(&api, watch, vehicle);
    model_exchange(&api, watch, vehicle);
    look(watch, vehicle);
}
