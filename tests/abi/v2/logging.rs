//! The logger of FMI 2.0.

use crate::common::fmi2::{Api, Slave};
use crate::master::v2::{callbacks, recorder};
use crate::master::{Api as _, Sink};
use fmi_model::identity::guid;
use fmi_model::v2::sys::{self, CallbackFunctions, FmiString, Status, Type};
use std::ffi::{CString, c_void};
use std::ptr::null;

#[test]
fn an_input_that_a_ramp_leads_beyond_its_limit_is_said() {
    let api = Api::load();
    let slave = Slave::with_logging(&api, true);
    slave.start();
    slave.log();
    assert_eq!(slave.set_input_derivative("phi", 1, -100.0), Status::Ok);
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
    assert!(slave.message().message.starts_with("fmi2DoStep: phi asks for -0."));
}

#[test]
fn the_callbacks_are_copied_and_a_null_logger_is_fine() {
    let api = Api::load();
    let (sink, guid) = (Sink::default(), CString::new(guid::<ahv::flight::Setup>()).unwrap());
    for logger in [None, Some(recorder())] {
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
