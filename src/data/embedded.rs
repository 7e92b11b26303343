//! Data files embedded in the library.

/// A data file embedded in the library.
#[derive(Debug, Clone, Copy)]
pub struct Embedded {
    /// Name, for messages.
    pub name: &'static str,
    /// The file itself.
    pub text: &'static str,
    /// Its data in postcard format.
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
/// The user's coefficient set, if the library was built with one.
pub const OWN: Option<Embedded> = own();

/// All data files.
pub const DATA_FILES: [Option<Embedded>; 6] =
    [Some(VEHICLE), Some(EARTH), Some(XU2015), Some(PARKER2007), Some(SHOCK_EXPANSION), OWN];

#[cfg(own_coefficients)]
const fn own() -> Option<Embedded> {
    Some(embedded!("aero/own"))
}

#[cfg(not(own_coefficients))]
const fn own() -> Option<Embedded> {
    None
}

/// Names of the user's data files in this library; empty for the standard vehicle.
pub const OWN_FILES: &str = env!("AHV_OWN_FILES");
