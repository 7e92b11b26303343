//! From data and options to a vehicle that can fly: what it is made of, without its equations.
//!
//! | file | what it holds |
//! |---|---|
//! | `state` | states, controls and gusts of eq. (3) |
//! | `options` | what shapes a vehicle |
//! | `factors` | what may be uncertain about it |
//! | `assembly` | data and options to beam, liquid and coefficient set |
//! | `airframe` | what the fuel level decides |
//! | `body` | beam, liquid and modes at one fuel level |
//! | `fuel_table` | the vehicle while fuel burns |
//! | `complete` | all of it together |

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
    Q, RIGID, STATE_NAMES, STATES, State, U_GUST, V, W_GUST, eta, eta_dot,
};
