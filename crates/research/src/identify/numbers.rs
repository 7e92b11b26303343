//! The adjustable numbers of a coefficient set, their priors, and the file of the adjusted set.

use ahv::data::{AeroData, DataFile, PARKER2007};
use anyhow::{Result, anyhow};
use nalgebra::DVector;
use std::fmt::Write;
use toml::{Table, Value};

/// Prior standard deviation of fit coefficients: about a fifth.
const FIT: f64 = 0.2;
/// Of the inertia: printed and published values differ by a factor of ten, half of that either way.
const INERTIA: f64 = std::f64::consts::LN_10 / 2.0;
/// Of structural damping ratios: a factor of about 1.6.
const STRUCTURE: f64 = 0.5;
/// Of elastic terms from strip theory with one lift slope: a factor of two.
const ELASTIC: f64 = std::f64::consts::LN_2;

/// Of the mass centre about the printed 55 ft: a twentieth of the length, m.
const BALANCE: f64 = 1.524;

/// Numbers adjusted by a difference; the others by a ratio.
pub const MASS_CENTRE: &str = "inertia.mass_centre_shift_m";
pub const GAMMA_OFFSET: &str = "reference.gamma_offset_m";

pub fn moves_by_difference(key: &str) -> bool {
    [MASS_CENTRE, GAMMA_OFFSET].contains(&key)
}

/// Adjustable numbers with prior standard deviations of the natural logarithm of the ratio, or of the difference.
pub const MOVABLE: [(&str, f64); 27] = [
    ("reference.elastic_scale", ELASTIC),
    ("inertia.i_yy_kg_m2_per_m", INERTIA),
    (MASS_CENTRE, BALANCE),
    (GAMMA_OFFSET, BALANCE),
    ("inertia.structural_damping.0", STRUCTURE),
    ("inertia.structural_damping.1", STRUCTURE),
    ("inertia.structural_damping.2", STRUCTURE),
    ("lift.constant", FIT),
    ("lift.alpha", FIT),
    ("lift.delta_e", FIT),
    ("drag.constant", FIT),
    ("drag.alpha", FIT),
    ("drag.alpha2", FIT),
    ("drag.delta_e", FIT),
    ("drag.delta_e2", FIT),
    ("moment.constant", FIT),
    ("moment.alpha", FIT),
    ("moment.alpha2", FIT),
    ("moment.delta_e", FIT),
    ("thrust.constant", FIT),
    ("thrust.alpha", FIT),
    ("thrust.alpha2", FIT),
    ("thrust.alpha3", FIT),
    ("thrust_phi.constant", FIT),
    ("thrust_phi.alpha", FIT),
    ("thrust_phi.alpha2", FIT),
    ("thrust_phi.alpha3", FIT),
];

/// Significant digits of a written number; more than the data determine.
const DIGITS: usize = 5;

/// The published set, which is adjusted.
#[derive(Debug, Clone)]
pub struct Origin {
    table: Table,
}

/// The number of a key: `table.entry` or `table.entry.index`.
fn number<'a>(table: &'a mut Table, key: &str) -> Option<&'a mut f64> {
    let mut parts = key.split('.');
    let entry = table.get_mut(parts.next()?)?.get_mut(parts.next()?)?;
    let value = entry.get_mut("value")?;
    let value = match parts.next() {
        Some(index) => value.get_mut(index.parse::<usize>().ok()?)?,
        None => value,
    };
    match value {
        Value::Float(number) => Some(number),
        _ => None,
    }
}

impl Origin {
    pub fn new() -> Result<Self> {
        let mut origin = Self { table: PARKER2007.text.parse()? };
        for (key, _) in MOVABLE {
            number(&mut origin.table, key).ok_or_else(|| anyhow!("parker2007.toml: no {key}"))?;
        }
        Ok(origin)
    }

    /// The set at a point.
    pub fn moved(&self, point: &DVector<f64>) -> Option<AeroData> {
        let mut text = String::new();
        for (name, entries) in &self.with(point) {
            writeln!(text, "[{name}]").ok()?;
            for (key, number) in entries.as_table()? {
                writeln!(text, "{key} = {number}").ok()?;
            }
        }
        AeroData::parse("moved", &text).ok()
    }

