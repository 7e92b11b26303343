//! The calls of FMI 3.0.
#![allow(unsafe_code)]

use super::{Calls, Log, Step, functions, text};
use crate::fmu::Fmu;
use crate::model_description::{Causality, Kind, Variable};
use anyhow::{Context, Result, bail};
use libloading::Library;
use std::cell::RefCell;
use std::ffi::{CString, c_char, c_int, c_void};
use std::ptr;

/// What the callbacks need; its address is the environment pointer.
struct Environment {
    log: Log,
    /// Functions and instance, once there is one.
    set: RefCell<Option<(SetFloat64, *mut c_void)>>,
    /// Inputs that move within the present step: reference, value at its start, slope.
    moving: RefCell<Vec<(u32, f64, f64)>>,
    /// Start of the present step, s.
    start: RefCell<f64>,
}

/// An instance.
pub struct Component {
    functions: Functions,
    pointer: *mut c_void,
    environment: Box<Environment>,
}

impl Component {
    pub fn new(library: &Library, fmu: &Fmu) -> Result<Self> {
        let functions = Functions::load(library)?;
        let environment = Box::new(Environment {
            log: Log::default(),
            set: RefCell::default(),
            moving: RefCell::default(),
            start: RefCell::default(),
        });
        let name = CString::new(fmu.model.model_name.as_str())?;
        let token = CString::new(fmu.model.token.as_str())?;
        // The standard wants a separator at the end.
        let resources = CString::new(format!("{}/", fmu.resources().display()))?;
        let inputs = fmu.model.with(Causality::Input).filter(|input| input.moves_within_a_step);
        let inputs: Vec<_> = inputs.map(|input| input.value_reference).collect();
        let update = (!inputs.is_empty()).then_some(update as Update);
        // SAFETY: the strings are terminated and outlive the call, as does the array; the environment lives in a
        // box that the instance keeps until it is freed.
        let pointer = unsafe {
            (functions.instantiate)(
                name.as_ptr(),
                token.as_ptr(),
                resources.as_ptr(),
                false,
                true,
                false,
                true,
                inputs.as_ptr(),
                inputs.len(),
                ptr::from_ref::<Environment>(&environment).cast(),
                log,
                update,
            )
        };
        if pointer.is_null() {
            bail!("fmi3InstantiateCoSimulation failed: {}", environment.log.last());
        }
        environment.set.replace(Some((functions.set_float64, pointer)));
        Ok(Self { functions, pointer, environment })
    }

    fn check(&self, call: &str, status: c_int) -> Result<()> {
        self.environment.log.check(call, status)
    }
}

// SAFETY of all calls: the instance is the one that fmi3InstantiateCoSimulation returned, and arrays have the
// length that is passed.
impl Calls for Component {
    fn set_up(&mut self, start: f64, stop: f64, tolerance: f64) -> Result<()> {
        let enter = self.functions.enter_initialization_mode;
        let status = unsafe { enter(self.pointer, true, tolerance, start, true, stop) };
        self.check("fmi3EnterInitializationMode", status)
    }

    fn initialise(&mut self) -> Result<()> {
        let status = unsafe { (self.functions.exit_initialization_mode)(self.pointer) };
        self.check("fmi3ExitInitializationMode", status)
    }

    fn set(&mut self, variable: &Variable, value: f64) -> Result<()> {
        let (reference, instance) = (&raw const variable.value_reference, self.pointer);
        let Functions { set_float64, set_int32, set_int64, set_boolean, .. } = self.functions;
        let (call, status) = match variable.kind {
            Kind::Real(_) => ("fmi3SetFloat64", unsafe {
                set_float64(instance, reference, 1, &raw const value, 1)
            }),
            Kind::Integer => {
                ("fmi3SetInt32", unsafe { set_int32(instance, reference, 1, &(value as i32), 1) })
            }
            Kind::Enumeration(_) => {
                ("fmi3SetInt64", unsafe { set_int64(instance, reference, 1, &(value as i64), 1) })
            }
            Kind::Boolean => ("fmi3SetBoolean", unsafe {
                set_boolean(instance, reference, 1, &(value != 0.0), 1)
            }),
            Kind::Other => bail!("{} has a type that cannot be set", variable.name),
        };
        self.check(call, status)
    }

    /// The FMU asks within the step where the inputs are.
    fn set_slopes(&mut self, inputs: &[&Variable], slopes: &[f64]) -> Result<()> {
        let references: Vec<_> = inputs.iter().map(|input| input.value_reference).collect();
        let values = self.get(&references)?;
        if let Some(input) = inputs.iter().find(|input| !input.moves_within_a_step) {
            bail!("{} cannot move within a step: it has no intermediateUpdate", input.name);
        }
        let moving = references.into_iter().zip(values).zip(slopes);
        let moving = moving.map(|((reference, value), slope)| (reference, value, *slope));
        self.environment.moving.replace(moving.collect());
        Ok(())
    }

