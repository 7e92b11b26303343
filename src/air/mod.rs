//! Air and engine: eq. (4) of the paper, and where it holds.
//!
//! | file | what it holds | where it comes from |
//! |---|---|---|
//! | `atmosphere` | air and gravity | US Standard Atmosphere 1976 |
//! | `curve_fits` | curve fits at run time | eq. (4) |
//! | `strip_theory` | where the elastic terms come from | eq. (4) |
//! | `envelope` | where the fits hold | |
//! | `intake` | how fast fuel burns | hypersonic similarity |
//! | `choking` | how much fuel the burner can still take | NACA Report 1135 |

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
