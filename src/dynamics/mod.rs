//! Flight dynamics: eq. (3) of the paper with its errata applied; x' = f(x, u), y = g(x, u).
//!
//! The functions are pure and generic over the number type, so dual numbers give exact
//! derivatives. The generalised slosh force Q_i of eq. (3) does not appear: the sloshing masses
//! are unknowns of the eigenproblem, so the modes contain their force.
//!
//! | file | what it holds | where it comes from |
//! |---|---|---|
//! | `relative_wind` | velocity relative to the air | |
//! | `coefficients`, `loads` | aerodynamic loads | eq. (4) |
//! | `modal`, `rates` | equations of modes and rigid body at constant fuel | eq. (3) |
//! | `burning` | additional terms while fuel burns | |
//! | `sensors`, `outputs` | outputs | |
//! | `equations` | f and g | eq. (3) |
//! | `limits` | range of validity, domain, actuator limits | |
//! | [`trim`], [`linear`] | trim; A, B, C, poles, zeros | Tables 2-3 |

mod burning;
mod coefficients;
mod equations;
mod limits;
pub mod linear;
mod loads;
mod modal;
mod outputs;
mod rates;
mod relative_wind;
mod sensors;
pub mod trim;

pub(crate) use limits::{is_finite, out_of_domain};
pub use loads::Loads;
pub use outputs::Outputs;
pub use sensors::Imu;
