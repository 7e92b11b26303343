//! Refused arguments of FMI 2.0.

use crate::common::fmi2::{Api, Slave};
use crate::common::reference;
use crate::master::Api as _;
use fmi_model::v2::sys::{Status, StatusKind};
use std::ptr::{null, null_mut};

const ERROR: Status = Status::Error;
const DISCARD: Status = Status::Discard;

/// The next message, which has to be the only one.
fn refused(slave: &Slave, status: Status, expected: Status, words: &[&str]) {
    let record = slave.message();
    assert_eq!((status, record.status), (expected, expected), "{record:?}");
    for word in words {
        assert!(record.message.contains(word), "{word}: {}", record.message);
    }
}

#[test]
fn refused_arguments_are_named_for_what_they_are() {
    let api = Api::load();
    let (slave, c) = (Slave::flying(&api), StatusKind::LAST_SUCCESSFUL_TIME);
    let says = |status, expected, words: &[&str]| refused(&slave, status, expected, words);
    says(slave.set("V", 1.0), ERROR, &["V = 1 is refused", "only inputs and parameters"]);
    says(slave.set("mach0", 7.0), ERROR, &["mach0 = 7 is refused", "before the end of"]);
    says(slave.set("w_gust", 300.0), ERROR, &["w_gust = 300", "the range is [-200, 200]"]);
    says(slave.set("phi", f64::NAN), ERROR, &["phi = NaN", "a finite number"]);
    says(slave.set_enumeration("V", 1), ERROR, &["V (value reference 2)", "its type is Real"]);
    says(
        slave.set_input_derivative("V", 1, 1.0),
        ERROR,
        &["V cannot be given a derivative: only inputs can"],
    );
    says(
        slave.set_input_derivative("phi", 4, 1.0),
        ERROR,
        &["derivative 4 of phi", "orders are 1 to 3"],
    );
    says(slave.set_input_derivative("phi", 1, 1e31), ERROR, &["change of phi = 1", "up to 1e30"]);
    says(slave.step(1.0, 0.1), ERROR, &["currentCommunicationPoint = 1 s", "time 0 s", "begins"]);
    says(slave.step(0.0, -0.1), ERROR, &["communicationStepSize = -0.1", "a positive number"]);
    says(slave.setup(), ERROR, &["not allowed in state step complete", "allowed in: instantiated"]);
    let (vr, one) = (reference("mach0"), reference("V"));
    // SAFETY: arrays of one element, NULL, places for one value.
    unsafe {
        let get = |known| (api.directional_derivative)(slave.c, &one, 1, known, 1, &1.0, &mut 0.0);
        says(get(&vr), ERROR, &["mach0 cannot be a known: only states and inputs can"]);
        says((api.get_real)(slave.c, &999, 1, &mut 0.0), ERROR, &["999 is unknown", "113"]);
        says((api.get_real)(slave.c, null(), 1, &mut 0.0), ERROR, &["vr is NULL", "an array"]);
        says((api.set_state)(slave.c, null_mut()), ERROR, &["FMUstate is NULL", "an FMU state"]);
        says(
            (api.get_state)(slave.c, null_mut()),
            ERROR,
            &["FMUstate", "a place for an FMU state"],
        );
        let saved = slave.save();
        let size = (api.state_size)(slave.c, saved, null_mut());
        slave.free(saved);
        says(size, ERROR, &["size is NULL", "a place for the result"]);
        let categories = (api.set_debug_logging)(slave.c, 1, 1, &null());
        says(categories, ERROR, &["categories is NULL", "a C string"]);
        says(
            (api.deserialize)(slave.c, c"no".as_ptr(), 2, &mut null_mut()),
            ERROR,
            &["these 2 bytes are no FMU state", "nothing was changed"],
        );
        let status = (api.get_boolean_status)(slave.c, c, &mut 0);
        says(status, DISCARD, &["kind 2", "call fmi2GetRealStatus"]);
        let status = (api.get_real_status)(slave.c, StatusKind(3), &mut 0.0);
        says(status, DISCARD, &["kind 3", "call fmi2GetBooleanStatus"]);
        let status = (api.get_integer_status)(slave.c, StatusKind(1), &mut 0);
        says(status, DISCARD, &["kind 1", "no step is ever pending"]);
        let status = (api.get_real_status)(slave.c, StatusKind(9), &mut 0.0);
        says(status, DISCARD, &["kind 9", "there are 0 to 3"]);
        says((api.cancel_step)(slave.c), ERROR, &["not allowed in state step complete"]);
    }
}

#[test]
fn a_step_past_the_stop_time_and_a_missing_experiment_are_named() {
    let api = Api::load();
    let slave = Slave::new(&api);
    refused(&slave, slave.enter(), ERROR, &["call fmi2SetupExperiment first"]);
    let stop = slave.setup_with(None, 1.0, Some(0.5));
    refused(&slave, stop, ERROR, &["stopTime = 0.5", "not lie before the start time"]);
    let tolerance = slave.setup_with(Some(-1.0), 0.0, None);
    refused(&slave, tolerance, ERROR, &["tolerance = -1", "a positive number"]);
    assert_eq!(slave.setup_with(None, 0.0, Some(0.1)), Status::Ok);
    assert_eq!((slave.enter(), slave.exit()), (Status::Ok, Status::Ok));
    refused(&slave, slave.step(0.0, 0.2), ERROR, &["ends at 0.2 s", "stop time 0.1 s"]);
}
