//! What reaches the master's logger, and how.

use crate::common::{Api, Sink, Slave, callbacks};
use fmi_model::identity::guid;
use fmi_model::log::CATEGORIES;
use fmi_model::v2::sys::{self, CallbackFunctions, FmiString, Status, Type};
use std::ffi::{CString, c_void};
use std::ptr::null;

fn switch(slave: &Slave, on: bool, categories: &[&str]) -> Status {
    let names: Vec<_> = categories.iter().map(|&name| CString::new(name).unwrap()).collect();
    let pointers: Vec<_> = names.iter().map(|name| name.as_ptr()).collect();
    // SAFETY: an array of C strings of the length given.
    unsafe { (slave.api.set_debug_logging)(slave.c, on.into(), pointers.len(), pointers.as_ptr()) }
}

#[test]
fn errors_and_discards_are_logged_always_and_events_only_if_enabled() {
    let api = Api::load();
    let events = |slave: &Slave| {
        slave.start();
        !slave.log().is_empty()
    };
    assert!(!events(&Slave::new(&api)), "debug logging is off");
    assert!(events(&Slave::with_logging(&api, true)));

    let slave = Slave::new(&api);
    assert_eq!(switch(&slave, true, &["logEvents"]), Status::Ok);
    assert!(events(&slave));
    slave.leave_envelope();
    assert_eq!(slave.message().category, "logStatusDiscard");
    assert_eq!(slave.reset(), Status::Ok);
    assert!(!events(&slave), "a reset goes back to the logging of fmi2Instantiate");
    assert_eq!(slave.reset(), Status::Ok);

    assert_eq!(switch(&slave, true, &[]), Status::Ok);
    assert_eq!(switch(&slave, false, &["logEvents"]), Status::Ok);
    assert!(!events(&slave));
    slave.leave_envelope();
    assert_eq!(slave.message().category, "logStatusDiscard");
    assert_eq!(switch(&slave, false, &[]), Status::Ok);
    assert_eq!(slave.step(0.0, 0.1), Status::Error);
    assert_eq!(slave.message().category, "logStatusError");
}

#[test]
fn an_unknown_category_is_refused_switches_nothing_and_is_escaped_for_printf() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(switch(&slave, true, &["logEvents", "100%s #r1#"]), Status::Error);
    let record = slave.message();
    assert!(record.message.contains("\"100%%s ##r1##\""), "{}", record.message);
    assert!(record.message.contains("logEvents, logStatusDiscard"), "{}", record.message);
    slave.start();
    assert!(slave.log().is_empty());
}

#[test]
fn every_message_has_the_instance_name_a_declared_category_and_the_status_returned() {
    let api = Api::load();
    let slave = Slave::with_logging(&api, true);
    slave.start();
    assert_eq!(slave.set("V", 1.0), Status::Error);
    slave.leave_envelope();
    let log = slave.log();
    let statuses: Vec<_> = log.iter().map(|record| record.status).collect();
    assert!(statuses.contains(&Status::Ok) && statuses.contains(&Status::Error));
    assert_eq!(statuses.last(), Some(&Status::Discard));
    for record in log {
        assert_eq!(record.name, "one");
        let declared = |category: &fmi_model::log::Category| {
            category.name().to_str() == Ok(record.category.as_str())
        };
        assert!(CATEGORIES.iter().any(declared), "{record:?}");
        assert!(
            !record.message.ends_with('\n') && record.message.starts_with("fmi2"),
            "{record:?}"
        );
    }
}

#[test]
fn an_input_beyond_its_limit_is_said_once_and_changes_no_status() {
    let api = Api::load();
    let said = |slave: &Slave| {
        let log = slave.log();
        let texts: Vec<_> = log.into_iter().map(|record| record.message).collect();
        texts.into_iter().filter(|text| text.contains("its limit")).collect::<Vec<_>>()
    };
    let slave = Slave::with_logging(&api, true);
    for _ in 0..2 {
        slave.start();
        assert_eq!(slave.set("delta_e", 0.001), Status::Ok);
        assert!(said(&slave).is_empty());
        // Degrees in place of radians.
        assert_eq!(slave.set("delta_e", 5.0), Status::Ok);
        let [text] = &said(&slave)[..] else { panic!("one message") };
        let expected = "fmi2SetReal: delta_e asks for 5.18";
        assert!(text.starts_with(expected) && text.contains("gets 0.349"), "{text}");
        assert!(text.ends_with("inputs are in rad, not in degrees"), "{text}");
        // Each control for itself.
        assert_eq!(slave.set("phi", 9.0), Status::Ok);
        let [text] = &said(&slave)[..] else { panic!("one message") };
        assert!(text.starts_with("fmi2SetReal: phi asks for 9."), "{text}");
        assert_eq!(slave.step(0.0, 0.001), Status::Ok);
        assert!(said(&slave).is_empty(), "once");
        assert_eq!(slave.reset(), Status::Ok);
    }
    // A ramp meets the limit within a step; an input set before initialisation is known at its end.
    slave.start();
    assert_eq!(slave.set_input_derivative("phi", 1, -100.0), Status::Ok);
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
    assert!(said(&slave)[0].starts_with("fmi2DoStep: phi asks for -0."));
    assert_eq!(slave.reset(), Status::Ok);
    assert_eq!(slave.set("phi", 2.0), Status::Ok);
    slave.start();
    assert!(said(&slave)[0].starts_with("fmi2ExitInitializationMode: phi asks for 2."));
    // Without logging there is nothing to hear.
    let mute = Slave::flying(&api);
    assert_eq!(mute.set("delta_e", 5.0), Status::Ok);
    assert!(mute.log().is_empty());
}

