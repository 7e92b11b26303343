//! Data files embedded in the library.

/// A data file embedded in the library.
#[derive(Debug, Clone, Copy)]
pub struct Embedded {
    /// Name, for messages.
    pub name: &'static str,
    /// The file itself. Not in the FMU, whose code does not read it.
    pub text: &'static str,
    /// Its packed form.
    pub packed: &'static [u8],
}

/// A file written by the build script.
macro_rules! embedded {
    ($name:literal) => {
        Embedded {
            name: concat!($name, ".toml"),
            text: include_str!(concat!(env!("OUT_DIR"), "/", $name, ".toml")),
            packed: include_bytes!(concat!(env!("OUT_DIR"), "/", $name, ".packed")),
        }
    };
}

/// The vehicle.
pub const VEHICLE: Embedded = embedded!("vehicle");
/// Gravity and air.
pub const EARTH: Embedded = embedded!("earth");
/// Identified coefficient set.
pub const XU2015: Embedded = embedded!("aero/xu2015");
/// Published coefficient set.
pub const PARKER2007: Embedded = embedded!("aero/parker2007");
/// Coefficient set fitted to the first-principles model.
pub const SHOCK_EXPANSION: Embedded = embedded!("aero/shock_expansion");
/// All data files, in the order of [`super::Data::packed`].
pub const DATA_FILES: [Embedded; 5] = [VEHICLE, EARTH, XU2015, PARKER2007, SHOCK_EXPANSION];
