//! The calls of FMI 2.0.
#![allow(unsafe_code)]

use super::{Calls, DISCARD, Log, Step, functions, text};
use crate::fmu::Fmu;
use crate::model_description::{Kind, Variable};
use anyhow::{Context, Result, bail};
use fmi_model::location;
use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::ptr;

/// An instance.
pub struct Component {
    functions: Functions,
    pointer: *mut c_void,
    log: Box<Log>,
    _callbacks: Box<Callbacks>,
}

impl Component {
    pub fn new(library: &Library, fmu: &Fmu) -> Result<Self> {
        let functions = Functions::load(library)?;
        let log = Box::new(Log::default());
        let callbacks = Box::new(Callbacks {
            // SAFETY: the FMU calls this pointer as a C-variadic function, which stable Rust cannot
            // define. On the platforms of FMI 2.0 (System V and Windows x86-64, AArch64) the fixed
            // arguments of a variadic call travel as in any other call, and the caller clears the
            // stack, so a function that takes just these is called correctly and ignores the rest.
            logger: unsafe { std::mem::transmute::<FixedLogger, VariadicLogger>(logger) },
            allocate: calloc,
            free,
            step_finished: None,
            environment: ptr::from_ref::<Log>(&log).cast(),
        });
        let name = CString::new(fmu.model.model_name.as_str())?;
        let guid = CString::new(fmu.model.token.as_str())?;
        let resources = CString::new(location::uri(&fmu.resources()))?;
        // SAFETY: the strings are terminated and outlive the call; log and callbacks live in boxes
        // that the instance keeps until it is freed.
        let pointer = unsafe {
            (functions.instantiate)(
                name.as_ptr(),
                CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                &raw const *callbacks,
                FALSE,
                TRUE,
            )
        };
        if pointer.is_null() {
            bail!("fmi2Instantiate failed: {}", log.last());
        }
        Ok(Self { functions, pointer, log, _callbacks: callbacks })
    }
}

// SAFETY of all calls: the component is the one that fmi2Instantiate returned, and arrays have the length that
// is passed.
impl Calls for Component {
    fn set_up(&mut self, start: f64, stop: f64, tolerance: f64) -> Result<()> {
        let setup = self.functions.setup_experiment;
        let status = unsafe { setup(self.pointer, TRUE, tolerance, start, TRUE, stop) };
        self.log.check("fmi2SetupExperiment", status)?;
        let status = unsafe { (self.functions.enter_initialization_mode)(self.pointer) };
        self.log.check("fmi2EnterInitializationMode", status)
    }

    fn initialise(&mut self) -> Result<()> {
        let status = unsafe { (self.functions.exit_initialization_mode)(self.pointer) };
        self.log.check("fmi2ExitInitializationMode", status)
    }

    fn set(&mut self, variable: &Variable, value: f64) -> Result<()> {
        let (reference, c) = (&raw const variable.value_reference, self.pointer);
        let integer = value as c_int;
        let (call, status) = match variable.kind {
            Kind::Real(_) => ("fmi2SetReal", unsafe {
                (self.functions.set_real)(c, reference, 1, &raw const value)
            }),
            Kind::Integer | Kind::Enumeration(_) => ("fmi2SetInteger", unsafe {
                (self.functions.set_integer)(c, reference, 1, &raw const integer)
            }),
            Kind::Boolean => ("fmi2SetBoolean", unsafe {
                (self.functions.set_boolean)(c, reference, 1, &raw const integer)
            }),
            Kind::Other => bail!("{} has a type that cannot be set", variable.name),
        };
        self.log.check(call, status)
    }

    fn set_slopes(&mut self, inputs: &[&Variable], slopes: &[f64]) -> Result<()> {
        let references: Vec<_> = inputs.iter().map(|input| input.value_reference).collect();
        let orders = vec![1; slopes.len()];
        let (first, order, value) = (references.as_ptr(), orders.as_ptr(), slopes.as_ptr());
        let status = unsafe {
            let count = references.len().min(slopes.len());
            (self.functions.set_real_input_derivatives)(self.pointer, first, count, order, value)
        };
        self.log.check("fmi2SetRealInputDerivatives", status)
    }

