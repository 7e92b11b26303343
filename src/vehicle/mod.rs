//! A vehicle from data and options, without its equations of motion.
//!
//! | file | what it holds |
//! |---|---|
//! | `state` | components of states, controls and gusts |
//! | `options` | configuration, fuel, condition, sensors |
//! | `factors` | uncertainty factors |
//! | `assembly` | beam, liquid and coefficient set from data and options |
//! | `airframe` | properties at one fuel level |
//! | `body` | beam, liquid and modes at one fuel level |
//! | `fuel_table` | properties as functions of fuel |
//! | `complete` | the complete vehicle |

mod airframe;
mod assembly;
mod body;
mod complete;
mod factors;
mod fuel_table;
mod options;
mod state;

pub use airframe::{Airframe, COEFFICIENTS};
pub use assembly::{VehicleDefinition, structure};
pub use body::Body;
pub use complete::Vehicle;
pub use factors::Factors;
pub use fuel_table::FuelTable;
pub use options::{Condition, Configuration, SensorStations, VehicleOptions};
pub use state::{
    ALPHA, CONTROLS, Control, DELTA_E, FUEL, GAMMA, GUSTS, Gust, H, MAX_GUST_M_PER_S, NOMINAL, PHI,
    Q, RIGID_STATES, STATE_NAMES, STATES, State, U_GUST, V, W_GUST, eta, eta_dot,
};
