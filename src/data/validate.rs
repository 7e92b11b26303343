//! Checks the data files as a whole; errors give file, key, value and limit.

use super::embedded::Embedded;
use super::files::{AeroData, EarthData, VehicleData};
use super::reader::{self, Entry, Problem};
use crate::error::Error;
use crate::short::short;

/// Tolerance of the sum of the tanks' shares.
const SHARES_TOLERANCE: f64 = 1e-9;
/// Limit of stations in the stiffness table, that of elements.
const MAX_STATIONS: usize = 2000;

/// Limit of layers of the atmosphere; the standard has seven below 84.852 km.
pub const MAX_LAYERS: usize = 8;

/// A data file that can be read and checked.
pub trait DataFile: Entry {
    /// Reads and checks TOML text; `file` is its name for messages.
    ///
    /// # Errors
    /// [`Error::Data`] with the key or the line, the value and the limit.
    fn parse(file: &str, text: &str) -> Result<Self, Error> {
        Ok(Self::parse_and_pack(file, text)?.0)
    }

    /// The same, with the packed form: the numbers without comments, units and sources.
    ///
    /// # Errors
    /// Those of [`DataFile::parse`].
    fn parse_and_pack(file: &str, text: &str) -> Result<(Self, Vec<u8>), Error> {
        let (data, packed): (Self, _) =
            reader::parse(text).map_err(|problem| wrong(file, problem))?;
        data.check(&Check { file })?;
        Ok((data, packed))
    }

    /// Reads and checks a file in the form in which the library has it.
    ///
    /// # Errors
    /// [`Error::Data`] with the key, the value and the limit.
    fn unpack(file: &str, packed: &[u8]) -> Result<Self, Error> {
        let data: Self = reader::unpack(packed).map_err(|problem| wrong(file, problem))?;
        data.check(&Check { file })?;
        Ok(data)
    }

    /// A file of the library.
    ///
    /// # Errors
    /// Those of [`DataFile::unpack`].
    fn embedded(file: &Embedded) -> Result<Self, Error> {
        Self::unpack(file.name, file.packed)
    }

    /// Checks relations between numbers.
    ///
    /// # Errors
    /// [`Error::Data`] with the key, the value and the limit.
    fn check(&self, check: &Check) -> Result<(), Error>;
}

fn wrong(file: &str, Problem { key, problem }: Problem) -> Error {
    Error::Data { file: file.to_string(), key, problem }
}

/// Checks of one file.
#[derive(Debug)]
pub struct Check<'a> {
    file: &'a str,
}

impl Check<'_> {
    fn that(&self, ok: bool, key: &str, problem: impl FnOnce() -> String) -> Result<(), Error> {
        if ok {
            return Ok(());
        }
        Err(Error::Data { file: self.file.into(), key: key.into(), problem: problem() })
    }

    fn inside(&self, key: &str, value: f64, [min, max]: [f64; 2]) -> Result<(), Error> {
        self.that(value > min && value < max, key, || {
            let [value, min, max] = [value, min, max].map(short);
            format!("{value} must lie between {min} and {max}")
        })
    }

    fn increasing(&self, key: &str, values: &[f64]) -> Result<(), Error> {
        let ok = !values.is_empty() && values.windows(2).all(|pair| pair[0] < pair[1]);
        self.that(ok, key, || format!("{values:?} must increase"))
    }
}

impl DataFile for VehicleData {
    fn check(&self, check: &Check) -> Result<(), Error> {
        let length = self.geometry.length_m.value;
        let fore_body = self.geometry.fore_body_m.value;
        let inside = |key: &str, value: f64| check.inside(key, value, [0.0, length]);
        inside("geometry.fore_body_m", fore_body)?;
        let nacelle = self.geometry.nacelle_m.value;
        check.inside("geometry.nacelle_m", nacelle, [0.0, length - fore_body])?;
        inside("mass.beam_joint_m", self.mass.beam_joint_m.value)?;
        inside("outline.elevator_station_m", self.outline.elevator_station_m.value)?;
        for (key, fraction) in [
            ("mass.propellant_fraction", &self.mass.propellant_fraction),
            ("mass.residual_fraction", &self.mass.residual_fraction),
        ] {
            check.inside(key, fraction.value, [0.0, 1.0])?;
        }
        for (key, station) in [
            ("default.imu_station_m", &self.default.imu_station_m),
            ("default.probe_station_m", &self.default.probe_station_m),
        ] {
            check.that((0.0..=length).contains(&station.value), key, || {
                format!("{} must lie in [0, {}]", short(station.value), short(length))
            })?;
        }
        self.check_beam(check, length)?;
        self.check_tanks(check, length)
    }
}

