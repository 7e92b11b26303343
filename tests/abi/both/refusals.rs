//! What is refused says so: once, with the status returned, and with variable, value, limit and remedy.

use super::{Api, Slave};
use crate::master::Api as _;
use fmi_model::status::Status;

/// The next message, which has to be the only one.
fn said(slave: &Slave, status: Status, words: &[&str]) {
    let record = slave.message();
    assert_eq!(record.status, status, "{record:?}");
    for word in words {
        assert!(record.message.contains(word), "{word}: {}", record.message);
    }
}

/// Settings, and words of the reason for which there is no start from them.
type Start = (Settings, Words);
type Settings = &'static [(&'static str, f64)];
type Words = &'static [&'static str];

const STARTS: [Start; 17] = [
    (&[("mach0", 2.0)], &["mach0 = 2 is beyond [6, 11]", "choose another flight condition"]),
    (&[("altitude0", 60e3)], &["altitude0 = 60000 m is beyond [18000, 42000]"]),
    (&[("gamma0", 1.5)], &["no trim at", "gamma0 = 1.5 rad", "phi = ", "[0.0000, 1.5000]"]),
    (&[("mass_factor", 2.0)], &["no trim at", "delta_e = ", "factors nearer to 1"]),
    (&[("inertia_factor", 0.1)], &["pitch inertia of", "need more than", "raise inertia_factor"]),
    (&[("imu_station", 40.0)], &["imu_station = 40 is refused", "from 0 to 30.48 m"]),
    (&[("slosh_frequency", 0.05)], &["slosh_frequency = 0.05 is refused", "0.1 and more"]),
    (&[("slosh_frequency", 0.1)], &["slosh_frequency = 0.1 is refused: it makes slosh2", "in ["]),
    (&[("alpha_offset", 0.2)], &["alpha_offset = 0.2 is refused: it makes alpha", "in ["]),
    (&[("slosh1_offset", 2.0)], &["slosh1_offset = 2 is refused: it makes slosh1", "in ["]),
    (&[("trim", 0.0), ("alpha0", 0.3)], &["alpha0 = 0.3 is refused: it makes alpha", "in ["]),
    (&[("trim", 0.0), ("mach0", 5.0)], &["mach0 = 5 is refused: it makes mach 5", "in [6.0"]),
    (&[("trim", 0.0), ("altitude0", 9e3)], &["altitude0 = 9000 is refused: it makes h 9000"]),
    (&[("trim", 0.0), ("eta10", 5.0)], &["eta10 = 5 is refused: it makes slosh", "in ["]),
    (
        &[("trim", 0.0), ("fuel_fraction", 0.0), ("eta10", 0.1)],
        &["eta10 = 0.1 is refused: it makes slosh", "in ["],
    ),
    // The fuel that the trim takes chokes the burner, not the Mach number.
    (
        &[("aero", 3.0), ("thrust_factor", 0.1)],
        &["phi_trim = 0.8", "it makes choking_margin -0.", "from 0.000000 up", "thrust_factor"],
    ),
    (&[("aero", 3.0), ("mach0", 6.0)], &["phi_trim = 0.27", "choking_margin -0.", "another mach0"]),
];

#[test]
fn a_start_that_is_refused_blames_what_leads_there() {
    let api = Api::load();
    for (settings, words) in STARTS {
        let slave = Slave::new(&api);
        settings.iter().for_each(|(name, value)| choose(&slave, name, *value));
        assert_eq!(slave.begin(), Status::Ok);
        assert_eq!(slave.exit(), Status::Error);
        said(&slave, Status::Error, words);
    }
}

fn choose(slave: &Slave, name: &str, value: f64) {
    let status = match name {
        "aero" | "configuration" => slave.set_enumeration(name, value as i32),
        "trim" | "fuel_burn" => slave.set_boolean(name, value != 0.0),
        _ => slave.set(name, value),
    };
    assert_eq!(status, Status::Ok, "{name}");
}

#[test]
fn a_flight_that_ends_early_blames_what_ends_it() {
    let api = Api::load();
    let ends: [(Settings, f64, Words); 7] = [
        (&[], 0.2, &["alpha = ", "edge of its valid range [", "curve fits mean nothing"]),
        (&[("mach0", 6.0), ("configuration", 1.0)], 0.0, &["mach = 6.0", "[6.000000, 11.000000]"]),
        (&[("fuel_fraction", 0.0)], 0.02, &["slosh", "the liquid would leave its depth"]),
        (
            &[("fuel_burn", 1.0), ("fuel_fraction", 0.0)],
            0.0,
            &["fuel_mass", "larger fuel_fraction"],
        ),
        (&[("fuel_burn", 1.0), ("fuel_fraction", 1e-12)], 0.0, &["fuel_mass reached 0"]),
        (&[("fuel_burn", 1.0), ("fuel_fraction", 1e-9)], 0.0, &["fuel_mass reached 0"]),
        (&[("fuel_burn", 1.0), ("fuel_fraction", 1e-5)], 0.0, &["fuel_mass reached 0"]),
    ];
    for (settings, elevator, words) in ends {
        let slave = Slave::new(&api);
        settings.iter().for_each(|(name, value)| choose(&slave, name, *value));
        assert_eq!((slave.begin(), slave.exit()), (Status::Ok, Status::Ok));
        assert_eq!(slave.set("delta_e", elevator), Status::Ok);
        assert!(slave.stepped(0.0, 100.0).ended);
        said(&slave, Status::Discard, words);
    }
}
