//! The law: designs for sampling periods and levels of fuel.

use crate::error::Error;
use crate::gains::{Gains, lerp, mix, place};
use crate::written::File;
use fmi_model::identity::fnv;
use fmi_model::location;
use std::path::Path;
use std::sync::Arc;

/// States of a design model at most.
pub const MOST_STATES: usize = 16;
/// Measurements: V (m/s), gamma (rad), q (rad/s).
pub const MEASURED: usize = 3;
/// Commands: delta_e (rad), phi.
pub const COMMANDS: usize = 2;
/// What is commanded, and the first two states of every design model: V and gamma.
pub const WANTED: usize = 2;

/// Sampling periods, s.
pub(crate) const SHORTEST_PERIOD_S: f64 = 1e-9;
pub(crate) const LONGEST_PERIOD_S: f64 = 10.0;

/// The file in the resources of the FMU.
pub const FILE: &str = "law.json";
/// Its size limit: ours has 0.1 MB.
const MOST_BYTES: u64 = 4_000_000;
/// The law that is built in.
pub const BUILT_IN: &str = include_str!("../law.json");

/// One design.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Sampling period, s.
    pub period_s: f64,
    /// Fuel that it is for, as a part of full tanks.
    pub fuel_fraction: f64,
    /// Fuel that it is for, kg per metre of width.
    pub fuel_mass_kg_per_m: f64,
    /// Measurements in level flight.
    pub level: [f64; MEASURED],
    /// Commands in level flight.
    pub trim: [f64; COMMANDS],
    /// Smallest commands, absolute.
    pub lowest: [f64; COMMANDS],
    /// Largest commands, absolute.
    pub highest: [f64; COMMANDS],
    /// Limit of the speed error that is acted on, m/s.
    pub speed_error_m_per_s: f64,
    /// The gains.
    pub gains: Gains,
}

impl Design {
    /// The design for a fuel fraction.
    pub fn at(designs: &[Self], fuel_fraction: f64) -> Self {
        let (before, next, part) = place(designs, |design| design.fuel_fraction, fuel_fraction);
        let fuel_mass_kg_per_m = lerp(before.fuel_mass_kg_per_m, next.fuel_mass_kg_per_m, part);
        let (mut level, mut trim) = (before.level, before.trim);
        mix(&mut level, &next.level, part);
        mix(&mut trim, &next.trim, part);
        let gains = Self::gains_at(designs, fuel_mass_kg_per_m);
        Self { fuel_fraction, fuel_mass_kg_per_m, level, trim, gains, ..*before }
    }

    /// Gains for a fuel mass, kg per metre of width.
    pub fn gains_at(designs: &[Self], fuel_mass_kg_per_m: f64) -> Gains {
        let mass = |design: &Self| design.fuel_mass_kg_per_m;
        let (before, next, part) = place(designs, mass, fuel_mass_kg_per_m);
        let mut gains = before.gains.clone();
        gains.move_to(&next.gains, part);
        gains
    }
}

/// Designs for one or several sampling periods, each for one or several levels of fuel.
#[derive(Debug, Clone)]
pub struct Law {
    /// By period as in the file, by fuel in growing order; running autopilots share them.
    designs: Vec<Arc<[Design]>>,
    /// Hash of the file.
    pub hash: u128,
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        self.hash == other.hash
    }
}

impl Law {
    /// Reads the file in a folder.
    ///
    /// # Errors
    /// [`Error::Unreadable`] and those of [`Law::parse`].
    pub fn in_folder(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(FILE);
        let text = location::text(&path, MOST_BYTES)
            .map_err(|error| Error::Unreadable { path, why: error.to_string() })?;
        Self::parse(&text)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`Error::Format`], [`Error::Design`].
    pub fn parse(text: &str) -> Result<Self, Error> {
        // Some editors begin a file with a byte order mark.
        let text = text.trim_start_matches('\u{feff}');
        let file: File =
            serde_json::from_str(text).map_err(|error| Error::Format { why: error.to_string() })?;
        if file.designs.is_empty() {
            return Err(Error::Format { why: "there is no design".to_string() });
        }
        let designs: Result<Vec<_>, _> =
            file.designs.iter().enumerate().map(|(i, written)| written.design(i + 1)).collect();
        let designs = designs?;
        for (i, pair) in designs.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            let [states, before] = [i + 1, i].map(|design| file.designs[design].states());
            if a.period_s == b.period_s && states != before {
                let problem = format!("has {states} rows; the design before has {before}");
                return Err(Error::Design { design: i + 2, key: "A", problem });
            }
            let problem = if a.period_s != b.period_s {
                match designs[..=i].iter().any(|design| design.period_s == b.period_s) {
                    true => {
                        format!("= {} s: designs for one period must follow each other", b.period_s)
                    }
                    false => continue,
                }
            } else if b.fuel_mass_kg_per_m > a.fuel_mass_kg_per_m
                && b.fuel_fraction > a.fuel_fraction
            {
                continue;
            } else {
                format!(
                    "= {} kg/m must grow, as must fuel_fraction; the design before has {}",
                    b.fuel_mass_kg_per_m, a.fuel_mass_kg_per_m
                )
            };
            let key = if a.period_s == b.period_s { "fuel_mass_kg_per_m" } else { "period_s" };
            return Err(Error::Design { design: i + 2, key, problem });
        }
        let designs = designs.chunk_by(|a, b| a.period_s == b.period_s).map(Arc::from).collect();
        Ok(Self { designs, hash: fnv(0, text.as_bytes()) })
    }

    /// Designs for a period (s), by growing fuel; for 0 those of the first period in the file.
    ///
    /// # Errors
    /// [`Error::Period`].
    pub fn designs(&self, period_s: f64) -> Result<&Arc<[Design]>, Error> {
        let known_s = self.designs.iter().map(|designs| designs[0].period_s);
        let same = |known_s| period_s == 0.0 || known_s == period_s;
        match known_s.clone().position(same) {
            Some(number) => Ok(&self.designs[number]),
            None => Err(Error::Period { period_s, known_s: known_s.collect() }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_law_is_valid() {
        let law = Law::parse(BUILT_IN).unwrap();
        let designs = law.designs(0.0).unwrap();
        assert_eq!(law.designs.len(), 1);
        assert_eq!(designs[0].fuel_fraction, 0.0);
        assert_eq!(designs[designs.len() - 1].fuel_fraction, 1.0);
    }
}
