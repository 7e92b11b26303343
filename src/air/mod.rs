//! Air and engine: eq. (4) of the paper and its range of validity.
//!
//! | file | what it holds | where it comes from |
//! |---|---|---|
//! | `atmosphere` | density, temperature, speed of sound, gravity | US Standard Atmosphere 1976 |
//! | `curve_fits` | curve fits of the coefficients | eq. (4) |
//! | `strip_theory` | elastic terms | eq. (4) |
//! | `envelope` | range of validity of the fits | |
//! | `intake` | captured air and fuel flow | hypersonic similarity |
//! | `choking` | margin to thermal choking | NACA Report 1135 |

mod atmosphere;
mod choking;
pub mod curve_fits;
mod envelope;
mod intake;
pub mod strip_theory;

pub use atmosphere::{Air, Atmosphere};
pub use choking::Choking;
pub use envelope::Envelope;
pub(crate) use envelope::tightest;
pub use intake::Intake;
