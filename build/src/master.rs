//! A co-simulation master: calls the C functions of an FMU.
//!
//! Only this file of the tool has unsafe code; its public functions are safe.
#![allow(unsafe_code)]

use crate::fmu::Fmu;
use crate::model_description::{Kind, Variable};
use ahv::short::short;
use anyhow::{Context, Result, anyhow, bail};
use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::ptr;
use std::sync::{Mutex, PoisonError};

/// A message of the FMU.
#[derive(Debug, Clone)]
pub struct Message {
    pub status: c_int,
    pub category: String,
    pub text: String,
}

/// Messages of the FMU so far. A mutex, because an FMU may log from any thread.
#[derive(Default)]
struct Log(Mutex<Vec<Message>>);

impl Log {
    fn all(&self) -> Vec<Message> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn last(&self) -> String {
        self.all().pop().map_or_else(|| "the FMU gave no reason".into(), |message| message.text)
    }
}

/// How a step ended.
#[derive(Debug)]
pub enum Step {
    Done,
    /// The FMU ended the step early: time reached (s) and reason.
    Discarded(f64, String),
}

/// A running FMU.
pub struct Instance {
    functions: Functions,
    component: Component,
    log: Box<Log>,
    _callbacks: Box<Callbacks>,
    /// The last field, so that it is dropped last.
    _library: Library,
}

impl Instance {
    /// Loads the binary and makes an instance.
    pub fn new(fmu: &Fmu) -> Result<Self> {
        // SAFETY: loading runs the initialisers of a library that the user asked to load.
        let library = unsafe { Library::new(&fmu.binary) }
            .context("the binary of the FMU cannot be loaded")?;
        let functions = Functions::load(&library)?;

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
        let guid = CString::new(fmu.model.guid.as_str())?;
        let resources = CString::new(fmu.resources())?;
        // SAFETY: the strings are terminated and outlive the call; log and callbacks live in boxes
        // that the instance keeps until it is freed.
        let component = unsafe {
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
        if component.is_null() {
            bail!("fmi2Instantiate failed: {}", log.last());
        }
        Ok(Self { functions, component, log, _callbacks: callbacks, _library: library })
    }

    /// Sets up the experiment and enters initialisation mode.
    pub fn set_up(&mut self, start: f64, stop: f64, tolerance: f64) -> Result<()> {
        // SAFETY: the component is the one that fmi2Instantiate returned.
        let status = unsafe {
            (self.functions.setup_experiment)(self.component, TRUE, tolerance, start, TRUE, stop)
        };
        self.check("fmi2SetupExperiment", status)?;
        // SAFETY: as above.
        let status = unsafe { (self.functions.enter_initialization_mode)(self.component) };
        self.check("fmi2EnterInitializationMode", status)
    }

    /// Leaves initialisation mode.
    pub fn initialise(&mut self) -> Result<()> {
        // SAFETY: the component is the one that fmi2Instantiate returned.
        let status = unsafe { (self.functions.exit_initialization_mode)(self.component) };
        self.check("fmi2ExitInitializationMode", status)
    }

    /// Sets one variable; Booleans as 0 and 1, enumerations as their number.
    pub fn set(&mut self, variable: &Variable, value: f64) -> Result<()> {
        let (reference, c) = (&raw const variable.value_reference, self.component);
        let integer = value as c_int;
        // SAFETY: one reference and one value, both alive during the call; the component is ours.
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
            Kind::String => bail!("{} is text and cannot be set", variable.name),
        };
        self.check(call, status).with_context(|| format!("{} = {}", variable.name, short(value)))
    }

    /// Sets the first derivatives of inputs for the next step.
    pub fn set_slopes(&mut self, inputs: &[&Variable], slopes: &[f64]) -> Result<()> {
        let references: Vec<_> = inputs.iter().map(|input| input.value_reference).collect();
        let orders = vec![1; slopes.len()];
        let (first, order, value) = (references.as_ptr(), orders.as_ptr(), slopes.as_ptr());
        // SAFETY: the arrays are alive during the call; the count is that of the shortest.
        let status = unsafe {
            let count = references.len().min(slopes.len());
            (self.functions.set_real_input_derivatives)(self.component, first, count, order, value)
        };
        self.check("fmi2SetRealInputDerivatives", status)
    }

    /// Values of real variables.
    pub fn get(&mut self, references: &[c_uint]) -> Result<Vec<f64>> {
        let mut values = vec![0.0; references.len()];
        let (from, to) = (references.as_ptr(), values.as_mut_ptr());
        // SAFETY: both arrays have the length that is passed.
        let status =
            unsafe { (self.functions.get_real)(self.component, from, references.len(), to) };
        self.check("fmi2GetReal", status)?;
        Ok(values)
    }

