//! Instances of FMI 3.0: made, refused with a reason, freed.

use crate::common::fmi3::{Api, Slave};
use crate::common::reference;
use crate::master::v3::{Environment, record};
use crate::master::{Api as _, Record};
use ahv::flight::Setup;
use fmi_model::identity::guid;
use fmi_model::v3::sys::{Boolean, FmiString, Instance, LogMessageCallback, Status};
use std::cell::Cell;
use std::ffi::{CStr, CString, c_void};
use std::ptr::{from_ref, null, null_mut};

const NO: Boolean = Boolean::FALSE;

/// What a master passes for co-simulation.
struct Request {
    name: FmiString,
    token: FmiString,
    resources: FmiString,
    event_mode_used: Boolean,
    variables: (*const u32, usize),
}

fn instantiate(
    api: &Api,
    request: &Request,
    log: Option<LogMessageCallback>,
    environment: *mut c_void,
) -> Instance {
    let Request { name, token, resources, event_mode_used: event, variables } = *request;
    let function = api.instantiate_co_simulation;
    // SAFETY: the arguments are NULL or valid.
    unsafe {
        let (variables, count) = variables;
        function(
            name,
            token,
            resources,
            NO,
            NO,
            event,
            NO,
            variables,
            count,
            environment,
            log,
            None,
        )
    }
}

fn logged(environment: &Environment) -> Vec<Record> {
    std::mem::take(&mut *environment.sink.lock().unwrap())
}

#[test]
fn the_version_is_that_of_the_standard() {
    let api = Api::load();
    // SAFETY: a static C string, of a library that is still loaded.
    assert_eq!(unsafe { CStr::from_ptr((api.get_version)()) }, c"3.0");
}

#[test]
fn an_instance_that_is_refused_says_why_once_and_any_resource_path_is_fine() {
    let api = Api::load();
    let environment = Environment::default();
    let at = from_ref(&environment).cast_mut().cast();
    let own = CString::new(guid::<Setup>()).unwrap();
    let plain = || Request {
        name: c"one".as_ptr(),
        token: own.as_ptr(),
        resources: null(),
        event_mode_used: NO,
        variables: (null(), 0),
    };
    let (parameter, unknown) = ([reference("V"), reference("mach0")], [9999]);
    let cases = [
        (Request { name: null(), ..plain() }, "instanceName is NULL"),
        (Request { name: c"".as_ptr(), ..plain() }, "instance name must not be empty"),
        (Request { name: c" \t".as_ptr(), ..plain() }, "instance name must not be empty"),
        (Request { token: null(), ..plain() }, "instantiationToken is NULL"),
        (Request { token: c"{100%-#1}".as_ptr(), ..plain() }, "instantiationToken is {100%-##1}"),
        (Request { event_mode_used: Boolean::TRUE, ..plain() }, "hasEventMode = false"),
        (Request { variables: (null(), 1), ..plain() }, "requiredIntermediateVariables is NULL"),
        (Request { variables: (parameter.as_ptr(), usize::MAX), ..plain() }, "is NULL or does not"),
        (Request { variables: (parameter.as_ptr(), 2), ..plain() }, "has no intermediateUpdate"),
        (Request { variables: (unknown.as_ptr(), 1), ..plain() }, "9999, which has no"),
    ];
    for (request, reason) in cases {
        assert!(instantiate(&api, &request, Some(record), at).is_null(), "{reason}");
        let [record] = &logged(&environment)[..] else { panic!("{reason}: one message") };
        assert_eq!((record.status, record.category.as_str()), (Status::Error, "logStatusError"));
        let text = &record.message;
        assert!(text.starts_with("fmi3InstantiateCoSimulation: "), "{text}");
        assert!(text.contains(reason), "{text}");
        assert!(instantiate(&api, &request, None, null_mut()).is_null(), "without a logger");
    }
    for resources in [null(), c"".as_ptr(), c"/a b/%zz/".as_ptr(), c"\xff".as_ptr()] {
        let c = instantiate(&api, &Request { resources, ..plain() }, Some(record), at);
        assert!(!c.is_null());
        // SAFETY: a live instance, freed once.
        unsafe { (api.free_instance)(c) };
    }
    let outputs = [reference("V"), reference("lift"), reference("delta_e")];
    let c = instantiate(&api, &Request { variables: (outputs.as_ptr(), 3), ..plain() }, None, at);
    assert!(!c.is_null(), "inputs and outputs may be looked at within a step");
    // SAFETY: a live instance, freed once; freeing NULL is ignored.
    unsafe {
        (api.free_instance)(c);
        (api.free_instance)(null_mut());
    }
    assert!(logged(&environment).is_empty());
}

