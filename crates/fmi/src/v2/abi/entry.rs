//! From C to the guard and back: instances, arrays, strings, messages.

use crate::failure::{Failure, Outcome};
use crate::guard;
use crate::instance::Instance;
use crate::log::Message;
use crate::model::Model;
use crate::v2::calls::Call;
use crate::v2::sys;
use core::ffi::{CStr, c_char};
use core::mem::MaybeUninit;
use core::slice;
use std::ffi::CString;

/// What a `fmi2Component` points to.
pub struct Component<M: Model> {
    pub instance: Instance<M>,
    pub name: CString,
    /// A copy: the master's struct is only valid during `fmi2Instantiate`.
    pub callbacks: sys::CallbackFunctions,
}

/// Makes one call on an instance; its messages go out afterwards, when no reference to the instance
/// is left, so a logger may call the FMU.
///
/// # Safety
/// `component` is NULL or a live instance that no other thread is using.
pub(super) unsafe fn enter<M: Model>(
    component: sys::Component,
    call: &Call,
    body: impl FnOnce(&mut Instance<M>) -> Outcome,
) -> sys::Status {
    let component = component.cast::<Component<M>>();
    if component.is_null() {
        return sys::Status::Error;
    }
    // SAFETY: not NULL, hence live and ours alone by this function's contract.
    let instance = unsafe { &mut (*component).instance };
    let status = guard::run(instance, call, body);
    let messages = instance.log.take();
    if !messages.is_empty() {
        // SAFETY: as above; the name lives as long as the instance, the callbacks are copied.
        let (name, callbacks) = unsafe { ((*component).name.as_ptr(), (*component).callbacks) };
        for message in &messages {
            // SAFETY: the logger is the master's, the name is a live C string.
            unsafe { deliver(&callbacks, name, message) };
        }
    }
    status
}

/// Hands a message to the master's logger, if there is one.
///
/// # Safety
/// `callbacks.logger` is NULL or a logger of the standard; `name` is a C string.
pub(super) unsafe fn deliver(
    callbacks: &sys::CallbackFunctions,
    name: *const c_char,
    message: &Message,
) {
    if let Some(logger) = callbacks.logger {
        let (category, text) = (message.category.name().as_ptr(), message.text.as_ptr());
        // SAFETY: by this function's contract; category and text are live C strings, and the text
        // names no further arguments.
        unsafe { logger(callbacks.environment, name, message.status, category, text) };
    }
}

/// Whether `count` elements can lie at `pointer`: alignment, and a length that a negative number
/// cast to `size_t` does not have.
fn plausible<T>(pointer: *const T, count: usize) -> bool {
    !pointer.is_null() && pointer.is_aligned() && count <= isize::MAX as usize / size_of::<T>()
}

/// What arguments point to.
const ARRAY: &str = "an array of the length given";
const PLACE: &str = "a place for the result";
const TEXT: &str = "a C string";

/// An array to read; no element needs no array.
///
/// # Safety
/// `pointer` is NULL or leads to `count` elements that nobody changes meanwhile.
pub(super) unsafe fn input<'a, T>(
    argument: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if !plausible(pointer, count) {
        return Err(Failure::BadPointer { argument, place: ARRAY });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array to write, which a master need not have initialised; no element needs no array.
///
/// # Safety
/// `pointer` is NULL or leads to room for `count` elements that nobody else uses meanwhile.
pub(super) unsafe fn output<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    if !plausible(pointer, count) {
        return Err(Failure::BadPointer { argument, place: ARRAY });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// Room for a single result, which a master need not have initialised.
///
/// # Safety
/// `pointer` is NULL or leads to room for one value that nobody else uses meanwhile.
pub(super) unsafe fn room<'a, T>(
    argument: &'static str,
    pointer: *mut T,
) -> Result<&'a mut MaybeUninit<T>, Failure> {
    // SAFETY: by this function's contract.
    unsafe { place(argument, pointer.cast(), PLACE) }
}

/// A single result.
///
/// # Safety
/// `pointer` is NULL or leads to room for one value.
pub(super) unsafe fn store<T>(argument: &'static str, pointer: *mut T, value: T) -> Outcome {
    // SAFETY: by this function's contract.
    unsafe { room(argument, pointer) }?.write(value);
    Ok(())
}

/// What a pointer leads to, to read it and to write it.
///
/// # Safety
/// `pointer` is NULL or leads to a value that nobody else uses meanwhile.
pub(super) unsafe fn place<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    place: &'static str,
) -> Result<&'a mut T, Failure> {
    if !plausible(pointer, 1) {
        return Err(Failure::BadPointer { argument, place });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { &mut *pointer })
}

/// A string; what is not UTF-8 is replaced, as it only goes into messages and comparisons.
///
/// # Safety
/// `pointer` is NULL or a C string.
pub(super) unsafe fn string(
    argument: &'static str,
    pointer: sys::FmiString,
) -> Result<String, Failure> {
    if pointer.is_null() {
        return Err(Failure::BadPointer { argument, place: TEXT });
    }
    // SAFETY: not NULL, and a C string by this function's contract.
    Ok(unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned())
}
