//! Functions that co-simulation and model exchange have in common (section 2.1).

use super::entry::enter;
use crate::abi::{self, input, string};
use crate::instance::{Instance, Interface};
use crate::instantiate::Request;
use crate::location;
use crate::model::Model;
use crate::v2::calls;
use crate::v2::sys::{self, FmiString, Real, Status};
use core::ffi::c_char;
use core::ptr;

pub unsafe fn fmi2GetTypesPlatform<M: Model>() -> *const c_char {
    c"default".as_ptr()
}

pub unsafe fn fmi2GetVersion<M: Model>() -> *const c_char {
    c"2.0".as_ptr()
}

/// Refuses what does not fit, else makes an instance.
fn instantiate<M: Model>(
    name: Result<String, String>,
    kind: sys::Type,
    given: Result<String, String>,
    location: Option<&str>,
    logging_on: bool,
) -> Result<Instance<M>, String> {
    let [name, token] = [name?, given?];
    let interface = match kind {
        sys::Type::MODEL_EXCHANGE => Interface::ModelExchange,
        sys::Type::CO_SIMULATION => Interface::CoSimulation,
        sys::Type(other) => return Err(format!("fmuType = {other} does not exist")),
    };
    let request = Request {
        name: &name,
        interface,
        token_argument: "fmuGUID",
        token: &token,
        resources: location.and_then(location::folder),
        logging_on,
    };
    Instance::instantiate(request).map_err(|problem| problem.to_string())
}

pub unsafe fn fmi2Instantiate<M: Model>(
    instanceName: FmiString,
    fmuType: sys::Type,
    fmuGUID: FmiString,
    fmuResourceLocation: FmiString,
    functions: *const sys::CallbackFunctions,
    _visible: sys::Boolean,
    loggingOn: sys::Boolean,
) -> sys::Component {
    if functions.is_null() {
        return ptr::null_mut();
    }
    // SAFETY: not NULL, and the master's struct is valid during this call.
    let callbacks = unsafe { functions.read() };
    let make = || {
        // SAFETY: the master passes NULL or C strings.
        let texts = unsafe { [string("instanceName", instanceName), string("fmuGUID", fmuGUID)] };
        let [name, given] = texts.map(|text| text.map_err(|failure| failure.to_string()));
        // SAFETY: as above; NULL names no folder.
        let location = unsafe { string("fmuResourceLocation", fmuResourceLocation) }.ok();
        instantiate::<M>(name, fmuType, given, location.as_deref(), loggingOn != sys::FALSE)
    };
    // SAFETY: the master passes NULL or a C string, and callbacks of the standard.
    unsafe { abi::create("fmi2Instantiate", instanceName, callbacks, make) }
}

pub unsafe fn fmi2FreeInstance<M: Model>(c: sys::Component) {
    // SAFETY: the master passes what fmi2Instantiate made, once.
    unsafe { abi::free::<M, sys::CallbackFunctions>(c) }
}

pub unsafe fn fmi2SetDebugLogging<M: Model>(
    c: sys::Component,
    loggingOn: sys::Boolean,
    nCategories: usize,
    categories: *const FmiString,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes nCategories C strings.
        let names: Result<Vec<_>, _> = unsafe { input("categories", categories, nCategories) }?
            .iter()
            .map(|&name| unsafe { string("categories", name) })
            .collect();
        instance.set_debug_logging(loggingOn != sys::FALSE, &names?)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_DEBUG_LOGGING, body) }
}

pub unsafe fn fmi2SetupExperiment<M: Model>(
    c: sys::Component,
    toleranceDefined: sys::Boolean,
    tolerance: Real,
    startTime: Real,
    stopTimeDefined: sys::Boolean,
    stopTime: Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        let tolerance = (toleranceDefined != sys::FALSE).then_some(tolerance);
        let stop = (stopTimeDefined != sys::FALSE).then_some(stopTime);
        instance.setup_experiment(tolerance, startTime, stop)
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SETUP_EXPERIMENT, body) }
}

pub unsafe fn fmi2EnterInitializationMode<M: Model>(c: sys::Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::ENTER_INITIALIZATION_MODE, Instance::<M>::enter_initialization_mode) }
}

pub unsafe fn fmi2ExitInitializationMode<M: Model>(c: sys::Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::EXIT_INITIALIZATION_MODE, Instance::<M>::exit_initialization_mode) }
}

pub unsafe fn fmi2Terminate<M: Model>(c: sys::Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::TERMINATE, Instance::<M>::terminate) }
}

pub unsafe fn fmi2Reset<M: Model>(c: sys::Component) -> Status {
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::RESET, Instance::<M>::reset) }
}
