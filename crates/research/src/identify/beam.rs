//! Identification of stiffness and tanks from Table 1 and the short period of Table 2.

mod model;
mod numbers;
mod report;
#[cfg(test)]
mod tests;

pub use model::{Model, printed};
pub use numbers::file;
pub use report::Report;