    fn get(&mut self, references: &[u32]) -> Result<Vec<f64>> {
        let mut values = vec![0.0; references.len()];
        let (from, to) = (references.as_ptr(), values.as_mut_ptr());
        let status = unsafe { (self.functions.get_real)(self.pointer, from, references.len(), to) };
        self.log.check("fmi2GetReal", status)?;
        Ok(values)
    }

    fn step(&mut self, time: f64, length: f64) -> Result<Step> {
        let status = unsafe { (self.functions.do_step)(self.pointer, time, length, TRUE) };
        if status != DISCARD {
            self.log.check("fmi2DoStep", status)?;
            return Ok(Step::Done);
        }
        let (mut reached, reason) = (time, self.log.last());
        let status = unsafe {
            (self.functions.get_real_status)(self.pointer, LAST_SUCCESSFUL_TIME, &raw mut reached)
        };
        self.log.check("fmi2GetRealStatus", status)?;
        Ok(Step::Discarded(reached, reason))
    }

    fn terminate(&mut self) -> Result<()> {
        let status = unsafe { (self.functions.terminate)(self.pointer) };
        self.log.check("fmi2Terminate", status)
    }

    fn log(&self) -> &Log {
        &self.log
    }
}

impl Drop for Component {
    fn drop(&mut self) {
        // SAFETY: the component is ours and is not used after this.
        unsafe { (self.functions.free_instance)(self.pointer) }
    }
}

// Types and constants of fmi2FunctionTypes.h (FMI 2.0.5).
type FixedLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
type VariadicLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);
const FALSE: c_int = 0;
const TRUE: c_int = 1;
const CO_SIMULATION: c_int = 1;
const LAST_SUCCESSFUL_TIME: c_int = 2;

/// fmi2CallbackFunctions.
#[repr(C)]
struct Callbacks {
    logger: VariadicLogger,
    allocate: unsafe extern "C" fn(usize, usize) -> *mut c_void,
    free: unsafe extern "C" fn(*mut c_void),
    step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    environment: *const c_void,
}

// SAFETY: the C library has both with these signatures; `c_void` stands for any object.
unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(object: *mut c_void);
}

/// fmi2CallbackLogger without its variadic arguments: `%%` becomes a percent sign, other directives are kept
/// as text.
unsafe extern "C" fn logger(
    environment: *mut c_void,
    _instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the log that was passed with the callbacks; it outlives them.
    let Some(log) = (unsafe { environment.cast::<Log>().as_ref() }) else { return };
    // SAFETY: both are NULL or terminated strings by the standard.
    let (category, message) = unsafe { (text(category), text(message)) };
    log.add(status, category, &message.replace("%%", "%"));
}

functions! {
    instantiate: "fmi2Instantiate" fn(*const c_char, c_int, *const c_char, *const c_char, *const Callbacks, c_int, c_int) -> *mut c_void;
    setup_experiment: "fmi2SetupExperiment" fn(*mut c_void, c_int, f64, f64, c_int, f64) -> c_int;
    enter_initialization_mode: "fmi2EnterInitializationMode" fn(*mut c_void) -> c_int;
    exit_initialization_mode: "fmi2ExitInitializationMode" fn(*mut c_void) -> c_int;
    set_real: "fmi2SetReal" fn(*mut c_void, *const c_uint, usize, *const f64) -> c_int;
    set_integer: "fmi2SetInteger" fn(*mut c_void, *const c_uint, usize, *const c_int) -> c_int;
    set_boolean: "fmi2SetBoolean" fn(*mut c_void, *const c_uint, usize, *const c_int) -> c_int;
    get_real: "fmi2GetReal" fn(*mut c_void, *const c_uint, usize, *mut f64) -> c_int;
    set_real_input_derivatives: "fmi2SetRealInputDerivatives" fn(*mut c_void, *const c_uint, usize, *const c_int, *const f64) -> c_int;
    do_step: "fmi2DoStep" fn(*mut c_void, f64, f64, c_int) -> c_int;
    get_real_status: "fmi2GetRealStatus" fn(*mut c_void, c_int, *mut f64) -> c_int;
    terminate: "fmi2Terminate" fn(*mut c_void) -> c_int;
    free_instance: "fmi2FreeInstance" fn(*mut c_void);
}