    /// Steps from `time` over `length`, both in s.
    pub fn step(&mut self, time: f64, length: f64) -> Result<Step> {
        // SAFETY: the component is the one that fmi2Instantiate returned.
        let status = unsafe { (self.functions.do_step)(self.component, time, length, TRUE) };
        if status != DISCARD {
            self.check("fmi2DoStep", status)?;
            return Ok(Step::Done);
        }
        let mut reached = time;
        // SAFETY: one value, alive during the call.
        let status = unsafe {
            (self.functions.get_real_status)(self.component, LAST_SUCCESSFUL_TIME, &raw mut reached)
        };
        let reason = self.log.last();
        self.check("fmi2GetRealStatus", status)?;
        Ok(Step::Discarded(reached, reason))
    }

    /// Ends the flight.
    pub fn terminate(&mut self) -> Result<()> {
        // SAFETY: the component is the one that fmi2Instantiate returned.
        let status = unsafe { (self.functions.terminate)(self.component) };
        self.check("fmi2Terminate", status)
    }

    /// Messages of the FMU so far.
    pub fn messages(&self) -> Vec<Message> {
        self.log.all()
    }

    fn check(&self, call: &str, status: c_int) -> Result<()> {
        match status {
            OK | WARNING => Ok(()),
            _ => {
                let reason = self.log.last();
                // The message may already start with the name of the call.
                let reason = reason.strip_prefix(call).unwrap_or(&reason);
                let reason = reason.trim_start_matches([':', ' ']);
                Err(anyhow!("{call} returned {}: {reason}", status_name(status)))
            }
        }
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: the component is ours and is not used after this.
        unsafe { (self.functions.free_instance)(self.component) }
    }
}

pub fn status_name(status: c_int) -> &'static str {
    ["OK", "Warning", "Discard", "Error", "Fatal", "Pending"]
        .get(usize::try_from(status).unwrap_or(usize::MAX))
        .copied()
        .unwrap_or("an unknown status")
}

// Types and constants of fmi2FunctionTypes.h (FMI 2.0.5).
type Component = *mut c_void;
type FixedLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
type VariadicLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);
const FALSE: c_int = 0;
const TRUE: c_int = 1;
const OK: c_int = 0;
const WARNING: c_int = 1;
const DISCARD: c_int = 2;
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
    let text = |pointer: *const c_char| match pointer.is_null() {
        true => String::new(),
        // SAFETY: not null, and a terminated string by the standard.
        false => unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned(),
    };
    // SAFETY: the environment is the log that was passed with the callbacks; it outlives them.
    let Some(log) = (unsafe { environment.cast::<Log>().as_ref() }) else { return };
    let (category, text) = (text(category), text(message).replace("%%", "%").replace("##", "#"));
    let message = Message { status, category, text };
    log.0.lock().unwrap_or_else(PoisonError::into_inner).push(message);
}

/// Declares the table of C functions and loads it from a library.
macro_rules! functions {
    ($($field:ident: $symbol:literal fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        struct Functions { $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)* }

        impl Functions {
            fn load(library: &Library) -> Result<Self> {
                // SAFETY: FMI 2.0.5 fixes these signatures; the pointers are kept beside the library.
                Ok(Self { $($field: unsafe {
                    *library.get($symbol).with_context(|| format!("the FMU lacks {}", $symbol))?
                },)* })
            }
        }
    };
}

functions! {
    instantiate: "fmi2Instantiate" fn(*const c_char, c_int, *const c_char, *const c_char, *const Callbacks, c_int, c_int) -> Component;
    setup_experiment: "fmi2SetupExperiment" fn(Component, c_int, f64, f64, c_int, f64) -> c_int;
    enter_initialization_mode: "fmi2EnterInitializationMode" fn(Component) -> c_int;
    exit_initialization_mode: "fmi2ExitInitializationMode" fn(Component) -> c_int;
    set_real: "fmi2SetReal" fn(Component, *const c_uint, usize, *const f64) -> c_int;
    set_integer: "fmi2SetInteger" fn(Component, *const c_uint, usize, *const c_int) -> c_int;
    set_boolean: "fmi2SetBoolean" fn(Component, *const c_uint, usize, *const c_int) -> c_int;
    get_real: "fmi2GetReal" fn(Component, *const c_uint, usize, *mut f64) -> c_int;
    set_real_input_derivatives: "fmi2SetRealInputDerivatives" fn(Component, *const c_uint, usize, *const c_int, *const f64) -> c_int;
    do_step: "fmi2DoStep" fn(Component, f64, f64, c_int) -> c_int;
    get_real_status: "fmi2GetRealStatus" fn(Component, c_int, *mut f64) -> c_int;
    terminate: "fmi2Terminate" fn(Component) -> c_int;
    free_instance: "fmi2FreeInstance" fn(Component);
}
