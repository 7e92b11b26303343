//! Reads and checks the printed tables; a wrong number is refused with file, key and limit.

use ahv::error::Error;
use ahv::structure::FLEXIBLE;
use serde::Deserialize;

const PUBLISHED_TOML: &str = include_str!("../../../src/data/published.toml");

/// `published.toml`, rad/s.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    pub table1: Table1,
    pub table2: Columns<Poles>,
    pub table3: Columns<Zeros>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table1 {
    pub even: [f64; FLEXIBLE],
    pub slosh: [f64; FLEXIBLE],
}

/// One entry per configuration.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Columns<T> {
    pub rigid: T,
    pub even: T,
    pub slosh: T,
}

/// Pairs are real and imaginary part.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Poles {
    pub long_term: [f64; 2],
    pub short_term: [f64; 2],
    pub height: f64,
    #[serde(default)]
    pub aeroelastic: Vec<[f64; 2]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zeros {
    pub real: [f64; 3],
    #[serde(default)]
    pub aeroelastic: Vec<[f64; 2]>,
}

impl<T> Columns<T> {
    /// In the order of the configurations.
    pub fn all(&self) -> [&T; 3] {
        [&self.rigid, &self.even, &self.slosh]
    }

    fn named(&self, table: &str) -> [(String, &T); 3] {
        let [rigid, even, slosh] = self.all();
        [("rigid", rigid), ("even", even), ("slosh", slosh)]
            .map(|(name, column)| (format!("{table}.{name}"), column))
    }
}

/// The checks of one file; the first wrong number is reported.
struct Check<'a> {
    file: &'a str,
}

impl Check<'_> {
    fn that(&self, ok: bool, key: &str, problem: impl FnOnce() -> String) -> Result<(), Error> {
        if ok {
            return Ok(());
        }
        Err(Error::Data { file: self.file.into(), key: key.into(), problem: problem() })
    }

    fn positive(&self, key: &str, value: f64) -> Result<(), Error> {
        let ok = value > 0.0 && value.is_finite();
        self.that(ok, key, || format!("{value} rad/s must be positive"))
    }

    fn negative(&self, key: &str, value: f64) -> Result<(), Error> {
        let ok = value < 0.0 && value.is_finite();
        self.that(ok, key, || format!("{value} rad/s must be negative"))
    }

    /// A number with a relative error: finite and not zero.
    fn finite(&self, key: &str, value: f64) -> Result<(), Error> {
        let ok = value != 0.0 && value.is_finite();
        self.that(ok, key, || format!("{value} rad/s must be finite and not 0"))
    }

    fn rising(&self, key: &str, values: &[f64]) -> Result<(), Error> {
        values.iter().try_for_each(|value| self.positive(key, *value))?;
        let ok = values.windows(2).all(|pair| pair[0] < pair[1]);
        self.that(ok, key, || format!("{values:?} rad/s must rise"))
    }

    /// Damped pairs, one per mode; a rigid body has none.
    fn pairs(&self, column: &str, pairs: &[[f64; 2]]) -> Result<(), Error> {
        let key = &format!("{column}.aeroelastic");
        let count = if column.ends_with("rigid") { 0 } else { FLEXIBLE };
        self.that(pairs.len() == count, key, || format!("{} pairs, must be {count}", pairs.len()))?;
        pairs.iter().try_for_each(|[decay, _]| self.negative(key, *decay))?;
        let frequencies: Vec<_> = pairs.iter().map(|[_, omega]| *omega).collect();
        self.rising(key, &frequencies)
    }
}

impl Published {
    /// The file that the tool was built with.
    pub fn embedded() -> Result<Self, Error> {
        Self::parse("published.toml", PUBLISHED_TOML)
    }

    /// Reads and checks a file; `file` is its name for messages.
    pub fn parse(file: &str, text: &str) -> Result<Self, Error> {
        let all: Self = toml::from_str(text).map_err(|error| {
            let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or("");
            // A missing cell is reported at the line of its table.
            let line = before.matches('\n').count();
            let source = text.lines().nth(line).unwrap_or("").trim();
            Error::Data {
                file: file.into(),
                key: format!("line {}, `{source}`", line + 1),
                problem: error.message().to_string(),
            }
        })?;
        let check = Check { file };
        check.rising("table1.even", &all.table1.even)?;
        check.rising("table1.slosh", &all.table1.slosh)?;
        for (column, poles) in all.table2.named("table2") {
            let [decay, omega] = poles.long_term;
            let [unstable, stable] = poles.short_term;
            check.finite(&format!("{column}.long_term"), decay)?;
            check.positive(&format!("{column}.long_term"), omega)?;
            check.positive(&format!("{column}.short_term"), unstable)?;
            check.negative(&format!("{column}.short_term"), stable)?;
            check.finite(&format!("{column}.height"), poles.height)?;
            check.pairs(&column, &poles.aeroelastic)?;
        }
        for (column, zeros) in all.table3.named("table3") {
            let key = &format!("{column}.real");
            let [right, left, origin] = zeros.real;
            check.positive(key, right)?;
            check.negative(key, left)?;
            check.that(origin == 0.0, key, || format!("{origin} rad/s must be 0"))?;
            check.pairs(&column, &zeros.aeroelastic)?;
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_cell_is_refused_with_file_key_and_limit() {
        for (from, to, told) in [
            ("slosh = [23.34,", "slosh = [-23.34,", "table1.slosh: -23.34 rad/s must be positive"),
            ("even = [19.72,", "even = [nan,", "table1.even: NaN rad/s must be positive"),
            ("even = [19.72, 45.37", "even = [45.37, 19.72", "rad/s must rise"),
            ("even = [19.72, 45.37, 96.48]", "even = [19.72, 45.37]", "line 5, `even = "),
            ("slosh = [23.34, 54.15, 108.23]\n", "", "line 4, `[table1]`: missing field `slosh`"),
            ("height = -2.185e-4\n", "", "`[table2.even]`: missing field `height`"),
            ("height = -2.143e-4", "height = inf", "table2.slosh.height: inf rad/s must be finite"),
            (
                "[4.561, -4.63]",
                "[-4.561, -4.63]",
                "table2.even.short_term: -4.561 rad/s must be po",
            ),
            (
                "[4.561, -4.63]",
                "[4.561, nan]",
                "table2.even.short_term: NaN rad/s must be negative",
            ),
            (
                "[-0.329, 23.78]",
                "[0.329, 23.78]",
                "table2.slosh.aeroelastic: 0.329 rad/s must be n",
            ),
            ("[-0.329, 23.78], ", "", "table2.slosh.aeroelastic: 2 pairs, must be 3"),
            ("[5.2492, -7.0463, 0.0]", "[5.2492, 7.0463, 0.0]", "table3.even.real: 7.0463 rad/s"),
            (
                "[5.2492, -7.0463, 0.0]",
                "[5.2492, -7.0463, 1.0]",
                "table3.even.real: 1 rad/s must be 0",
            ),
            ("height = -2.491e-4", "hight = -2.491e-4", "unknown field `hight`"),
            ("height = -2.491e-4", "height = \"small\"", "`height = \"small\"`: invalid type"),
        ] {
            assert!(PUBLISHED_TOML.contains(from), "{from} is not in the file");
            let text = PUBLISHED_TOML.replacen(from, to, 1);
            let message = Published::parse("mine.toml", &text).expect_err(to).to_string();
            assert!(message.starts_with("mine.toml: ") && message.contains(told), "{message}");
        }
    }
}
