//! The FMU state and its bytes (section 2.1.8). A `fmi2FMUstate` is a boxed
//! [`FmuState`](snapshot::FmuState): plain numbers that do not refer to the instance they are from.

use super::entry::{enter, input, output, store};
use crate::fmi::failure::{Failure, Outcome};
use crate::fmi::instance::Instance;
use crate::fmi::lifecycle as calls;
use crate::fmi::snapshot::FmuState;
use crate::fmi::sys::{self, Byte, Component, Status};
use core::ptr;

/// The state behind a pointer that has to lead to one.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library.
unsafe fn given<'a>(state: sys::FmuState) -> Result<&'a FmuState, Failure> {
    // SAFETY: by this function's contract.
    unsafe { state.cast::<FmuState>().as_ref() }.ok_or(Failure::BadPointer { argument: "FMUstate" })
}

/// Puts a state where `place` says: into the state that is there, or else into a new one.
///
/// # Safety
/// `place` is NULL or leads to NULL or to a live FMU state of this library.
unsafe fn put(place: *mut sys::FmuState, state: FmuState) -> Outcome {
    // SAFETY: by this function's contract.
    let Some(place) = (unsafe { place.as_mut() }) else {
        return Err(Failure::BadPointer { argument: "FMUstate" });
    };
    // SAFETY: likewise.
    match unsafe { place.cast::<FmuState>().as_mut() } {
        Some(old) => *old = state,
        None => *place = Box::into_raw(Box::new(state)).cast(),
    }
    Ok(())
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2GetFMUstate(
    c: Component,
    FMUstate: *mut sys::FmuState,
) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |instance: &mut Instance| unsafe { put(FMUstate, instance.state()) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_FMU_STATE, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SetFMUstate(c: Component, FMUstate: sys::FmuState) -> Status {
    // SAFETY: the master passes NULL or a state that it got here.
    let body = |instance: &mut Instance| instance.set_state(unsafe { given(FMUstate) }?);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_FMU_STATE, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2FreeFMUstate(
    c: Component,
    FMUstate: *mut sys::FmuState,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
        if let Some(place) = unsafe { FMUstate.as_mut() }
            && !place.is_null()
        {
            // SAFETY: the state was boxed by `put` and is freed once, as the place is cleared.
            drop(unsafe { Box::from_raw(place.cast::<FmuState>()) });
            *place = ptr::null_mut();
        }
        Ok(())
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::FREE_FMU_STATE, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: Component,
    FMUstate: sys::FmuState,
    size: *mut usize,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the master passes NULL or a state that it got here, and room for the size.
        unsafe { given(FMUstate).and_then(|_| store("size", size, FmuState::encoded_len())) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SERIALIZED_FMU_STATE_SIZE, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2SerializeFMUstate(
    c: Component,
    FMUstate: sys::FmuState,
    serializedState: *mut Byte,
    size: usize,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: the master passes NULL or a state that it got here.
        let bytes = instance.serialize(unsafe { given(FMUstate) }?);
        if size != bytes.len() {
            return Err(Failure::Argument {
                argument: "size",
                value: size as f64,
                expected: format!("fmi2SerializedFMUstateSize gives {}", bytes.len()),
            });
        }
        // SAFETY: the master passes an array of size bytes.
        let room = unsafe { output("serializedState", serializedState, size) }?;
        for (place, byte) in room.iter_mut().zip(bytes) {
            place.write(byte as Byte);
        }
        Ok(())
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SERIALIZE_FMU_STATE, body) }
}

#[unsafe(no_mangle)]
pub(super) unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: Component,
    serializedState: *const Byte,
    size: usize,
    FMUstate: *mut sys::FmuState,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: the master passes an array of size bytes.
        let bytes = unsafe { input("serializedState", serializedState.cast::<u8>(), size) }?;
        let state = instance.deserialize(bytes)?;
        // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
        unsafe { put(FMUstate, state) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::DESERIALIZE_FMU_STATE, body) }
}
