//! Stiffness and tanks from Table 1.

mod model;
mod numbers;

pub use model::{Model, printed};
pub use numbers::file;
