//! When inputs that move meet their limits.

use super::inputs::{INPUTS, Inputs};
use crate::vehicle::{Control, MAX_GUST_M_PER_S, Vehicle};
use std::iter::once;

impl Inputs {
    /// The first time (s) in the next step after `from` and before `to` from which on an input is beyond a limit of
    /// its range, or within again; `to` if there is none.
    pub(super) fn next_limit(&self, ranges: &[[f64; 2]; INPUTS], from: f64, to: f64) -> f64 {
        let mut first = to;
        for (i, range) in ranges.iter().enumerate() {
            if self.may_leave(i, range, to) {
                for limit in range {
                    first = self.passes(i, *limit, from, first);
                }
            }
        }
        first
    }

    /// Whether an input that moves may be outside its range within a time (s): it moves no further than the sum
    /// of what its derivatives do.
    fn may_leave(&self, i: usize, [least, largest]: &[f64; 2], t: f64) -> bool {
        let [a, b, c] = self.derivatives.map(|order| order[i].abs());
        let reach = t * (a + t / 2.0 * (b + t / 3.0 * c));
        reach > 0.0 && (self.values[i] - reach < *least || self.values[i] + reach > *largest)
    }

    /// The first time after `from` at which an input has passed a limit, or `to`.
    fn passes(&self, i: usize, limit: f64, from: f64, to: f64) -> f64 {
        let [a, b, c] = self.derivatives.map(|order| order[i]);
        let bends = changes(|t| b + t * c > 0.0, from, once(to)).chain(once(to));
        let turns = changes(|t| a + t * (b + t / 2.0 * c) > 0.0, from, bends).chain(once(to));
        changes(|t| self.at(t)[i] > limit, from, turns).next().unwrap_or(to)
    }
}

/// Ranges of the inputs that are added to `base`.
pub(super) fn ranges(vehicle: &Vehicle, base: &Control) -> [[f64; 2]; INPUTS] {
    let gust = [-MAX_GUST_M_PER_S, MAX_GUST_M_PER_S];
    let [delta_e, phi] = vehicle.control_ranges();
    [delta_e.map(|limit| limit - base[0]), phi.map(|limit| limit - base[1]), gust, gust]
}

/// When a condition changes that changes once at most before each of the `ends` and after the one before, the first time
/// after `from`. By bisection: no quotient or root of any derivatives is a floating-point exception.
fn changes(
    is: impl Fn(f64) -> bool,
    from: f64,
    ends: impl Iterator<Item = f64>,
) -> impl Iterator<Item = f64> {
    let mut low = from;
    ends.filter_map(move |high| {
        let start = std::mem::replace(&mut low, high);
        let before = is(start);
        (is(high) != before).then(|| bisect(|t| is(t) != before, start, high))
    })
}

/// The first number in `low` to `high` from which `holds` is true; it is at `high` and not at `low`.
fn bisect(holds: impl Fn(f64) -> bool, mut low: f64, mut high: f64) -> f64 {
    let rounding = f64::EPSILON * high;
    while high - low > rounding {
        let middle = low + 0.5 * (high - low);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const RANGES: [[f64; 2]; INPUTS] = [[-1.0, 1.0]; INPUTS];

    /// Rounding blurs an instant by less than this (s).
    const BLUR_S: f64 = 1e-9;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn between_limits_no_input_passes_one(
            values in prop::array::uniform4(-1.5..1.5_f64),
            first in prop::array::uniform4(-30.0..30.0_f64),
            second in prop::array::uniform4(-200.0..200.0_f64),
            third in prop::array::uniform4(prop_oneof![Just(0.0), -2000.0..2000.0_f64]),
        ) {
            let inputs = Inputs { values, derivatives: [first, second, third], ahead: true };
            let sides = |t: f64| inputs.at(t).map(|x| RANGES[0].map(|limit| x > limit));
            let (mut from, mut passed) = (0.0, 0);
            while from < 1.0 {
                let to = inputs.next_limit(&RANGES, from, 1.0);
                let before = to - BLUR_S;
                for part in (0..100).map(|k| from + (before - from) * f64::from(k) / 99.0) {
                    prop_assert!(part >= to || sides(part) == sides(from), "{part} in {from} to {to}");
                }
                prop_assert!(to == 1.0 || sides(to) != sides(from));
                passed += 1;
                from = to;
            }
            // Each cubic passes each of its two limits three times at most.
            prop_assert!(passed <= 6 * INPUTS + 1);
        }
    }
}
