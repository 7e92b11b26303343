//! Timing: median, minimum and maximum of repetitions.

use super::Effort;
use serde::Serialize;
use std::time::Instant;

/// Median, minimum and maximum of measurements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    pub median: f64,
    pub least: f64,
    pub largest: f64,
}

impl Spread {
    /// A number that does not vary.
    pub fn exact(value: f64) -> Self {
        Self { median: value, least: value, largest: value }
    }

    /// # Panics
    /// Without measurements.
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let last = values.len() - 1;
        Self { median: values[values.len() / 2], least: values[0], largest: values[last] }
    }

    pub fn scaled(self, factor: f64) -> Self {
        let Self { median, least, largest } = self;
        Self { median: median * factor, least: least * factor, largest: largest * factor }
    }
}

/// Seconds per call; each repetition makes as many calls as fill a batch.
pub fn seconds<T>(effort: &Effort, mut call: impl FnMut() -> T) -> Spread {
    let mut batch = |calls: u32| {
        let started = Instant::now();
        for _ in 0..calls {
            std::hint::black_box(call());
        }
        started.elapsed()
    };
    let once = batch(1).max(std::time::Duration::from_nanos(1));
    let calls = (effort.batch.as_secs_f64() / once.as_secs_f64()).clamp(1.0, 1e6) as u32;
    let repeats = 0..effort.repeats;
    Spread::of(repeats.map(|_| batch(calls).as_secs_f64() / f64::from(calls)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_between_the_extremes() {
        let spread = Spread::of(vec![3.0, 1.0, 2.0, 9.0, 4.0]);
        assert_eq!(spread, Spread { median: 3.0, least: 1.0, largest: 9.0 });
        assert_eq!(spread.scaled(2.0).largest, 18.0);
    }
}
