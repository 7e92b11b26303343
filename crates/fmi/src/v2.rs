//! FMI 2.0.5: types, legal order of calls, exported functions.

pub mod abi;
pub mod calls;
mod export;
pub(crate) mod status;
pub mod sys;