    fn with(&self, point: &DVector<f64>) -> Table {
        let mut table = self.table.clone();
        for ((key, doubt), x) in MOVABLE.into_iter().zip(point) {
            if let Some(value) = number(&mut table, key) {
                *value = if moves_by_difference(key) {
                    *value + doubt * x
                } else {
                    *value * libm::exp(doubt * x)
                };
            }
        }
        table
    }

    /// Published and adjusted values in the order of [`MOVABLE`], as written.
    pub fn values(&self, point: &DVector<f64>) -> Vec<[f64; 2]> {
        let (mut from, mut to) = (self.table.clone(), self.with(point));
        let pair = |(key, _)| {
            let old = number(&mut from, key).copied()?;
            let new = number(&mut to, key).copied()?;
            Some([old, if new == old { old } else { rounded(new) }])
        };
        MOVABLE.into_iter().filter_map(pair).collect()
    }

    /// The file of the adjusted set: that of the published one with changed lines.
    pub fn file(&self, point: &DVector<f64>) -> Result<String> {
        let values = self.values(point);
        let mut text = HEADER.to_string();
        let mut section = String::new();
        for line in PARKER2007.text.lines().skip_while(|line| line.starts_with('#')) {
            if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                section = name.to_string();
            }
            let key = line.split(" = ").next().unwrap_or_default();
            let entry = format!("{section}.{key}");
            // One number, or the elements of a list.
            let parts: Vec<_> = MOVABLE
                .into_iter()
                .zip(&values)
                .filter(|((name, _), _)| *name == entry || name.starts_with(&format!("{entry}.")))
                .map(|(_, value)| *value)
                .collect();
            if parts.iter().all(|[old, new]| old == new) {
                writeln!(text, "{line}")?;
                continue;
            }
            let unit = self.table[&section][key]["unit"].as_str().unwrap_or_default();
            let how = if moves_by_difference(&entry) { "plus" } else { "times" };
            let factors: Vec<_> =
                parts.iter().map(|[old, new]| written_move(&entry, [*old, *new])).collect();
            let numbers: Vec<_> = parts.iter().map(|[_, new]| format!("{new:?}")).collect();
            let list = numbers.join(", ");
            let value = if parts.len() > 1 { format!("[{list}]") } else { list };
            writeln!(
                text,
                "{key} = {{ value = {value}, unit = \"{unit}\", source = \"parker2007 {how} {}: \
                 towards Tables 2 and 3, cargo ahv identify xu2015\", status = \"identified\" }}",
                factors.join(", "),
            )?;
        }
        Ok(text)
    }
}

const HEADER: &str = "\
# Curve fits of eq. (4): parker2007, changed as little as possible to approach Tables 2 and 3 of the paper.
# Written by `cargo ahv identify xu2015`, which prints norm, misfit and trade-off; do not edit.
# The source of each changed number states its change; the others are those of parker2007.
";

/// The change of a number: a factor, or a difference in its unit.
pub fn written_move(key: &str, [old, new]: [f64; 2]) -> String {
    if moves_by_difference(key) { format!("{:.4}", new - old) } else { format!("{:.4}", new / old) }
}

/// Whether a coordinate changes its number by less than a fraction of it, or of its standard deviation.
pub fn hardly_moves(i: usize, x: f64, least: f64) -> bool {
    let (key, doubt) = MOVABLE[i];
    if moves_by_difference(key) { x.abs() < least } else { (doubt * x).abs() < libm::log1p(least) }
}

/// Rounds to the written digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_that_does_not_move_is_the_published_one() {
        let origin = Origin::new().unwrap();
        let text = origin.file(&DVector::zeros(MOVABLE.len())).unwrap();
        let body = |text: &str| text.lines().skip_while(|l| l.starts_with('#')).collect::<String>();
        assert_eq!(body(&text), body(PARKER2007.text));
    }

    #[test]
    fn a_moved_number_is_identified_and_says_by_how_much() {
        let origin = Origin::new().unwrap();
        let mut point = DVector::zeros(MOVABLE.len());
        point[5] = libm::log(2.0) / MOVABLE[5].1;
        let text = origin.file(&point).unwrap();
        let line = text.lines().find(|line| line.starts_with("structural_damping")).unwrap();
        assert!(line.contains("[0.02, 0.04, 0.02]"), "{line}");
        assert!(line.contains("times 1.0000, 2.0000, 1.0000"), "{line}");
        assert_eq!(text.matches("identified").count(), 1);
        assert!(AeroData::parse("moved.toml", &text).is_ok());
    }
}
