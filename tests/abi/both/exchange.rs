//! Model exchange: the master integrates.

use super::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use ahv::vehicle::{NOMINAL, STATES, State};
use fmi_model::status::Status;

/// A flexible, sloshing vehicle.
const SLOSH_BEAM: i32 = 3;

/// What is returned for a value that cannot be taken.
const REFUSED: Status = Api::REFUSED;

/// An instance in continuous-time mode.
fn exchanging(api: &Api, configuration: i32) -> Slave<'_> {
    let slave = Slave::exchange(api);
    slave.start_as(configuration);
    assert_eq!(api.update(slave.c), (Status::Ok, false));
    assert_eq!(api.enter_continuous_time_mode(slave.c), Status::Ok);
    slave
}

fn states(slave: &Slave) -> State {
    let mut x = [f64::NAN; STATES];
    assert_eq!(slave.api.get_states(slave.c, &mut x), Status::Ok);
    x
}

fn set_states(slave: &Slave, x: &[f64]) -> Status {
    slave.api.set_states(slave.c, x)
}

fn set_time(slave: &Slave, time: f64) -> Status {
    slave.api.set_time(slave.c, time)
}

fn derivatives(slave: &Slave) -> (Status, State) {
    let mut rates = [f64::NAN; STATES];
    (slave.api.get_rates(slave.c, &mut rates), rates)
}

/// Whether the end of an integrator's step asks for an end of the simulation.
fn completed(slave: &Slave) -> bool {
    let completed = slave.api.completed(slave.c);
    assert_eq!((completed.status, completed.event), (Status::Ok, false), "there are no events");
    completed.end
}

/// One step of the classical Runge-Kutta method, by the master.
fn runge_kutta(slave: &Slave, t: f64, h: f64) {
    let x = states(slave);
    let rate = |offset: f64, along: &State| {
        let moved: State = std::array::from_fn(|i| x[i] + offset * along[i]);
        assert_eq!(set_time(slave, t + offset), Status::Ok);
        assert_eq!(set_states(slave, &moved), Status::Ok);
        let (status, rates) = derivatives(slave);
        assert_eq!(status, Status::Ok);
        rates
    };
    let k1 = rate(0.0, &[0.0; STATES]);
    let k2 = rate(0.5 * h, &k1);
    let k3 = rate(0.5 * h, &k2);
    let k4 = rate(h, &k3);
    let next: State =
        std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    assert_eq!(set_time(slave, t + h), Status::Ok);
    assert_eq!(set_states(slave, &next), Status::Ok);
    assert!(!completed(slave));
}

/// Over the nominal values: fourth order at 0.1 ms, 0.01 rad of the fastest mode a step.
const ACCURACY: f64 = 1e-7;

#[test]
fn verif_a_master_that_integrates_itself_arrives_where_co_simulation_does() {
    let api = Api::load();
    let (outside, inside) = (exchanging(&api, SLOSH_BEAM), Slave::flying_as(&api, SLOSH_BEAM));
    assert_eq!(states(&outside)[0], inside.get("V"), "the same start");
    for slave in [&outside, &inside] {
        assert_eq!((slave.set("delta_e", 0.005), slave.set("phi", 0.02)), (Status::Ok, Status::Ok));
    }
    let (steps, h) = (3000, 1e-4);
    for i in 0..steps {
        runge_kutta(&outside, f64::from(i) * h, h);
    }
    assert_eq!(inside.step(0.0, f64::from(steps) * h), Status::Ok);
    let names = ["V", "h", "gamma", "alpha", "q", "eta1", "eta1_dot", "eta2", "eta2_dot", "eta3"];
    for (i, name) in names.into_iter().enumerate() {
        let error = (outside.get(name) - inside.get(name)).abs() / NOMINAL[i];
        assert!(error < ACCURACY, "{name}: {error:e}");
    }
    assert!((outside.get("q")).abs() > 1e-3, "the manoeuvre moves the vehicle");
}

#[test]
fn derivatives_are_the_variables_of_that_name_and_level_flight_stands_still() {
    let api = Api::load();
    let slave = exchanging(&api, SLOSH_BEAM);
    let (status, rates) = derivatives(&slave);
    assert_eq!(status, Status::Ok);
    for (i, nominal) in NOMINAL.into_iter().enumerate() {
        assert!(rates[i].abs() < 1e-6 * nominal, "{i}: {}", rates[i]);
    }
    assert_eq!(rates[4], slave.get("der(q)"));
    assert_eq!(slave.set("delta_e", 0.01), Status::Ok);
    assert_eq!(derivatives(&slave).1[4], slave.get("der(q)"));
    assert!(slave.get("der(q)").abs() > 1e-3, "inputs act at once");
}

#[test]
fn the_edge_of_the_fits_ends_the_simulation_after_a_completed_step_with_its_reason() {
    let api = Api::load();
    let slave = exchanging(&api, 1);
    let mut x = states(&slave);
    x[3] = 0.3;
    assert_eq!(set_states(&slave, &x), Status::Ok);
    assert_eq!(derivatives(&slave).0, Status::Ok, "an integrator may look beyond the edge");
    assert!(slave.log().is_empty());
    assert!(completed(&slave));
    let record = slave.message();
    assert!(
        record.category == "logStatusDiscard" && record.message.contains("alpha"),
        "{record:?}"
    );
    assert_eq!(api.enter_event_mode(slave.c), Status::Ok);
    assert_eq!(api.update(slave.c), (Status::Ok, true));
}

