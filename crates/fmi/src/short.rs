//! Numbers in messages.

/// All digits of a number, with an exponent where it would be long without.
pub fn short(value: f64) -> String {
    /// An exponent is harder to read: so many characters it has to save.
    const WORTH: usize = 4;
    let (plain, power) = (value.to_string(), format!("{value:e}"));
    if plain.len() > power.len() + WORTH { power } else { plain }
}
