//! Structure: a free-free beam with the liquid of its tanks, and their coupled modes.
//!
//! | file | what it holds | where it comes from |
//! |---|---|---|
//! | `tanks` | sloshing and frozen liquid | Fig. 4 |
//! | `beam`, `shape` | elements, mass, statics; shapes between nodes | eqs (1)-(2) |
//! | `mass_correction`, `rigid_body` | common mass centre and inertia of pitch, bending and slosh | |
//! | `modes` | K phi = omega^2 M phi | Table 1, Fig. 5 |

mod beam;
mod mass_correction;
mod modes;
mod rigid_body;
mod shape;
pub mod tanks;

pub use beam::{Beam, MassProperties, Oscillator};
pub use mass_correction::{MassCorrection, RigidMotion};
pub use modes::{FLEXIBLE, MODES, Modes, SLOSH};
pub use shape::{Point, Shape};
