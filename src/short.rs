//! Numbers in messages.

/// All digits of a number, with an exponent where it would be long without.
pub fn short(value: f64) -> String {
    /// An exponent is harder to read: so many characters it has to save.
    const WORTH: usize = 4;
    let (plain, power) = (value.to_string(), format!("{value:e}"));
    if plain.len() > power.len() + WORTH { power } else { plain }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_stay_short_and_exact() {
        for (value, text) in [
            (25900.0, "25900"),
            (-1.0, "-1"),
            (0.001, "0.001"),
            (1e150, "1e150"),
            (-f64::MAX, "-1.7976931348623157e308"),
            (5e-324, "5e-324"),
            (0.1 + 0.2, "0.30000000000000004"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
