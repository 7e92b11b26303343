//! A number with its unit and its origin.

use serde::{Deserialize, Serialize};

/// How far a number can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Printed in the source.
    Published,
    /// Published, in other units.
    Converted,
    /// Follows from published numbers.
    Derived,
    /// Fitted so that published results come out.
    Identified,
    /// A plausible choice of ours.
    Assumed,
}

/// A number, or a list of numbers, with its origin.
#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity<T = f64> {
    /// The number, in `unit`.
    pub value: T,
    /// Unit, as text; agrees with the suffix of the key.
    pub unit: Box<str>,
    /// Where the number comes from.
    pub source: Box<str>,
    /// How far it can be trusted.
    pub status: Status,
}
