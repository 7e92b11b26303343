//! Reading and checking of the data files: a wrong number is refused with file, key and limit.

use super::{AeroData, EarthData, Embedded, VehicleData, units};
use crate::atmosphere::MAX_LAYERS;
use crate::error::Error;
use serde::de::DeserializeOwned;

/// The shares of the tanks are printed with four digits and must add up to one.
const SHARES_ADD_UP: f64 = 1e-9;
/// Below, three bending modes have no nodes to live on; above, no one needs it.
const ELEMENTS: std::ops::RangeInclusive<u32> = 8..=20_000;
/// Largest distance, m, by which a place along the body is corrected.
const SHIFTS: [f64; 2] = [-100.0, 100.0];
/// A surface steeper than 45 deg is no slender body.
const STEEPEST: [f64; 2] = [0.0, core::f64::consts::FRAC_PI_4];
/// Equivalence ratios beyond are no matter of tolerance.
const MARGIN: std::ops::RangeInclusive<f64> = -1.0..=1.0;

/// A data file that can be read and checked.
pub trait DataFile: DeserializeOwned {
    /// Reads and checks a text in TOML; `file` is its name for messages.
    ///
    /// # Errors
    /// [`Error::Data`] with the key or the line, the value and the limit.
    fn parse(file: &str, text: &str) -> Result<Self, Error> {
        let unreadable = |error: toml::de::Error| {
            let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or("");
            Error::Data {
                file: file.to_string(),
                key: format!("line {}", before.matches('\n').count() + 1),
                problem: error.message().to_string(),
            }
        };
        let data: Self = toml::from_str(text).map_err(unreadable)?;
        if let Some((key, problem)) = units::wrong(&text.parse().map_err(unreadable)?) {
            return Err(Error::Data { file: file.to_string(), key, problem });
        }
        data.check(&Check { file })?;
        Ok(data)
    }

    /// Reads and checks a file that the library carries.
    ///
    /// # Errors
    /// [`Error::Data`] with the key, the value and the limit.
    fn embedded(file: &Embedded) -> Result<Self, Error> {
        let data: Self = postcard::from_bytes(file.packed).map_err(|error| Error::Data {
            file: file.name.to_string(),
            key: "packed".to_string(),
            problem: error.to_string(),
        })?;
        data.check(&Check { file: file.name })?;
        Ok(data)
    }

    /// Whether the numbers are those of a vehicle.
    ///
    /// # Errors
    /// [`Error::Data`] with the key, the value and the limit.
    fn check(&self, check: &Check) -> Result<(), Error>;
}

/// The checks of one file; the first wrong number is reported.
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

    fn positive(&self, key: &str, value: f64) -> Result<(), Error> {
        self.that(value > 0.0 && value.is_finite(), key, || format!("{value} must be positive"))
    }

    fn finite(&self, key: &str, value: f64) -> Result<(), Error> {
        self.that(value.is_finite(), key, || format!("{value} must be finite"))
    }

    fn inside(&self, key: &str, value: f64, [min, max]: [f64; 2]) -> Result<(), Error> {
        self.that(value > min && value < max, key, || {
            format!("{value} must lie between {min} and {max}")
        })
    }

    fn increasing(&self, key: &str, values: &[f64]) -> Result<(), Error> {
        let finite = values.iter().all(|value| value.is_finite());
        let ok = finite && !values.is_empty() && values.windows(2).all(|pair| pair[0] < pair[1]);
        self.that(ok, key, || format!("{values:?} must increase"))
    }
}

impl DataFile for VehicleData {
    fn check(&self, check: &Check) -> Result<(), Error> {
        let length = self.geometry.length_m.value;
        check.positive("geometry.length_m", length)?;
        check.inside("geometry.fore_body_m", self.geometry.fore_body_m.value, [0.0, length])?;
        let tail = length - self.geometry.fore_body_m.value;
        check.inside("geometry.nacelle_m", self.geometry.nacelle_m.value, [0.0, tail])?;
        self.check_mass(check, length)?;
        self.check_beam(check, length)?;
        self.check_tanks(check, length)?;
        check.positive("actuation.delta_e_limit_rad", self.actuation.delta_e_limit_rad.value)?;
        check.positive("actuation.phi_limit", self.actuation.phi_limit.value)?;
        let stations = [
            ("default.imu_station_m", &self.default.imu_station_m),
            ("default.probe_station_m", &self.default.probe_station_m),
        ];
        for (key, station) in stations {
            let ok = (0.0..=length).contains(&station.value);
            check.that(ok, key, || format!("{} must lie in [0, {length}]", station.value))?;
        }
        self.check_outline(check, length)?;
        self.check_engine(check)?;
        Ok(())
    }
}

