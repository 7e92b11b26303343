//! Calls on an instance of FMI 3.0.

use crate::abi::{self, Callbacks, Handle};
use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::log::Message;
use crate::model::Model;
use crate::phase::Call;
use crate::standard::Standard;
use crate::v3::sys::{self, IntermediateUpdateCallback, LogMessageCallback, Status};
use core::ffi::c_char;

/// What the master passed when it made the instance.
#[derive(Clone, Copy)]
pub(super) struct Environment {
    pub pointer: sys::InstanceEnvironment,
    pub log: Option<LogMessageCallback>,
    pub update: Option<IntermediateUpdateCallback>,
    pub early_return_allowed: bool,
    /// Whether the master wants to set inputs within a step.
    pub moves_inputs: bool,
}

impl Callbacks for Environment {
    unsafe fn deliver(&self, _name: *const c_char, message: &Message) {
        if let Some(log) = self.log {
            let (category, text) = (message.category.name(), message.escaped(Standard::Fmi3));
            // SAFETY: by the trait's contract; category and text are live C strings.
            unsafe { log(self.pointer, message.status, category.as_ptr(), text.as_ptr()) };
        }
    }
}

/// Makes one call on an instance.
///
/// # Safety
/// `instance` is NULL or a live instance that no other thread is using.
pub(super) unsafe fn enter<M: Model>(
    instance: sys::Instance,
    call: &Call,
    body: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> Status {
    // SAFETY: by this function's contract.
    unsafe { abi::enter::<M, Environment>(instance, call, body) }
}

/// What an instance is, between two calls.
///
/// # Safety
/// `instance` is a live instance that no other thread is using, and no call on it is running.
pub(super) unsafe fn look<'a, M: Model>(instance: sys::Instance) -> (&'a Instance<M>, Environment) {
    // SAFETY: by this function's contract.
    let handle = unsafe { &*instance.cast::<Handle<M, Environment>>() };
    (&handle.instance, handle.callbacks)
}

/// Whether a count of values is that of the variables: all are scalars.
pub(super) fn as_many(argument: &'static str, given: usize, needed: usize) -> Outcome {
    if given == needed {
        return Ok(());
    }
    let expected = format!("all variables are scalars, so {needed} values are needed");
    Err(Failure::Argument { argument, value: given as f64, expected })
}
