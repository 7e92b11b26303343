//! All data files together.

use super::embedded::{EARTH, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015};
use super::files::{AeroData, EarthData, VehicleData};
use super::own::{OwnFile, OwnFiles};
use super::validate::DataFile;
use crate::error::Error;

/// Coefficient set of eq. (4). The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AeroSet {
    /// Published set, changed as little as possible towards Tables 2 and 3.
    Xu2015 = 1,
    /// Published rigid part, derived elastic part.
    Parker2007 = 2,
    /// Regression of the first-principles model.
    ShockExpansion = 3,
    /// The user's set, if there is one.
    Own = 4,
}

/// All data files, read and checked; boxed, as together they would exceed a small stack.
#[derive(Debug, Clone)]
pub struct Data {
    /// Vehicle.
    pub vehicle: Box<VehicleData>,
    /// Gravity and air.
    pub earth: Box<EarthData>,
    /// Identified coefficient set.
    pub xu2015: Box<AeroData>,
    /// Published coefficient set.
    pub parker2007: Box<AeroData>,
    /// Coefficient set fitted to the first-principles model.
    pub shock_expansion: Box<AeroData>,
    /// The user's coefficient set.
    pub own: Option<Box<AeroData>>,
    /// Names of the user's files.
    pub own_files: Vec<String>,
    /// Packed forms of the vehicle and of the user's coefficients; empty if they are built in.
    pub own_packed: [Vec<u8>; 2],
}

/// Data of a file of the library. Not inlined: reading needs a stack frame several times their size.
#[inline(never)]
fn unpack<T: DataFile>(name: &str, packed: &[u8]) -> Result<Box<T>, Error> {
    T::unpack(name, packed).map(Box::new)
}

/// Data of a file of the user, likewise.
#[inline(never)]
fn parse<T: DataFile>(file: &OwnFile) -> Result<(Box<T>, Vec<u8>), Error> {
    let (data, packed) = T::parse_and_pack(&file.name, &file.text)?;
    Ok((Box::new(data), packed))
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: unpack(VEHICLE.name, VEHICLE.packed)?,
            earth: unpack(EARTH.name, EARTH.packed)?,
            xu2015: unpack(XU2015.name, XU2015.packed)?,
            parker2007: unpack(PARKER2007.name, PARKER2007.packed)?,
            shock_expansion: unpack(SHOCK_EXPANSION.name, SHOCK_EXPANSION.packed)?,
            own: None,
            own_files: Vec::new(),
            own_packed: Default::default(),
        })
    }

    /// The same with the user's files.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn with(files: &OwnFiles) -> Result<Self, Error> {
        let mut data = Self::embedded()?;
        if let Some(file) = &files.vehicle {
            (data.vehicle, data.own_packed[0]) = parse(file)?;
        }
        if let Some(file) = &files.coefficients {
            let (set, packed) = parse(file)?;
            (data.own, data.own_packed[1]) = (Some(set), packed);
        }
        data.own_files = files.names().map(str::to_string).collect();
        Ok(data)
    }

    /// The packed forms of all files, of which the model's identity is made.
    pub fn packed(&self) -> [&[u8]; 6] {
        let [vehicle, own] = &self.own_packed;
        let vehicle = if vehicle.is_empty() { VEHICLE.packed } else { vehicle };
        let [xu2015, parker2007, shock_expansion] = [XU2015, PARKER2007, SHOCK_EXPANSION];
        [vehicle, EARTH.packed, xu2015.packed, parker2007.packed, shock_expansion.packed, own]
    }

    /// The data of a coefficient set.
    pub fn aero(&self, set: AeroSet) -> &AeroData {
        match set {
            AeroSet::Xu2015 => &self.xu2015,
            AeroSet::Parker2007 => &self.parker2007,
            AeroSet::ShockExpansion => &self.shock_expansion,
            AeroSet::Own => self.own.as_ref().unwrap_or(&self.xu2015),
        }
    }
}
