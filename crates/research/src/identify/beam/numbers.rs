//! The numbers of beam and tanks, their prior, and their digits in the file.
//!
//! Coordinates are in prior standard deviations from the prior mean.

use ahv::data::VehicleData;
use ahv::structure::Beam;
use anyhow::{Context, Result, anyhow};
use nalgebra::DVector;
use toml_edit::{DocumentMut, Value};

/// Stations of the stiffness; its coordinates are level, tilt and second differences.
pub const STATIONS: usize = 9;
/// Level, tilt and second differences; then the centres and lengths of the tanks, and the mass centre.
pub const COORDINATES: usize = STATIONS + 5;
/// Coordinate of the mass centre.
const BALANCE: usize = STATIONS + 4;
/// Coordinates of the tanks' centres.
pub const CENTRES: [usize; 2] = [STATIONS, STATIONS + 1];

/// Prior of the level of EI and of its ratio from end to end: a factor of ten.
const LEVEL: f64 = std::f64::consts::LN_10;
/// Prior of second differences of ln EI: a station within a factor sqrt(2) of the geometric mean of its
/// neighbours.
const BEND: f64 = std::f64::consts::LN_2;
/// Prior of the centre of a tank over the length of its beam: halfway from the middle to the end.
const CENTRE: f64 = 0.25;
/// Prior of the length of a tank over that of its beam: mean, and standard deviation of the logarithm.
const FILLED: f64 = 0.5;
const LENGTH: f64 = 0.5;
/// Prior of the mass centre of the full vehicle about the published one, over the length: the printed beams have it
/// at 55 ft, to the foot, and nothing is printed on the liquid.
const OFF_BALANCE: f64 = 0.01;
/// First natural frequency of a uniform free-free beam: `omega = FREE_FREE sqrt(EI / (m l^4))`,
/// Blevins, Formulas for Natural Frequency and Mode Shape (1979), table 8-1.
const FREE_FREE: f64 = 22.3733;

/// Source of the numbers in the file.
const FOUND: &str = "cargo ahv identify beam";

/// Written digits: significant digits of stiffness; steps per metre of lengths; steps of shares.
const DIGITS: usize = 5;
const MILLIMETRES: f64 = 1e3;
const SHARES: f64 = 1e4;

/// The prior: a vehicle with the published masses. Each of its two beams has a tank in its middle, half as long as
/// the beam. EI is uniform; with uniform mass it would give the first even frequency. The shares of the tanks give
/// the published mass centre.
#[derive(Debug, Clone)]
pub struct Prior {
    data: VehicleData,
    stiffness: f64,
    /// Fore and aft beam, m.
    beams: [f64; 2],
    /// Of the full vehicle, m.
    pub mass_centre: f64,
}

impl Prior {
    pub fn new(data: &VehicleData, first_rad_per_s: f64) -> Result<Self> {
        let count = data.beam.stiffness_station_m.value.len();
        if count != STATIONS {
            return Err(anyhow!(
                "vehicle.toml: beam.stiffness_station_m: {count} stations, `identify beam` takes {STATIONS}"
            ));
        }
        let (length, joint) = (data.geometry.length_m.value, data.mass.beam_joint_m.value);
        let beams = [joint, length - joint];
        let fore = data.mass.fore_beam_kg_per_m2.value * beams[0];
        let aft = data.mass.aft_beam_kg_per_m2.value * beams[1];
        let speed = first_rad_per_s * length * length / FREE_FREE;
        let stiffness = (fore + aft) / length * speed * speed;
        let mass_centre = Beam::even(data, 1.0).mass_properties(&[]).centre_m;
        Ok(Self { data: data.clone(), stiffness, beams, mass_centre })
    }

    /// ln EI at each station, per coordinate: level, tilt, then each second difference.
    fn stiffness_slope(station: usize, coordinate: usize) -> f64 {
        let last = STATIONS - 1;
        match coordinate {
            0 => LEVEL,
            1 => LEVEL * (station as f64 / last as f64 - 0.5),
            // A bend at station `knot` without components of level and tilt.
            _ => BEND * Self::bend(coordinate - 1)[station],
        }
    }

    /// A unit second difference at `knot`, minus its least-squares line.
    fn bend(knot: usize) -> [f64; STATIONS] {
        let raw: [f64; STATIONS] = std::array::from_fn(|i| i.saturating_sub(knot) as f64);
        let middle = (STATIONS - 1) as f64 / 2.0;
        let arm = |i: usize| i as f64 - middle;
        let mean = raw.iter().sum::<f64>() / STATIONS as f64;
        let square: f64 = (0..STATIONS).map(|i| arm(i) * arm(i)).sum();
        let tilt = (0..STATIONS).map(|i| arm(i) * raw[i]).sum::<f64>() / square;
        std::array::from_fn(|i| raw[i] - mean - tilt * arm(i))
    }

