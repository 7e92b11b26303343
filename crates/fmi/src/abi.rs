//! From C to Rust and back, for either standard: instances, arrays, strings, states, messages.

#![allow(unsafe_code)]

mod enter;
mod pointers;
mod state;

pub(crate) use enter::{Callbacks, Handle, create, enter, free};
pub(crate) use pointers::{input, output, place, room, store, string};
pub(crate) use state::{check_state, deserialize, free_state, get_state, serialize, set_state};
