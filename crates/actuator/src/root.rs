//! Roots of monotonic functions.

/// The root of a monotonic function between `a` and `b`, where its signs differ, to rounding: Newton's method, kept inside
/// the bracket by halving it. `f` gives value and slope.
pub fn root(mut a: f64, mut b: f64, f: impl Fn(f64) -> [f64; 2]) -> f64 {
    let rising = f(b)[0] > 0.0;
    let (mut x, mut step) = (0.5 * (a + b), b - a);
    // Halving alone would need no more than one for each bit of a number, and of its exponent.
    for _ in 0..1100 {
        let [value, slope] = f(x);
        if value == 0.0 {
            break;
        }
        if (value > 0.0) == rising {
            b = x;
        } else {
            a = x;
        }
        // Newton's step is taken if it at least halves the last one. A divisor is never zero, nor is it speculated to be.
        let halves = 2.0 * value.abs() < (slope * step).abs();
        let newton = x - value / if halves { slope } else { 1.0 };
        let next = if halves && a < newton && newton < b { newton } else { 0.5 * (a + b) };
        step = next - x;
        if step.abs() <= f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}
