//! The FMU state and its bytes (section 2.1.8). A `fmi2FMUstate` is a boxed
//! [`FmuState`]: plain numbers that do not refer to the instance they are from.

use super::entry::{enter, input, output, place, store};
use crate::failure::{Failure, Outcome};
use crate::instance::Instance;
use crate::model::Model;
use crate::state::FmuState;
use crate::v2::calls;
use crate::v2::sys::{self, Byte, Component, Status};
use core::ptr;

/// The state behind a pointer that has to lead to one.
///
/// # Safety
/// `state` is NULL or a live FMU state of this library.
unsafe fn given<'a, M>(state: sys::FmuState) -> Result<&'a mut FmuState<M>, Failure> {
    // SAFETY: by this function's contract.
    unsafe { place("FMUstate", state.cast::<FmuState<M>>(), "an FMU state of this model") }
}

/// Puts a state where a pointer leads: into the state that is there, or else into a new one.
///
/// # Safety
/// `pointer` is NULL or leads to NULL or to a live FMU state of this library.
unsafe fn put<M>(pointer: *mut sys::FmuState, state: FmuState<M>) -> Outcome {
    // SAFETY: by this function's contract.
    let slot = unsafe { place("FMUstate", pointer, "a place for an FMU state") }?;
    if slot.is_null() {
        *slot = Box::into_raw(Box::new(state)).cast();
    } else {
        // SAFETY: likewise.
        *unsafe { given(*slot) }? = state;
    }
    Ok(())
}

pub unsafe fn fmi2GetFMUstate<M: Model>(c: Component, FMUstate: *mut sys::FmuState) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |instance: &mut Instance<M>| unsafe { put(FMUstate, instance.state()?) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_FMU_STATE, body) }
}

pub unsafe fn fmi2SetFMUstate<M: Model>(c: Component, FMUstate: sys::FmuState) -> Status {
    // SAFETY: the master passes NULL or a state that it got here.
    let body = |instance: &mut Instance<M>| instance.set_state(unsafe { given(FMUstate) }?);
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_FMU_STATE, body) }
}

pub unsafe fn fmi2FreeFMUstate<M: Model>(c: Component, FMUstate: *mut sys::FmuState) -> Status {
    let body = |_: &mut Instance<M>| {
        if FMUstate.is_null() {
            return Ok(());
        }
        // SAFETY: the master passes a place with NULL or a state that it got here.
        let slot = unsafe { place("FMUstate", FMUstate, "a place with an FMU state") }?;
        if !slot.is_null() {
            // SAFETY: likewise.
            let state: *mut FmuState<M> = unsafe { given(*slot) }?;
            // SAFETY: the state was boxed by `put` and is freed once, as the place is cleared.
            drop(unsafe { Box::from_raw(state) });
            *slot = ptr::null_mut();
        }
        Ok(())
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::FREE_FMU_STATE, body) }
}

pub unsafe fn fmi2SerializedFMUstateSize<M: Model>(
    c: Component,
    FMUstate: sys::FmuState,
    size: *mut usize,
) -> Status {
    let body = |_: &mut Instance<M>| {
        // SAFETY: the master passes NULL or a state that it got here, and room for the size.
        unsafe {
            given::<M>(FMUstate)?;
            store("size", size, FmuState::<M>::encoded_len()?)
        }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SERIALIZED_FMU_STATE_SIZE, body) }
}

pub unsafe fn fmi2SerializeFMUstate<M: Model>(
    c: Component,
    FMUstate: sys::FmuState,
    serializedState: *mut Byte,
    size: usize,
) -> Status {
    let body = |_: &mut Instance<M>| {
        // SAFETY: the master passes NULL or a state that it got here.
        let bytes = unsafe { given::<M>(FMUstate) }?.encode()?;
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

pub unsafe fn fmi2DeSerializeFMUstate<M: Model>(
    c: Component,
    serializedState: *const Byte,
    size: usize,
    FMUstate: *mut sys::FmuState,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: the master passes an array of size bytes.
        let bytes = unsafe { input("serializedState", serializedState.cast::<u8>(), size) }?;
        let state = instance.deserialize(bytes)?;
        // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
        unsafe { put(FMUstate, state) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::DESERIALIZE_FMU_STATE, body) }
}
