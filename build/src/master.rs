//! A co-simulation master: calls the C functions of an FMU.
//!
//! Only this folder of the tool has unsafe code; its public functions are safe.

mod fmi2;
mod fmi3;

use crate::fmu::Fmu;
use crate::model_description::Variable;
use ahv::short::short;
use anyhow::{Context, Result, anyhow};
use fmi_model::standard::Standard;
use libloading::Library;
use std::ffi::{CStr, c_char, c_int};
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

    fn add(&self, status: c_int, category: String, text: &str) {
        // Both standards double the sign that begins a value reference.
        let message = Message { status, category, text: text.replace("##", "#") };
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(message);
    }

    fn check(&self, call: &str, status: c_int) -> Result<()> {
        match status {
            OK | WARNING => Ok(()),
            _ => {
                let reason = self.last();
                // The message may already start with the name of the call.
                let reason = reason.strip_prefix(call).unwrap_or(&reason);
                let reason = reason.trim_start_matches([':', ' ']);
                Err(anyhow!("{call} returned {}: {reason}", status_name(status)))
            }
        }
    }
}

/// How a step ended.
#[derive(Debug)]
pub enum Step {
    Done,
    /// The FMU ended the step early: time reached (s) and reason.
    Discarded(f64, String),
}

/// The calls of a version of the standard.
trait Calls {
    fn set_up(&mut self, start: f64, stop: f64, tolerance: f64) -> Result<()>;
    fn initialise(&mut self) -> Result<()>;
    fn set(&mut self, variable: &Variable, value: f64) -> Result<()>;
    fn set_slopes(&mut self, inputs: &[&Variable], slopes: &[f64]) -> Result<()>;
    fn get(&mut self, references: &[u32]) -> Result<Vec<f64>>;
    fn step(&mut self, time: f64, length: f64) -> Result<Step>;
    fn terminate(&mut self) -> Result<()>;
    fn log(&self) -> &Log;
}

/// A running FMU.
pub struct Instance {
    calls: Box<dyn Calls>,
    /// The last field, so that it is dropped last.
    _library: Library,
}

impl Instance {
    /// Loads the binary and makes an instance.
    pub fn new(fmu: &Fmu) -> Result<Self> {
        #[allow(unsafe_code)]
        // SAFETY: loading runs the initialisers of a library that the user asked to load.
        let library = unsafe { Library::new(&fmu.binary) }
            .context("the binary of the FMU cannot be loaded")?;
        let calls: Box<dyn Calls> = match fmu.model.standard {
            Standard::Fmi2 => Box::new(fmi2::Component::new(&library, fmu)?),
            Standard::Fmi3 => Box::new(fmi3::Component::new(&library, fmu)?),
        };
        Ok(Self { calls, _library: library })
    }

    /// Sets up the experiment and enters initialisation mode.
    pub fn set_up(&mut self, start: f64, stop: f64, tolerance: f64) -> Result<()> {
        self.calls.set_up(start, stop, tolerance)
    }

    /// Leaves initialisation mode.
    pub fn initialise(&mut self) -> Result<()> {
        self.calls.initialise()
    }

    /// Sets one variable; Booleans as 0 and 1, enumerations as their number.
    pub fn set(&mut self, variable: &Variable, value: f64) -> Result<()> {
        self.calls
            .set(variable, value)
            .with_context(|| format!("{} = {}", variable.name, short(value)))
    }

    /// Sets the first derivatives of inputs for the next step.
    pub fn set_slopes(&mut self, inputs: &[&Variable], slopes: &[f64]) -> Result<()> {
        self.calls.set_slopes(inputs, slopes)
    }

    /// Values of real variables.
    pub fn get(&mut self, references: &[u32]) -> Result<Vec<f64>> {
        self.calls.get(references)
    }

    /// Steps from `time` over `length`, both in s.
    pub fn step(&mut self, time: f64, length: f64) -> Result<Step> {
        self.calls.step(time, length)
    }

    /// Ends the flight.
    pub fn terminate(&mut self) -> Result<()> {
        self.calls.terminate()
    }

    /// Messages of the FMU so far.
    pub fn messages(&self) -> Vec<Message> {
        self.calls.log().all()
    }
}

pub fn status_name(status: c_int) -> &'static str {
    ["OK", "Warning", "Discard", "Error", "Fatal", "Pending"]
        .get(usize::try_from(status).unwrap_or(usize::MAX))
        .copied()
        .unwrap_or("an unknown status")
}

const OK: c_int = 0;
const WARNING: c_int = 1;
const DISCARD: c_int = 2;

/// A string of the FMU.
///
/// # Safety
/// `pointer` is NULL or a terminated string.
#[allow(unsafe_code)]
unsafe fn text(pointer: *const c_char) -> String {
    if pointer.is_null() {
        return String::new();
    }
    // SAFETY: not null, and by this function's contract.
    unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
}

/// Declares the table of C functions and loads it from a library.
macro_rules! functions {
    ($($field:ident: $symbol:literal fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        struct Functions { $($field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)* }

        impl Functions {
            fn load(library: &Library) -> Result<Self> {
                // SAFETY: the standard fixes these signatures; the pointers are kept beside the library.
                Ok(Self { $($field: unsafe {
                    *library.get($symbol).with_context(|| format!("the FMU lacks {}", $symbol))?
                },)* })
            }
        }
    };
}
use functions;