impl VehicleData {
    fn check_beam(&self, check: &Check, length: f64) -> Result<(), Error> {
        let stations = &self.beam.stiffness_station_m.value;
        let stiffness = &self.beam.stiffness_n_m2_per_m.value;
        check.increasing("beam.stiffness_station_m", stations)?;
        let ends = [stations[0], stations[stations.len() - 1]];
        check.that(ends == [0.0, length], "beam.stiffness_station_m", || {
            format!("the stations run from {} to {}, must run from 0 to {length}", ends[0], ends[1])
        })?;
        check.that(stiffness.len() == stations.len(), "beam.stiffness_n_m2_per_m", || {
            format!("{} values for {} stations", stiffness.len(), stations.len())
        })?;
        check.that(stations.len() <= MAX_STATIONS, "beam.stiffness_station_m", || {
            format!("{} stations, at most {MAX_STATIONS}", stations.len())
        })
    }

    fn check_tanks(&self, check: &Check, length: f64) -> Result<(), Error> {
        for tank in &self.tank {
            let key = |field: &str| format!("tank.{}.{field}", tank.name);
            let half = 0.5 * tank.length_m.value;
            let [from, to] = [tank.centre_m.value - half, tank.centre_m.value + half];
            check.that(from >= 0.0 && to <= length, &key("centre_m"), || {
                format!("the tank from {from} m to {to} m must lie between 0 and {length} m")
            })?;
        }
        let total: f64 = self.tank.iter().map(|tank| tank.share.value).sum();
        check.that((total - 1.0).abs() < SHARES_TOLERANCE, "tank.share", || {
            format!("the shares add up to {total}, must add up to 1")
        })
    }
}

impl DataFile for EarthData {
    fn check(&self, check: &Check) -> Result<(), Error> {
        check.increasing("air.layer_base_m", &self.air.layer_base_m.value)?;
        let [bases, lapses] = [&self.air.layer_base_m, &self.air.layer_lapse_k_per_m];
        check.that(bases.value.len() == lapses.value.len(), "air.layer_lapse_k_per_m", || {
            format!("{} values for {} layers", lapses.value.len(), bases.value.len())
        })?;
        check.that(bases.value.len() <= MAX_LAYERS, "air.layer_base_m", || {
            format!("{} layers, at most {MAX_LAYERS}", bases.value.len())
        })
    }
}

impl DataFile for AeroData {
    fn check(&self, check: &Check) -> Result<(), Error> {
        check.increasing("envelope.alpha_rad", &self.envelope.alpha_rad.value)?;
        check.increasing("envelope.mach", &self.envelope.mach.value)?;
        check.increasing("envelope.altitude_m", &self.envelope.altitude_m.value)?;
        for ratio in self.inertia.structural_damping.value {
            check.inside("inertia.structural_damping", ratio, [0.0, 1.0])?;
        }
        let elevator = self.lift.delta_e.as_ref().map_or(0.0, |q| q.value);
        check.that(elevator != 0.0, "lift.delta_e", || "the elevator must lift".into())?;
        for (key, fit) in [("thrust", &self.thrust), ("thrust_phi", &self.thrust_phi)] {
            check.that(fit.delta_e.is_none() && fit.delta_e2.is_none(), key, || {
                "thrust does not depend on the elevator".into()
            })?;
        }
        // The elastic terms are derived from loads quadratic in the incidence.
        for (key, fit) in [("lift.alpha3", &self.lift), ("moment.alpha3", &self.moment)] {
            check.that(fit.alpha3.is_none(), key, || "lift and moment must be quadratic".into())?;
        }
        Ok(())
    }
}
