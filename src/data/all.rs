//! All data files together.

use super::embedded::{EARTH, Embedded, OWN, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015};
use super::files::{AeroData, EarthData, VehicleData};
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
    /// The user's set, in a library built with one.
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
}

/// Data of a file. Not inlined: reading needs a stack frame several times their size.
#[inline(never)]
fn read<T: DataFile>(file: &Embedded) -> Result<Box<T>, Error> {
    T::embedded(file).map(Box::new)
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: read(&VEHICLE)?,
            earth: read(&EARTH)?,
            xu2015: read(&XU2015)?,
            parker2007: read(&PARKER2007)?,
            shock_expansion: read(&SHOCK_EXPANSION)?,
            own: OWN.as_ref().map(read).transpose()?,
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
