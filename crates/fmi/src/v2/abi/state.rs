//! The FMU state and its bytes (section 2.1.8).

use super::entry::enter;
use crate::abi::{self, store};
use crate::instance::Instance;
use crate::model::Model;
use crate::state::FmuState;
use crate::v2::calls;
use crate::v2::sys::{self, Byte, Component, Status};

/// The standard's name of the argument.
const STATE: &str = "FMUstate";

pub unsafe fn fmi2GetFMUstate<M: Model>(c: Component, FMUstate: *mut sys::FmuState) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |instance: &mut Instance<M>| unsafe { abi::get_state(instance, STATE, FMUstate) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::GET_FMU_STATE, body) }
}

pub unsafe fn fmi2SetFMUstate<M: Model>(c: Component, FMUstate: sys::FmuState) -> Status {
    // SAFETY: the master passes NULL or a state that it got here.
    let body = |instance: &mut Instance<M>| unsafe { abi::set_state(instance, STATE, FMUstate) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::SET_FMU_STATE, body) }
}

pub unsafe fn fmi2FreeFMUstate<M: Model>(c: Component, FMUstate: *mut sys::FmuState) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |_: &mut Instance<M>| unsafe { abi::free_state::<M>(STATE, FMUstate) };
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
            abi::check_state::<M>(STATE, FMUstate)?;
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
        // SAFETY: the master passes NULL or a state that it got here, and an array of size bytes.
        unsafe { abi::serialize::<M>(STATE, FMUstate, serializedState.cast(), size) }
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
        // SAFETY: the master passes an array of size bytes, and NULL, or a place with NULL or a state that it
        // got here.
        unsafe { abi::deserialize(instance, STATE, serializedState.cast(), size, FMUstate) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(c, &calls::DESERIALIZE_FMU_STATE, body) }
}
