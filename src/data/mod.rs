//! Data of vehicle, earth and coefficient sets: each number with value, unit, source and status, from
//! Tables 1-3 of the paper and the literature. The build script checks the data files and embeds them in
//! the library, which reads those of the user by itself.

mod all;
mod document;
mod embedded;
mod files;
mod own;
mod quantity;
mod ranges;
mod reader;
mod shape;
mod validate;

pub use all::{AeroSet, Data};
pub use embedded::{DATA_FILES, EARTH, Embedded, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015};
pub use files::{
    Actuation, AeroData, AirData, BeamData, Defaults, Earth, EarthData, EnvelopeData, Geometry,
    Inertia, Mass, PolynomialData, Reference, TankData, VehicleData,
};
pub use own::{MAX_DATA_BYTES, OwnFile, OwnFiles};
pub use quantity::Quantity;
pub use reader::{Entry, Reader};
pub use shape::{EngineData, Outline};
pub use validate::DataFile;
pub(crate) use validate::MAX_LAYERS;
