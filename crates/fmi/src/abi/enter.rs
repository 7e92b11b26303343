//! Instances: made, called, freed; their messages reach the master.

use crate::failure::Outcome;
use crate::guard::{guarded, run};
use crate::instance::Instance;
use crate::log::Message;
use crate::model::Model;
use crate::phase::Call;
use crate::status::Status;
use core::ffi::{CStr, c_char, c_void};
use core::ptr;
use std::ffi::CString;

/// What a master wants to be told, a copy: its own may be valid during the instantiation only.
pub trait Callbacks: Copy {
    /// Hands a message to the master's logger, if there is one.
    ///
    /// # Safety
    /// The logger is NULL or one of the standard; `name` is a C string.
    unsafe fn deliver(&self, name: *const c_char, message: &Message);
}

/// What `fmi2Component` and `fmi3Instance` point to.
pub struct Handle<M: Model, C> {
    pub instance: Instance<M>,
    pub name: CString,
    pub callbacks: C,
}

/// Makes an instance, or says why not and returns NULL.
///
/// # Safety
/// `name` is NULL or a C string; the callbacks are those of the standard.
pub(crate) unsafe fn create<M: Model, C: Callbacks>(
    call: &str,
    name: *const c_char,
    callbacks: C,
    make: impl FnOnce() -> Result<Instance<M>, String>,
) -> *mut c_void {
    let made = guarded(make, |panic| Err(format!("internal error: {panic}")));
    let name = if name.is_null() {
        CString::default()
    } else {
        // SAFETY: not NULL, hence a C string.
        unsafe { CStr::from_ptr(name) }.to_owned()
    };
    match made {
        // The allocator is Rust's, not allocateMemory of FMI 2.0: the model description says
        // canNotUseMemoryManagementFunctions = true, and section 2.1.5 discourages the latter.
        Ok(instance) => Box::into_raw(Box::new(Handle { instance, name, callbacks })).cast(),
        Err(text) => {
            let message = Message::new(Status::Error, format!("{call}: {text}"));
            // SAFETY: the logger is the master's, the name is a live C string.
            unsafe { callbacks.deliver(name.as_ptr(), &message) };
            ptr::null_mut()
        }
    }
}

/// Frees an instance; NULL is ignored.
///
/// # Safety
/// `handle` is NULL or what [`create`] made, and is not used again.
pub(crate) unsafe fn free<M: Model, C>(handle: *mut c_void) {
    if !handle.is_null() {
        // SAFETY: by this function's contract.
        let handle = unsafe { Box::from_raw(handle.cast::<Handle<M, C>>()) };
        guarded(|| drop(handle), |_| ());
    }
}

/// Makes one call on an instance; its messages go out afterwards, when no reference to the instance
/// is left, so a logger may call the FMU.
///
/// # Safety
/// `handle` is NULL or a live instance that no other thread is using.
pub(crate) unsafe fn enter<M: Model, C: Callbacks>(
    handle: *mut c_void,
    call: &Call,
    body: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> Status {
    let mut body = Some(body);
    // SAFETY: by this function's contract.
    unsafe {
        enter_any::<M, C>(handle, call, &mut |instance| match body.take() {
            Some(body) => body(instance),
            None => Ok(()),
        })
    }
}

/// [`enter`], compiled once for all calls: a library has 120 of them.
///
/// # Safety
/// That of [`enter`].
unsafe fn enter_any<M: Model, C: Callbacks>(
    handle: *mut c_void,
    call: &Call,
    body: &mut dyn FnMut(&mut Instance<M>) -> Outcome,
) -> Status {
    let handle = handle.cast::<Handle<M, C>>();
    if handle.is_null() {
        return Status::Error;
    }
    // SAFETY: not NULL, hence live and ours alone by this function's contract.
    let instance = unsafe { &mut (*handle).instance };
    let status = run(instance, call, body);
    let messages = instance.log.take();
    if !messages.is_empty() {
        // SAFETY: as above; the name lives as long as the instance, the callbacks are copied.
        let (name, callbacks) = unsafe { ((*handle).name.as_ptr(), (*handle).callbacks) };
        for message in &messages {
            // SAFETY: the logger is the master's, the name is a live C string.
            unsafe { callbacks.deliver(name, message) };
        }
    }
    status
}
