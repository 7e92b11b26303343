//! Drawings of the report.

mod axes;
pub mod loci;
mod marker;
pub mod shapes;
pub mod tradeoff;
pub mod veering;