    fn get(&mut self, references: &[u32]) -> Result<Vec<f64>> {
        let (mut values, count) = (vec![0.0; references.len()], references.len());
        let (from, to) = (references.as_ptr(), values.as_mut_ptr());
        let get = self.functions.get_float64;
        let status = unsafe { get(self.pointer, from, count, to, count) };
        self.check("fmi3GetFloat64", status)?;
        Ok(values)
    }

    fn step(&mut self, time: f64, length: f64) -> Result<Step> {
        self.environment.start.replace(time);
        let [mut event, mut terminate, mut early] = [false; 3];
        let mut reached = time;
        let status = unsafe {
            (self.functions.do_step)(
                self.pointer,
                time,
                length,
                true,
                &raw mut event,
                &raw mut terminate,
                &raw mut early,
                &raw mut reached,
            )
        };
        self.environment.moving.take();
        self.check("fmi3DoStep", status)?;
        if terminate || early {
            return Ok(Step::Discarded(reached, self.environment.log.last()));
        }
        Ok(Step::Done)
    }

    fn terminate(&mut self) -> Result<()> {
        let status = unsafe { (self.functions.terminate)(self.pointer) };
        self.check("fmi3Terminate", status)
    }

    fn log(&self) -> &Log {
        &self.environment.log
    }
}

impl Drop for Component {
    fn drop(&mut self) {
        // SAFETY: the instance is ours and is not used after this.
        unsafe { (self.functions.free_instance)(self.pointer) }
    }
}

/// fmi3LogMessageCallback.
unsafe extern "C" fn log(
    environment: *const c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the one that was passed with the callback; it outlives it.
    let Some(environment) = (unsafe { environment.cast::<Environment>().as_ref() }) else { return };
    // SAFETY: both are NULL or terminated strings by the standard.
    let (category, message) = unsafe { (text(category), text(message)) };
    environment.log.add(status, category, &message);
}

/// fmi3IntermediateUpdateCallback: tells where the moving inputs are.
unsafe extern "C" fn update(
    environment: *const c_void,
    time: f64,
    set_requested: bool,
    _get_allowed: bool,
    _step_finished: bool,
    _can_return_early: bool,
    early_return_requested: *mut bool,
    _early_return_time: *mut f64,
) {
    // SAFETY: the environment is the one that was passed with the callback; it outlives it.
    let Some(environment) = (unsafe { environment.cast::<Environment>().as_ref() }) else { return };
    // SAFETY: NULL or a place for the answer.
    if let Some(requested) = unsafe { early_return_requested.as_mut() } {
        *requested = false;
    }
    let Some((set, instance)) = *environment.set.borrow() else { return };
    let start = *environment.start.borrow();
    for &(reference, value, slope) in environment.moving.borrow().iter().filter(|_| set_requested) {
        let now = value + slope * (time - start);
        // SAFETY: one reference and one value. What the FMU refuses it says in the log.
        let _ = unsafe { set(instance, &reference, 1, &now, 1) };
    }
}

type SetFloat64 = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const f64, usize) -> c_int;
type LogMessage = unsafe extern "C" fn(*const c_void, c_int, *const c_char, *const c_char);
type Update = unsafe extern "C" fn(*const c_void, f64, bool, bool, bool, bool, *mut bool, *mut f64);

functions! {
    instantiate: "fmi3InstantiateCoSimulation" fn(*const c_char, *const c_char, *const c_char, bool, bool, bool, bool, *const u32, usize, *const c_void, LogMessage, Option<Update>) -> *mut c_void;
    enter_initialization_mode: "fmi3EnterInitializationMode" fn(*mut c_void, bool, f64, f64, bool, f64) -> c_int;
    exit_initialization_mode: "fmi3ExitInitializationMode" fn(*mut c_void) -> c_int;
    set_float64: "fmi3SetFloat64" fn(*mut c_void, *const u32, usize, *const f64, usize) -> c_int;
    set_int32: "fmi3SetInt32" fn(*mut c_void, *const u32, usize, *const i32, usize) -> c_int;
    set_int64: "fmi3SetInt64" fn(*mut c_void, *const u32, usize, *const i64, usize) -> c_int;
    set_boolean: "fmi3SetBoolean" fn(*mut c_void, *const u32, usize, *const bool, usize) -> c_int;
    get_float64: "fmi3GetFloat64" fn(*mut c_void, *const u32, usize, *mut f64, usize) -> c_int;
    do_step: "fmi3DoStep" fn(*mut c_void, f64, f64, bool, *mut bool, *mut bool, *mut bool, *mut f64) -> c_int;
    terminate: "fmi3Terminate" fn(*mut c_void) -> c_int;
    free_instance: "fmi3FreeInstance" fn(*mut c_void);
}
