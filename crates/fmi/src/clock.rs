//! When two instants are the same: of use to a model that samples.

/// Two instants this close, over the step, are the same: masters add up communication points in
/// different ways, or pass them on as decimal text.
const SAME_INSTANT: f64 = 1e-6;
/// So are two that differ by this, s, as both may have been rounded to nine decimals, unless the step
/// is as short itself.
const ROUNDED: f64 = 1.001e-9;
/// Part of a step that is no rounding in any case.
const LARGEST_SHARE: f64 = 0.25;
/// So are two that are this many roundings apart.
const ROUNDINGS: f64 = 64.0;

/// Whether two instants (s) about a step (s) apart from others are the same. Their halves are compared,
/// as the largest numbers are too far apart.
pub fn same_instant(a: f64, b: f64, step: f64) -> bool {
    let rounding = ROUNDINGS * f64::EPSILON * a.abs().max(b.abs());
    let share = (SAME_INSTANT * step).max(ROUNDED.min(LARGEST_SHARE * step));
    (0.5 * a - 0.5 * b).abs() <= 0.5 * rounding.max(share)
}

/// Instants a period apart.
#[derive(Debug, Clone, Copy)]
pub struct Samples {
    /// Instant of number 0, s.
    pub start: f64,
    /// Distance of the instants, s.
    pub period: f64,
}

impl Samples {
    /// Instant of a number, s.
    pub fn instant(self, number: f64) -> f64 {
        self.start + number * self.period
    }

    /// Number of a time (s): whole if the time is an instant, as two instants are the same.
    pub fn number(self, time: f64) -> f64 {
        let periods = (time - self.start) / self.period;
        let nearest = periods.round();
        if same_instant(self.instant(nearest), time, self.period) { nearest } else { periods }
    }
}
