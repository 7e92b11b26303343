//! What reaches the master's logger, and how.

use super::{Api, NAME, PERCENT, PREFIX, SETTER, Slave};
use crate::master::Api as _;
use fmi_model::log::CATEGORIES;
use fmi_model::status::Status;

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
    assert_eq!(slave.switch_logging(true, &["logEvents"]), Status::Ok);
    assert!(events(&slave));
    slave.leave_envelope();
    assert_eq!(slave.message().category, "logStatusDiscard");
    assert_eq!(slave.reset(), Status::Ok);
    assert!(!events(&slave), "a reset goes back to the logging of fmi2Instantiate");
    assert_eq!(slave.reset(), Status::Ok);

    assert_eq!(slave.switch_logging(true, &[]), Status::Ok);
    assert_eq!(slave.switch_logging(false, &["logEvents"]), Status::Ok);
    assert!(!events(&slave));
    slave.leave_envelope();
    assert_eq!(slave.message().category, "logStatusDiscard");
    assert_eq!(slave.switch_logging(false, &[]), Status::Ok);
    assert_eq!(slave.step(0.0, 0.1), Status::Error);
    assert_eq!(slave.message().category, "logStatusError");
}

#[test]
fn an_unknown_category_is_refused_switches_nothing_and_is_escaped_for_printf() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let quoted = format!("\"100{PERCENT}s ##r1##\"");
    slave.refuses(Status::Error, &[&quoted, "logEvents, logStatusDiscard"], |slave| {
        slave.switch_logging(true, &["logEvents", "100%s #r1#"])
    });
    slave.start();
    assert!(slave.log().is_empty());
}

#[test]
fn every_message_has_the_instance_name_a_declared_category_and_the_status_returned() {
    let api = Api::load();
    let slave = Slave::with_logging(&api, true);
    slave.start();
    slave.leave_envelope();
    assert_eq!(slave.set("V", 1.0), Status::Error);
    let log = slave.log();
    let statuses: Vec<_> = log.iter().map(|record| record.status).collect();
    assert!(statuses.contains(&Status::Ok));
    assert_eq!(statuses[statuses.len() - 2..], [Status::Discard, Status::Error]);
    for record in log {
        assert_eq!(record.name, NAME);
        let declared = |category: &fmi_model::log::Category| {
            category.name().to_str() == Ok(record.category.as_str())
        };
        assert!(CATEGORIES.iter().any(declared), "{record:?}");
        assert!(
            !record.message.ends_with('\n') && record.message.starts_with(PREFIX),
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
        let expected = format!("{SETTER}: delta_e asks for 5.18");
        assert!(text.starts_with(&expected) && text.contains("gets 0.349"), "{text}");
        assert!(text.ends_with("inputs are in rad, not in degrees"), "{text}");
        // Each control for itself.
        assert_eq!(slave.set("phi", 9.0), Status::Ok);
        let [text] = &said(&slave)[..] else { panic!("one message") };
        assert!(text.starts_with(&format!("{SETTER}: phi asks for 9.")), "{text}");
        assert_eq!(slave.step(0.0, 0.001), Status::Ok);
        assert!(said(&slave).is_empty(), "once");
        assert_eq!(slave.reset(), Status::Ok);
    }
    // An input set before initialisation is known at its end.
    assert_eq!(slave.set("phi", 2.0), Status::Ok);
    slave.start();
    let expected = format!("{PREFIX}ExitInitializationMode: phi asks for 2.");
    assert!(said(&slave)[0].starts_with(&expected));
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
                let start =
                    format!("{PREFIX}ExitInitializationMode: {name} = {value} has no effect: ");
                assert!(text.starts_with(&start), "{text}");
            }
        }
    }
}
