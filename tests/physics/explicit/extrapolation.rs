//! Integration of an order that leaves nothing to ask.

/// Columns of the extrapolation: order 16.
const COLUMNS: usize = 8;

/// A step by extrapolation of the explicit midpoint rule (Gragg, Bulirsch, Stoer).
pub fn extrapolated<const N: usize>(
    x: &[f64; N],
    step: f64,
    f: impl Fn(&[f64; N]) -> [f64; N],
) -> [f64; N] {
    let mut row: Vec<[f64; N]> = Vec::new();
    for column in 0..COLUMNS {
        let count = |column: usize| 2.0 * (column + 1) as f64;
        let h = step / count(column);
        let moved = |from: &[f64; N], h: f64, rates: &[f64; N]| -> [f64; N] {
            std::array::from_fn(|i| from[i] + h * rates[i])
        };
        let (mut before, mut now) = (*x, moved(x, h, &f(x)));
        for _ in 1..2 * (column + 1) {
            let next = moved(&before, 2.0 * h, &f(&now));
            (before, now) = (now, next);
        }
        // Aitken and Neville, in the square of the step.
        let mut next = vec![now];
        for (k, former) in row.iter().enumerate() {
            let ratio = (count(column) / count(column - 1 - k)).powi(2) - 1.0;
            let last = next[k];
            next.push(std::array::from_fn(|i| last[i] + (last[i] - former[i]) / ratio));
        }
        row = next;
    }
    row[COLUMNS - 1]
}
