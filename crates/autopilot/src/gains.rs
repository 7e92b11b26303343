//! The matrices that a sample multiplies, and where they are between designs.

use crate::law::{COMMANDS, MEASURED, MOST_STATES, WANTED};

/// Columns of the filter: states, commands in force, measurements.
pub const FILTER_COLUMNS: usize = MOST_STATES + COMMANDS + MEASURED;
/// Columns of the feedback: states, integrals of the errors.
pub const FEEDBACK_COLUMNS: usize = MOST_STATES + WANTED;

/// Gains for one level of fuel: matrices by columns, with zeros up to [`MOST_STATES`].
#[derive(Debug, Clone, PartialEq)]
pub struct Gains {
    /// x' = filter [x; u; y - level] with the estimate x: (A - L C | B | L).
    pub filter: [[f64; MOST_STATES]; FILTER_COLUMNS],
    /// What x lets expect of y - level: C.
    pub measurement: [[f64; MEASURED]; MOST_STATES],
    /// u = -feedback [x' - wanted; integrals]: (K | Ki).
    pub feedback: [[f64; COMMANDS]; FEEDBACK_COLUMNS],
}

impl Gains {
    /// Moves on to other gains: 0 stays, 1 gets there.
    pub fn move_to(&mut self, other: &Self, part: f64) {
        mix(self.filter.as_flattened_mut(), other.filter.as_flattened(), part);
        mix(self.measurement.as_flattened_mut(), other.measurement.as_flattened(), part);
        mix(self.feedback.as_flattened_mut(), other.feedback.as_flattened(), part);
    }
}

/// Moves numbers on to others: 0 stays, 1 gets there.
pub fn mix(own: &mut [f64], others: &[f64], part: f64) {
    for (own, other) in own.iter_mut().zip(others) {
        *own = lerp(*own, *other, part);
    }
}

/// A number between two: 0 is the first, 1 the second.
pub fn lerp(first: f64, second: f64, part: f64) -> f64 {
    (1.0 - part) * first + part * second
}

/// The neighbours of a value in an ordered list, and how far it is from the first (0) to the second (1); beyond
/// the ends the last one twice.
pub fn place<T>(ordered: &[T], of: impl Fn(&T) -> f64, value: f64) -> (&T, &T, f64) {
    let after = ordered.partition_point(|item| of(item) <= value);
    let (before, next) =
        (&ordered[after.saturating_sub(1)], &ordered[after.min(ordered.len() - 1)]);
    let span = of(next) - of(before);
    (before, next, if span > 0.0 { (value - of(before)) / span } else { 0.0 })
}