#[test]
fn parameters_without_effect_are_named_and_have_none() {
    let api = Api::load();
    let flown = |configuration: i32, set: &[(&str, f64)]| {
        let slave = Slave::with_logging(&api, true);
        for (name, value) in set {
            assert_eq!(slave.set(name, *value), Status::Ok, "{name}");
        }
        slave.start_as(configuration);
        let log = slave.log();
        let said = log.into_iter().filter(|record| record.message.contains("has no effect"));
        let said: Vec<_> = said.map(|record| record.message).collect();
        assert_eq!(slave.set("delta_e", 0.001), Status::Ok);
        assert_eq!(slave.step(0.0, 0.1), Status::Ok);
        let names = ["V", "alpha", "q", "eta1", "slosh1", "slosh2", "n_z_imu"];
        (said, names.map(|name| slave.get(name).to_bits()))
    };
    let everywhere =
        [("alpha0", 0.01), ("q0", 0.01), ("eta10", 0.01), ("eta20", 0.01), ("eta30", 0.01)];
    let bending = [
        ("eta1_offset", 0.001),
        ("eta1_dot_offset", 0.01),
        ("eta2_offset", 0.001),
        ("eta2_dot_offset", 0.01),
        ("eta3_offset", 0.001),
        ("eta3_dot_offset", 0.01),
        ("elastic_factor", 1.1),
        ("stiffness_factor", 1.1),
        ("structural_damping_factor", 1.1),
    ];
    let sloshing = [
        ("slosh_damping", 0.02),
        ("slosh_frequency", 9.0),
        ("slosh1_offset", 0.001),
        ("slosh1_dot_offset", 0.01),
        ("slosh2_offset", 0.001),
        ("slosh2_dot_offset", 0.01),
    ];
    for configuration in 1..=3 {
        let plain = flown(configuration, &[]);
        assert!(plain.0.is_empty());
        let kinds = [(&everywhere[..], 4), (&bending, 2), (&sloshing, 3)];
        for (name, value, from) in
            kinds.iter().flat_map(|(kind, from)| kind.iter().map(move |(n, v)| (*n, *v, *from)))
        {
            let (said, bits) = flown(configuration, &[(name, value)]);
            let silent = configuration >= from;
            assert_eq!(
                said.is_empty(),
                silent,
                "{name} in configuration {configuration}: {said:?}"
            );
            assert_eq!(bits != plain.1, silent, "{name} in configuration {configuration}");
            if let [text] = &said[..] {
                let start = format!("fmi2ExitInitializationMode: {name} = {value} has no effect: ");
                assert!(text.starts_with(&start), "{text}");
            }
        }
    }
}

#[test]
fn the_callbacks_are_copied_and_a_null_logger_is_fine() {
    let api = Api::load();
    let (sink, guid) = (Sink::default(), CString::new(guid::<ahv::flight::Setup>()).unwrap());
    for logger in [None, Some(crate::common::recorder())] {
        let functions = Box::new(CallbackFunctions { logger, ..callbacks(&sink) });
        let name = CString::new("short-lived").unwrap();
        // SAFETY: valid arguments; a live instance, freed once.
        unsafe {
            let kind = Type::CO_SIMULATION;
            let c =
                (api.instantiate)(name.as_ptr(), kind, guid.as_ptr(), null(), &*functions, 0, 1);
            drop((functions, name));
            assert_eq!((api.do_step)(c, 0.0, 0.1, 0), Status::Error);
            (api.free_instance)(c);
        }
    }
    let log = sink.lock().unwrap();
    assert_eq!(log.len(), 1);
    assert_eq!(log[0].name, "short-lived");
}

/// A master whose logger asks the FMU for something.
struct Curious {
    api: Api,
    c: sys::Component,
    heard: u32,
}

unsafe extern "C" fn ask(
    environment: *mut c_void,
    _: FmiString,
    _: Status,
    _: FmiString,
    _: FmiString,
) {
    // SAFETY: the environment is the struct below, used by this thread only.
    unsafe {
        let master = environment.cast::<Curious>();
        (*master).heard += 1;
        let mut value = 0.0;
        let (get, c) = ((*master).api.get_real, (*master).c);
        if (*master).heard < 3 {
            assert_eq!(
                get(c, &0, 1, &mut value),
                Status::Error,
                "not allowed before initialisation"
            );
        }
    }
}

#[test]
fn a_logger_may_call_the_instance_that_is_logging() {
    let mut master = Curious { api: Api::load(), c: std::ptr::null_mut(), heard: 0 };
    let guid = CString::new(guid::<ahv::flight::Setup>()).unwrap();
    // SAFETY: valid arguments; a live instance, freed once. Without variable arguments a variadic
    // function is called like any other.
    unsafe {
        let environment = (&raw mut master).cast();
        let logger = std::mem::transmute::<
            unsafe extern "C" fn(*mut c_void, FmiString, Status, FmiString, FmiString),
            sys::CallbackLogger,
        >(ask);
        let functions = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment,
        };
        let master = environment.cast::<Curious>();
        let instantiate = (*master).api.instantiate;
        let kind = Type::CO_SIMULATION;
        (*master).c = instantiate(c"x".as_ptr(), kind, guid.as_ptr(), null(), &functions, 0, 0);
        let (step, c) = ((*master).api.do_step, (*master).c);
        assert_eq!(step(c, 0.0, 0.1, 0), Status::Error);
        assert_eq!((*master).heard, 3);
        ((*master).api.free_instance)(c);
    }
}