impl VehicleData {
    fn check_outline(&self, check: &Check, length: f64) -> Result<(), Error> {
        let outline = &self.outline;
        check.inside("outline.lower_angle_rad", outline.lower_angle_rad.value, STEEPEST)?;
        check.inside("outline.upper_angle_rad", outline.upper_angle_rad.value, STEEPEST)?;
        let station = outline.elevator_station_m.value;
        check.inside("outline.elevator_station_m", station, [0.0, length])?;
        check.finite("outline.elevator_height_m", outline.elevator_height_m.value)?;
        check.finite("outline.moment_height_m", outline.moment_height_m.value)?;
        check.positive("outline.elevator_area_m2_per_m", outline.elevator_area_m2_per_m.value)
    }

    fn check_engine(&self, check: &Check) -> Result<(), Error> {
        let engine = &self.engine;
        check.positive("engine.duct_height_m", engine.duct_height_m.value)?;
        let ratio = engine.nozzle_area_ratio.value;
        check.that(ratio >= 1.0 && ratio.is_finite(), "engine.nozzle_area_ratio", || {
            format!("{ratio} must be 1 or more")
        })?;
        check.positive("engine.heating_value_j_per_kg", engine.heating_value_j_per_kg.value)?;
        check.positive("engine.stoichiometric_ratio", engine.stoichiometric_ratio.value)?;
        check.inside("engine.combustion_efficiency", engine.combustion_efficiency.value, [0.0, 1.0])
    }

    fn check_mass(&self, check: &Check, length: f64) -> Result<(), Error> {
        let mass = &self.mass;
        check.positive("mass.fore_beam_kg_per_m2", mass.fore_beam_kg_per_m2.value)?;
        check.positive("mass.aft_beam_kg_per_m2", mass.aft_beam_kg_per_m2.value)?;
        check.inside("mass.beam_joint_m", mass.beam_joint_m.value, [0.0, length])?;
        check.inside("mass.propellant_fraction", mass.propellant_fraction.value, [0.0, 1.0])?;
        check.inside("mass.residual_fraction", mass.residual_fraction.value, [0.0, 1.0])
    }

    fn check_beam(&self, check: &Check, length: f64) -> Result<(), Error> {
        let elements = self.beam.elements.value;
        check.that(ELEMENTS.contains(&elements), "beam.elements", || {
            format!("{elements} must lie in {ELEMENTS:?}")
        })?;
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
        stiffness.iter().try_for_each(|&ei| check.positive("beam.stiffness_n_m2_per_m", ei))
    }

    fn check_tanks(&self, check: &Check, length: f64) -> Result<(), Error> {
        for tank in &self.tank {
            let key = |field: &str| format!("tank.{}.{field}", tank.name);
            check.positive(&key("length_m"), tank.length_m.value)?;
            check.positive(&key("share"), tank.share.value)?;
            check.positive(&key("bay_length_m"), tank.bay_length_m.value)?;
            check.positive(&key("depth_full_m"), tank.depth_full_m.value)?;
            let half = 0.5 * tank.length_m.value;
            let [from, to] = [tank.centre_m.value - half, tank.centre_m.value + half];
            check.that(from >= 0.0 && to <= length, &key("centre_m"), || {
                format!("the tank from {from} m to {to} m must lie between 0 and {length} m")
            })?;
        }
        let total: f64 = self.tank.iter().map(|tank| tank.share.value).sum();
        check.that((total - 1.0).abs() < SHARES_ADD_UP, "tank.share", || {
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
        })?;
        check.positive("earth.gravity_m_per_s2", self.earth.gravity_m_per_s2.value)?;
        check.positive("earth.radius_m", self.earth.radius_m.value)?;
        Ok(())
    }
}

impl DataFile for AeroData {
    fn check(&self, check: &Check) -> Result<(), Error> {
        check.increasing("envelope.alpha_rad", &self.envelope.alpha_rad.value)?;
        check.increasing("envelope.mach", &self.envelope.mach.value)?;
        check.increasing("envelope.altitude_m", &self.envelope.altitude_m.value)?;
        if let Some(margin) = &self.envelope.choking_margin {
            let value = margin.value;
            check.that(MARGIN.contains(&value), "envelope.choking_margin", || {
                format!("{value} must lie in {MARGIN:?}")
            })?;
        }
        check.positive("reference.area_m2_per_m", self.reference.area_m2_per_m.value)?;
        check.positive("reference.chord_m", self.reference.chord_m.value)?;
        check.positive("inertia.i_yy_kg_m2_per_m", self.inertia.i_yy_kg_m2_per_m.value)?;
        check.positive("reference.elastic_scale", self.reference.elastic_scale.value)?;
        let lengths = [
            ("inertia.mass_centre_shift_m", &self.inertia.mass_centre_shift_m),
            ("reference.gamma_offset_m", &self.reference.gamma_offset_m),
        ];
        for (key, length) in lengths {
            length.as_ref().map_or(Ok(()), |length| check.inside(key, length.value, SHIFTS))?;
        }
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
        // The elastic terms are derived from loads that are quadratic in the incidence.
        for (key, fit) in [("lift.alpha3", &self.lift), ("moment.alpha3", &self.moment)] {
            check.that(fit.alpha3.is_none(), key, || "lift and moment must be quadratic".into())?;
        }
        Ok(())
    }
}
