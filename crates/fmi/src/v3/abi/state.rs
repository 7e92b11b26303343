//! The FMU state and its bytes (section 2.2.10).

use super::entry::enter;
use crate::abi::{self, store};
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::state::FmuState as State;
use crate::v3::calls;
use crate::v3::sys::{Byte, FmuState, Instance, Status};

/// The standard's name of the argument.
const STATE: &str = "FMUState";

pub unsafe fn fmi3GetFMUState<M: Model>(instance: Instance, FMUState: *mut FmuState) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |instance: &mut Of<M>| unsafe { abi::get_state(instance, STATE, FMUState) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::GET_FMU_STATE, body) }
}

pub unsafe fn fmi3SetFMUState<M: Model>(instance: Instance, FMUState: FmuState) -> Status {
    // SAFETY: the master passes NULL or a state that it got here.
    let body = |instance: &mut Of<M>| unsafe { abi::set_state(instance, STATE, FMUState) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::SET_FMU_STATE, body) }
}

pub unsafe fn fmi3FreeFMUState<M: Model>(instance: Instance, FMUState: *mut FmuState) -> Status {
    // SAFETY: the master passes NULL, or a place with NULL or a state that it got here.
    let body = |_: &mut Of<M>| unsafe { abi::free_state::<M>(STATE, FMUState) };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::FREE_FMU_STATE, body) }
}

pub unsafe fn fmi3SerializedFMUStateSize<M: Model>(
    instance: Instance,
    FMUState: FmuState,
    size: *mut usize,
) -> Status {
    let body = |_: &mut Of<M>| {
        // SAFETY: the master passes NULL or a state that it got here, and room for the size.
        unsafe {
            abi::check_state::<M>(STATE, FMUState)?;
            store("size", size, State::<M>::encoded_len()?)
        }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::SERIALIZED_FMU_STATE_SIZE, body) }
}

pub unsafe fn fmi3SerializeFMUState<M: Model>(
    instance: Instance,
    FMUState: FmuState,
    serializedState: *mut Byte,
    size: usize,
) -> Status {
    let body = |_: &mut Of<M>| {
        // SAFETY: the master passes NULL or a state that it got here, and an array of size bytes.
        unsafe { abi::serialize::<M>(STATE, FMUState, serializedState, size) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::SERIALIZE_FMU_STATE, body) }
}

pub unsafe fn fmi3DeserializeFMUState<M: Model>(
    instance: Instance,
    serializedState: *const Byte,
    size: usize,
    FMUState: *mut FmuState,
) -> Status {
    let body = |instance: &mut Of<M>| {
        // SAFETY: the master passes an array of size bytes, and NULL, or a place with NULL or a state that it
        // got here.
        unsafe { abi::deserialize(instance, STATE, serializedState, size, FMUState) }
    };
    // SAFETY: the master passes one of its instances.
    unsafe { enter(instance, &calls::DESERIALIZE_FMU_STATE, body) }
}
