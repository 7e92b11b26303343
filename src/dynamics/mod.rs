//! Flight dynamics: eq. (3) of the paper with its errata applied; x' = f(x, u), y = g(x, u).
//!
//! The functions are pure and generic over the number type, so dual numbers give exact
//! derivatives. The generalised slosh force Q_i of eq. (3) does not appear: the sloshing masses
//! are unknowns of the eigenproblem, so their force is inside the modes already.
//!
//! | file | what it holds | where it comes from |
//! |---|---|---|
//! | `airflow` | the vehicle as moving air meets it | |
//! | `coefficients`, `loads` | what the air makes of a state | eq. (4) |
//! | `modal`, `rates` | modes and rigid body at one fuel level | eq. (3) |
//! | `burning` | while fuel burns | |
//! | `sensors`, `outputs` | what is shown beside the states | |
//! | `equations` | f and g | eq. (3) |
//! | `limits` | where the model holds | |
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