#[test]
fn trial_states_without_numbers_are_discarded_and_senseless_ones_refused() {
    let api = Api::load();
    let slave = exchanging(&api, 1);
    let good = states(&slave);
    let mut still = good;
    still[0] = 0.0;
    assert_eq!(set_states(&slave, &still), Status::Ok);
    let (status, rates) = derivatives(&slave);
    assert!(status == Status::Discard && rates.iter().all(|rate| rate.is_nan()), "none written");
    let message = slave.message().message;
    assert!(
        message.contains("V = 0: the equations have numbers in [500, 8589934592]"),
        "{message}"
    );
    assert_eq!(slave.get("V"), 0.0, "the state itself can be read");
    assert_eq!(set_states(&slave, &good), Status::Ok);
    let mut wild = good;
    wild[4] = f64::NAN;
    slave.refuses(REFUSED, &["q = NaN"], |slave| set_states(slave, &wild));
    slave.refuses(Status::Error, &[" = 15 is refused"], |slave| set_states(slave, &good[1..]));
    slave.refuses(Status::Error, &["time = inf"], |slave| set_time(slave, f64::INFINITY));
    assert_eq!(states(&slave), good);
}

/// Value references of the states, in their order.
fn state_references() -> [u32; STATES] {
    ahv::vehicle::STATE_NAMES.map(reference)
}

#[test]
fn set_real_sets_states_as_set_continuous_states_does() {
    let api = Api::load();
    let (by_name, by_order) = (exchanging(&api, SLOSH_BEAM), exchanging(&api, SLOSH_BEAM));
    let start = states(&by_name);
    assert_eq!(by_name.bits(), by_order.bits(), "evaluated before, so that a stale value shows");
    let moved: State = std::array::from_fn(|i| start[i] + 1e-2 * NOMINAL[i]);
    let references = state_references();
    assert_eq!(by_name.set_reals(&references, &moved), Status::Ok);
    assert_eq!(set_states(&by_order, &moved), Status::Ok);
    assert_eq!(states(&by_name), moved);
    assert_eq!(derivatives(&by_name), derivatives(&by_order));
    assert_eq!(by_name.bits(), by_order.bits());

    // One state, beside an input: the others stay. In event mode as well.
    for event_mode in [false, true] {
        if event_mode {
            assert_eq!(api.enter_event_mode(by_name.c), Status::Ok);
        }
        let (alpha, elevator) = (0.02 + f64::from(event_mode) * 0.01, reference("delta_e"));
        assert_eq!(by_name.set_reals(&[references[3], elevator], &[alpha, 0.01]), Status::Ok);
        let mut wanted = moved;
        wanted[3] = alpha;
        assert_eq!(states(&by_name), wanted);
        assert_eq!(
            (set_states(&by_order, &wanted), by_order.set("delta_e", 0.01)),
            (Status::Ok, Status::Ok)
        );
        assert_eq!(derivatives(&by_name), derivatives(&by_order));
    }
}

#[test]
fn a_refused_state_changes_nothing_and_co_simulation_keeps_its_own() {
    let api = Api::load();
    let slave = exchanging(&api, SLOSH_BEAM);
    let (before, alpha) = (slave.bits(), reference("alpha"));
    let refused = [
        ("q", f64::NAN, REFUSED, "q = NaN is refused"),
        ("eta1", f64::INFINITY, REFUSED, "eta1 = inf is refused"),
        ("lift", 1.0, Status::Error, "lift = 1 is refused"),
        ("der(q)", 1.0, Status::Error, "der(q) = 1 is refused"),
        ("mach0", 7.0, Status::Error, "mach0 = 7 is refused"),
        ("alpha_trim", 0.0, Status::Error, "alpha_trim = 0 is refused"),
        ("w_gust", 300.0, REFUSED, "w_gust = 300 is refused"),
    ];
    for (name, value, status, reason) in refused {
        let references = [alpha, reference(name)];
        slave.refuses(status, &[reason], |slave| slave.set_reals(&references, &[0.05, value]));
        assert_eq!(slave.bits(), before, "{name}");
    }
    let (early, flying) = (Slave::exchange(&api), Slave::flying(&api));
    for slave in [early, flying] {
        let words = ["alpha = 0.05 is refused"];
        slave.refuses(Status::Error, &words, |slave| slave.set("alpha", 0.05));
    }
}

#[test]
fn an_fmu_state_brings_a_trial_back_and_is_refused_by_the_other_interface() {
    let api = Api::load();
    let slave = exchanging(&api, SLOSH_BEAM);
    let saved = slave.save();
    let before = slave.bits();
    runge_kutta(&slave, 0.0, 0.01);
    assert_eq!(slave.set("delta_e", 0.1), Status::Ok);
    assert_eq!(slave.load(saved), Status::Ok);
    assert_eq!(slave.bits(), before);
    let other = Slave::flying(&api);
    let unchanged = other.bits();
    other.refuses(Status::Error, &["one of Model Exchange"], |other| other.load(saved));
    assert_eq!(other.bits(), unchanged);
    slave.free(saved);
    let flying = other.save();
    assert_eq!(slave.load(flying), Status::Error);
    other.free(flying);
}

#[test]
fn directional_derivatives_serve_an_implicit_integrator() {
    let api = Api::load();
    let slave = exchanging(&api, SLOSH_BEAM);
    let (rate, state) = (reference("der(eta1_dot)"), reference("eta1"));
    let mut changes = [f64::NAN];
    assert_eq!(api.directional(slave.c, &[rate], &[state], &[1.0], &mut changes), Status::Ok);
    let [change] = changes;
    let omega = slave.get("omega1");
    // The air takes off a tenth.
    assert!((0.85..1.0).contains(&(change / -(omega * omega))), "a spring: {change}");
}
