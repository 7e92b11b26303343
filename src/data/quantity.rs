//! A number with its unit and its origin.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

/// Reliability of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Printed in the source.
    Published,
    /// Published in other units.
    Converted,
    /// Derived from published numbers.
    Derived,
    /// Fitted to published results.
    Identified,
    /// A plausible assumption.
    Assumed,
}

/// Unit and origin of a number.
#[derive(Debug)]
pub struct Origin {
    /// Unit, as text; agrees with the suffix of the key.
    pub unit: String,
    /// Where the number comes from.
    pub source: String,
    /// Reliability.
    pub status: Status,
}

/// A number, or a list of numbers. The library carries the numbers alone; read from TOML they have
/// their origin.
#[derive(Debug, Clone)]
pub struct Quantity<T = f64> {
    /// The number.
    pub value: T,
    /// Unit and origin, if read from TOML.
    pub origin: Option<Arc<Origin>>,
}

/// A quantity in a TOML file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry<T> {
    value: T,
    unit: String,
    source: String,
    status: Status,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Quantity<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if !deserializer.is_human_readable() {
            return Ok(Self { value: T::deserialize(deserializer)?, origin: None });
        }
        let Entry { value, unit, source, status } = Entry::deserialize(deserializer)?;
        Ok(Self { value, origin: Some(Arc::new(Origin { unit, source, status })) })
    }
}

/// The number alone, for the library.
impl<T: Serialize> Serialize for Quantity<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}
