//! The FMU state and its bytes. What a master holds is a boxed [`FmuState`]: plain numbers that do not refer
//! to the instance they are from.

use super::{input, output, place};
use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::Model;
use crate::state::FmuState;
use core::ffi::c_void;
use core::ptr;

/// The state behind a pointer that has to lead to one.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library.
unsafe fn given<'a, M>(
    argument: &'static str,
    state: *mut c_void,
) -> Result<&'a mut FmuState<M>, Failure> {
    // SAFETY: by this function's contract.
    unsafe { place(argument, state.cast::<FmuState<M>>(), "an FMU state of this model") }
}

/// Puts a state where a pointer leads: into the state that is there, or else into a new one.
///
/// # Safety
/// `pointer` is NULL or leads to NULL or to a live FMU state of this library.
unsafe fn put<M>(argument: &'static str, pointer: *mut *mut c_void, state: FmuState<M>) -> Outcome {
    // SAFETY: by this function's contract.
    let slot = unsafe { place(argument, pointer, "a place for an FMU state") }?;
    if slot.is_null() {
        *slot = Box::into_raw(Box::new(state)).cast();
    } else {
        // SAFETY: likewise.
        *unsafe { given(argument, *slot) }? = state;
    }
    Ok(())
}

/// Saves the state of an instance.
///
/// # Safety
/// That of `put`.
pub(crate) unsafe fn get_state<M: Model>(
    instance: &Instance<M>,
    argument: &'static str,
    pointer: *mut *mut c_void,
) -> Outcome {
    // SAFETY: by this function's contract.
    unsafe { put(argument, pointer, instance.state()?) }
}

/// Restores the state of an instance.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library.
pub(crate) unsafe fn set_state<M: Model>(
    instance: &mut Instance<M>,
    argument: &'static str,
    state: *mut c_void,
) -> Outcome {
    // SAFETY: by this function's contract.
    instance.set_state(unsafe { given(argument, state) }?)
}

/// Frees a state and clears its place; NULL is ignored.
///
/// # Safety
/// `pointer` is NULL or leads to NULL or to a live FMU state of this library.
pub(crate) unsafe fn free_state<M: Model>(
    argument: &'static str,
    pointer: *mut *mut c_void,
) -> Outcome {
    if pointer.is_null() {
        return Ok(());
    }
    // SAFETY: by this function's contract.
    let slot = unsafe { place(argument, pointer, "a place with an FMU state") }?;
    if !slot.is_null() {
        // SAFETY: likewise.
        let state: *mut FmuState<M> = unsafe { given(argument, *slot) }?;
        // SAFETY: the state was boxed by `put` and is freed once, as the place is cleared.
        drop(unsafe { Box::from_raw(state) });
        *slot = ptr::null_mut();
    }
    Ok(())
}

/// Writes the bytes of a state.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library, `bytes` NULL or room for `size` bytes.
pub(crate) unsafe fn serialize<M: Model>(
    argument: &'static str,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Outcome {
    // SAFETY: by this function's contract.
    let encoded = unsafe { given::<M>(argument, state) }?.encode()?;
    if size != encoded.len() {
        return Err(Failure::Argument {
            argument: "size",
            value: size as f64,
            expected: format!("the bytes of a state are {}", encoded.len()),
        });
    }
    // SAFETY: likewise.
    let room = unsafe { output("serializedState", bytes, size) }?;
    for (place, byte) in room.iter_mut().zip(encoded) {
        place.write(byte);
    }
    Ok(())
}

/// Makes a state of bytes.
///
/// # Safety
/// `bytes` is NULL or leads to `size` bytes; that of `put`.
pub(crate) unsafe fn deserialize<M: Model>(
    instance: &Instance<M>,
    argument: &'static str,
    bytes: *const u8,
    size: usize,
    pointer: *mut *mut c_void,
) -> Outcome {
    // SAFETY: by this function's contract.
    let bytes = unsafe { input("serializedState", bytes, size) }?;
    let state = instance.deserialize(bytes)?;
    // SAFETY: likewise.
    unsafe { put(argument, pointer, state) }
}

/// Whether a pointer leads to a state.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library.
pub(crate) unsafe fn check_state<M: Model>(argument: &'static str, state: *mut c_void) -> Outcome {
    // SAFETY: by this function's contract.
    unsafe { given::<M>(argument, state) }.map(drop)
}
