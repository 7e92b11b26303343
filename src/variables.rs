//! The one table of what a simulation master sees: value reference = row, append only.

mod table;
mod vocabulary;

pub use table::TABLE;
