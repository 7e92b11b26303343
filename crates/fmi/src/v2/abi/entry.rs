//! Calls on an instance of FMI 2.0.

use crate::abi::{self, Callbacks};
use crate::failure::Outcome;
use crate::instance::Instance;
use crate::log::Message;
use crate::model::Model;
use crate::phase::Call;
use crate::standard::Standard;
use crate::v2::sys::{self, CallbackFunctions};
use core::ffi::c_char;

impl Callbacks for CallbackFunctions {
    unsafe fn deliver(&self, name: *const c_char, message: &Message) {
        if let Some(logger) = self.logger {
            let (category, text) = (message.category.name(), message.escaped(Standard::Fmi2));
            let (category, text) = (category.as_ptr(), text.as_ptr());
            // SAFETY: by the trait's contract; category and text are live C strings, and the text names no
            // further arguments.
            unsafe { logger(self.environment, name, message.status, category, text) };
        }
    }
}

/// Makes one call on an instance.
///
/// # Safety
/// `component` is NULL or a live instance that no other thread is using.
pub(super) unsafe fn enter<M: Model>(
    component: sys::Component,
    call: &Call,
    body: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> sys::Status {
    // SAFETY: by this function's contract.
    unsafe { abi::enter::<M, CallbackFunctions>(component, call, body) }
}
