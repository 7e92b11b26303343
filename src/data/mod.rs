//! Data of vehicle, earth and coefficient sets: each number with value, unit, source and status, from
//! Tables 1-3 of the paper and the literature. The build script checks the data files and embeds them in
//! the library.

mod all;
mod embedded;
mod files;
mod quantity;
mod ranges;
mod shape;
mod validate;

pub use all::{AeroSet, Data};
pub use embedded::{
    DATA_FILES, EARTH, Embedded, OWN, OWN_FILES, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015,
};
pub use files::{
    Actuation, AeroData, AirData, BeamData, Defaults, Earth, EarthData, EnvelopeData, Geometry,
    Inertia, Mass, PolynomialData, Reference, TankData, VehicleData,
};
pub use quantity::{Origin, Quantity, Status};
pub use shape::{EngineData, Outline};
pub use validate::DataFile;
pub(crate) use validate::MAX_LAYERS;
