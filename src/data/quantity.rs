//! A number of a data file.

/// A number, or a list of numbers. Its unit is the suffix of its key; source and status are in the file.
#[derive(Debug, Clone)]
pub struct Quantity<T = f64> {
    /// The number.
    pub value: T,
}