    /// The vehicle at a point, with all digits.
    pub fn vehicle(&self, point: &DVector<f64>) -> VehicleData {
        let mut data = self.data.clone();
        let slope = |i: usize| (0..STATIONS).map(move |k| Self::stiffness_slope(i, k) * point[k]);
        data.beam.stiffness_n_m2_per_m.value =
            (0..STATIONS).map(|i| self.stiffness * libm::exp(slope(i).sum())).collect();
        let [fore, aft] = self.beams;
        for (j, (start, beam)) in [(0.0, fore), (fore, aft)].into_iter().enumerate() {
            let tank = &mut data.tank[j];
            tank.centre_m.value = start + beam * (0.5 + CENTRE * point[STATIONS + j]);
            tank.length_m.value = FILLED * beam * libm::exp(LENGTH * point[STATIONS + 2 + j]);
        }
        let [from, to] = [0, 1].map(|j| data.tank[j].centre_m.value);
        let off = OFF_BALANCE * data.geometry.length_m.value * point[BALANCE];
        // The structure without tanks has the published mass centre.
        let liquid = self.mass_centre + off / data.mass.propellant_fraction.value;
        let share = (to - liquid) / (to - from);
        data.tank[0].share.value = share;
        data.tank[1].share.value = 1.0 - share;
        data
    }

    /// Coordinate of the centre of tank `j` at a station, m.
    pub fn centre_coordinate(&self, j: usize, station_m: f64) -> f64 {
        let start = [0.0, self.beams[0]][j];
        ((station_m - start) / self.beams[j] - 0.5) / CENTRE
    }
}

/// Scale of the standard deviation of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// The natural logarithm.
    Ratio,
    /// The number itself.
    Difference,
}

/// Name, unit and scale of the numbers, in the order of [`values`].
pub fn names() -> Vec<(String, &'static str, Scale)> {
    let stiffness = (0..STATIONS).map(|i| (format!("EI at station {i}"), EI, Scale::Ratio));
    let tanks = ["fore", "aft"].into_iter().flat_map(|name| {
        [
            (format!("{name} tank, centre"), "m", Scale::Difference),
            (format!("{name} tank, length"), "m", Scale::Ratio),
        ]
    });
    let share = ("fore tank, share".to_string(), "1", Scale::Difference);
    stiffness.chain(tanks).chain([share]).collect()
}

const EI: &str = "N m^2/m";

/// The numbers of a vehicle; the share of the aft tank is the rest.
pub fn values(data: &VehicleData) -> Vec<f64> {
    let tanks = data.tank.iter().flat_map(|tank| [tank.centre_m.value, tank.length_m.value]);
    let stiffness = data.beam.stiffness_n_m2_per_m.value.iter().copied();
    stiffness.chain(tanks).chain([data.tank[0].share.value]).collect()
}

/// A vehicle with other numbers, in the order of [`values`].
pub fn with_values(mut data: VehicleData, values: &[f64]) -> VehicleData {
    data.beam.stiffness_n_m2_per_m.value = values[..STATIONS].to_vec();
    for (tank, pair) in data.tank.iter_mut().zip(values[STATIONS..].chunks(2)) {
        tank.centre_m.value = pair[0];
        tank.length_m.value = pair[1];
    }
    let share = values[STATIONS + 4];
    data.tank[0].share.value = share;
    data.tank[1].share.value = 1.0 - share;
    data
}

/// The numbers rounded to the written digits.
pub fn rounded(mut data: VehicleData) -> VehicleData {
    let decimals = |value: &mut f64, unit: f64| *value = (*value * unit).round() / unit;
    for value in &mut data.beam.stiffness_n_m2_per_m.value {
        *value = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(*value);
    }
    for tank in &mut data.tank {
        decimals(&mut tank.length_m.value, MILLIMETRES);
        decimals(&mut tank.centre_m.value, 1e2 * MILLIMETRES);
    }
    let [fore, aft] = &mut data.tank;
    decimals(&mut fore.share.value, SHARES);
    aft.share.value = 1.0 - fore.share.value;
    decimals(&mut aft.share.value, SHARES);
    data
}

/// The text of `vehicle.toml` with these numbers and their standard errors, in the order of [`values`];
/// everything else is unchanged.
pub fn file(text: &str, data: &VehicleData, known: &[String]) -> Result<String> {
    let mut document: DocumentMut = text.parse().context("vehicle.toml")?;
    let list: Vec<_> =
        data.beam.stiffness_n_m2_per_m.value.iter().map(|ei| format!("{ei:e}")).collect();
    let list = format!("[{}]", list.join(", "));
    let source = format!("{FOUND}: known at the stations to {}", known[..STATIONS].join(", "));
    set(&mut document["beam"]["stiffness_n_m2_per_m"], &list, &source)?;
    let tanks = document["tank"].as_array_of_tables_mut();
    let tanks = tanks.ok_or_else(|| anyhow!("vehicle.toml: no [[tank]]"))?;
    let known = known[STATIONS..].split_at(4);
    for (j, (table, tank)) in tanks.iter_mut().zip(&data.tank).enumerate() {
        let about = |i: usize| format!("{FOUND}: known to {}", known.0[2 * j + i]);
        let share =
            format!("part of the propellant in this tank; {FOUND}: known to {}", known.1[0]);
        set(&mut table["centre_m"], &format!("{:?}", tank.centre_m.value), &about(0))?;
        set(&mut table["length_m"], &format!("{:?}", tank.length_m.value), &about(1))?;
        set(&mut table["share"], &format!("{:?}", tank.share.value), &share)?;
    }
    Ok(document.to_string())
}

fn set(item: &mut toml_edit::Item, number: &str, source: &str) -> Result<()> {
    for (key, text) in [("value", number), ("source", &format!("{source:?}"))] {
        let value = item.get_mut(key).and_then(toml_edit::Item::as_value_mut);
        let value = value.ok_or_else(|| anyhow!("vehicle.toml: a number without {key}"))?;
        let decor = value.decor().clone();
        *value = text.parse::<Value>()?;
        *value.decor_mut() = decor;
    }
    Ok(())
}
