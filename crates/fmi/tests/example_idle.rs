//! The library of a model without any capability that FMI leaves to it.

#![allow(unsafe_code)]

mod master;

use fmi_model::identity::guid;
use fmi_model::v2::sys::{Status, Type};
use idle::Idle;
use master::v2::callbacks;
use master::{Api as _, Record, Sink, fuzz, reference};
use std::ffi::CString;
use std::ptr::{null, null_mut};

type Api = master::v2::Api<Idle>;
type Slave<'a> = master::Slave<'a, Api>;

fn assert_refused(record: &Record, function: &str, capability: &str) {
    assert_eq!((record.status, record.category.as_str()), (Status::Error, "logStatusError"));
    let message = &record.message;
    assert!(message.starts_with(&format!("{function}: ")), "{message}");
    assert!(message.contains(capability), "{message}");
}

#[test]
fn an_interface_that_a_model_does_not_have_is_not_instantiated() {
    let (api, sink) = (Api::load(), Sink::default());
    let (guid, functions) = (CString::new(guid::<Idle>()).unwrap(), callbacks(&sink));
    let (name, kind) = (c"one".as_ptr(), Type::MODEL_EXCHANGE);
    // SAFETY: the arguments are valid, and NULL is a resource location that is not given.
    let c = unsafe { (api.instantiate)(name, kind, guid.as_ptr(), null(), &functions, 0, 0) };
    assert!(c.is_null());
    let log = sink.lock().unwrap();
    assert_eq!(log.len(), 1, "{log:?}");
    assert_refused(&log[0], "fmi2Instantiate", "Model Exchange");
}

#[test]
fn capabilities_that_a_model_does_not_have_are_refused_by_name() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!((slave.setup(), slave.enter(), slave.exit()), (Status::Ok, Status::Ok, Status::Ok));
    let (c, input, output) = (slave.c, reference::<Idle>("u1"), reference::<Idle>("y1"));
    let refused = |status: Status, function: &str, capability: &str| {
        assert_eq!(status, Status::Error, "{function}");
        assert_refused(&slave.message(), function, capability);
    };
    let (mut state, mut change, one) = (null_mut(), 7.0, 1.0);
    // SAFETY: a live instance, and places for one value each.
    unsafe {
        refused((api.get_state)(c, &mut state), "fmi2GetFMUstate", "that its state can be saved");
        let bytes = [0; 64];
        let status = (api.deserialize)(c, bytes.as_ptr(), bytes.len(), &mut state);
        refused(status, "fmi2DeSerializeFMUstate", "that its state can be saved");
        let status = (api.directional_derivative)(c, &output, 1, &input, 1, &one, &mut change);
        let without = "directional derivatives";
        refused(status, "fmi2GetDirectionalDerivative", without);
        let status = (api.set_input_derivatives)(c, &input, 1, &1, &one);
        refused(status, "fmi2SetRealInputDerivatives", "inputs that move within a step");
        let status = (api.get_output_derivatives)(c, &output, 1, &1, &mut change);
        refused(status, "fmi2GetRealOutputDerivatives", without);
    }
    assert!(state.is_null() && change == 7.0, "nothing is written");
    assert_eq!(slave.step(0.0, 0.5), Status::Ok, "{:?}", slave.log());
}

#[test]
fn random_calls_never_crash_a_model_without_capabilities() {
    // Neither model exchange nor an error is in reach.
    fuzz::play::<Api>(4);
    fuzz::play::<master::v3::Api<Idle>>(5);
}
