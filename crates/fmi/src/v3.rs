//! FMI 3.0.2: types, legal order of calls, exported functions.

pub mod abi;
pub mod calls;
mod export;
mod steps;
pub mod sys;
pub mod types;