#[test]
fn scheduled_execution_and_a_wrong_token_for_model_exchange_are_refused() {
    let api = Api::load();
    let environment = Environment::default();
    let (at, log) = (from_ref(&environment).cast_mut().cast(), Some(record as LogMessageCallback));
    let (name, own) = (c"one".as_ptr(), CString::new(guid::<Setup>()).unwrap());
    let (exchange, scheduled) =
        (api.instantiate_model_exchange, api.instantiate_scheduled_execution);
    // SAFETY: valid arguments.
    unsafe {
        let token = own.as_ptr();
        assert!(scheduled(name, token, null(), NO, NO, at, log, None, None, None).is_null());
        let [record] = &logged(&environment)[..] else { panic!("one message") };
        assert!(record.message.contains("no ScheduledExecution"), "{record:?}");
        assert!(exchange(name, c"{}".as_ptr(), null(), NO, NO, at, log).is_null());
        let [record] = &logged(&environment)[..] else { panic!("one message") };
        assert!(record.message.contains("instantiationToken is {}"), "{record:?}");
        assert!(exchange(name, c"{}".as_ptr(), null(), NO, NO, null_mut(), None).is_null());
    }
}

/// A master whose logger asks the FMU for something.
struct Curious {
    api: Api,
    c: Cell<Instance>,
    heard: Cell<u32>,
}

unsafe extern "C" fn ask(environment: *mut c_void, _: Status, _: FmiString, _: FmiString) {
    // SAFETY: the environment is the struct above, used by this thread only.
    let master = unsafe { &*environment.cast::<Curious>() };
    master.heard.set(master.heard.get() + 1);
    if master.heard.get() < 3 {
        // SAFETY: a live instance, and room for the value.
        let status = unsafe { (master.api.get_float64)(master.c.get(), &0, 1, &mut 0.0, 2) };
        assert_eq!(status, Status::Error, "more values than variables");
    }
}

#[test]
fn a_logger_may_call_the_instance_that_is_logging() {
    let master = Curious { api: Api::load(), c: Cell::new(null_mut()), heard: Cell::new(0) };
    let token = CString::new(guid::<Setup>()).unwrap();
    let request = Request {
        name: c"x".as_ptr(),
        token: token.as_ptr(),
        resources: null(),
        event_mode_used: NO,
        variables: (null(), 0),
    };
    let at = from_ref(&master).cast_mut().cast();
    master.c.set(instantiate(&master.api, &request, Some(ask), at));
    // SAFETY: a live instance, freed once.
    unsafe {
        assert_eq!((master.api.terminate)(master.c.get()), Status::Error);
        assert_eq!(master.heard.get(), 3);
        (master.api.free_instance)(master.c.get());
    }
}

#[test]
fn null_instances_are_refused() {
    let (api, none) = (Api::load(), null_mut());
    let [mut a, mut b, mut c] = [NO; 3];
    // SAFETY: NULL is what is tested.
    unsafe {
        assert_eq!((api.reset)(none), Status::Error);
        assert_eq!((api.get_float64)(none, &0, 1, &mut 0.0, 1), Status::Error);
        assert_eq!((api.free_state)(none, null_mut()), Status::Error);
        let step = api.do_step;
        let status = step(none, 0.0, 0.1, NO, &mut a, &mut b, &mut c, &mut 0.0);
        assert_eq!(status, Status::Error);
    }
}

#[test]
fn an_error_leaves_values_to_read_and_a_reset_or_a_saved_state_to_go_on_from() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let (saved, before) = (slave.save(), slave.bits());
    for restores in [true, false] {
        assert_eq!(slave.set("V", 1.0), Status::Error);
        assert_eq!(slave.bits(), before);
        assert_eq!(slave.step(0.0, 0.1), Status::Error);
        assert_eq!(slave.set("delta_e", 0.0), Status::Error);
        assert_eq!(slave.terminate(), Status::Error);
        slave.log();
        assert_eq!(if restores { slave.load(saved) } else { slave.reset() }, Status::Ok);
        if !restores {
            slave.start();
        }
        assert_eq!(slave.bits(), before);
        assert_eq!(slave.step(0.0, 0.1), Status::Ok);
        assert_eq!(slave.load(saved), Status::Ok);
    }
    slave.free(saved);
    let new = Slave::new(&api);
    assert_eq!(new.set("V", 1.0), Status::Error);
    new.log();
    let (status, values) = new.reals(&[reference("V")]);
    assert!(status == Status::Error && values[0].is_nan());
    assert!(new.message().message.contains("there is no value"));
    assert_eq!(new.get("mach0"), 8.0);
}
