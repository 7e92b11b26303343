//! All data files together.

use super::embedded::{EARTH, Embedded, OWN, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015};
use super::files::{AeroData, EarthData, VehicleData};
use super::validate::DataFile;
use crate::error::Error;

/// Coefficient set of eq. (4). The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AeroSet {
    /// Published set, moved as little as possible towards Tables 2 and 3.
    Xu2015 = 1,
    /// Published rigid part, derived elastic part.
    Parker2007 = 2,
    /// Regression of the first-principles model.
    ShockExpansion = 3,
    /// That of the user, in a library that was built with one.
    Own = 4,
}

/// All data files, read and checked; boxed, as together they are too large for a small stack.
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
    /// Coefficient set of the user.
    pub own: Option<Box<AeroData>>,
}

/// A file's data, in a frame of its own: reading takes several times their room.
#[inline(never)]
fn boxed<T: DataFile>(file: &Embedded) -> Result<Box<T>, Error> {
    T::embedded(file).map(Box::new)
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: boxed(&VEHICLE)?,
            earth: boxed(&EARTH)?,
            xu2015: boxed(&XU2015)?,
            parker2007: boxed(&PARKER2007)?,
            shock_expansion: boxed(&SHOCK_EXPANSION)?,
            own: OWN.as_ref().map(boxed).transpose()?,
        })
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
