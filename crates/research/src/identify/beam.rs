//! Stiffness and tanks from Table 1.

mod model;
mod numbers;
mod report;
#[cfg(test)]
mod tests;

pub use model::{Model, printed};
pub use numbers::file;
pub use report::Report;
