//! A flight: [`Setup`] before it, with the parameters; [`Flight`] in it, with inputs, states and outputs.
//! Knows no FMI.
//!
//! | file | what it holds |
//! |---|---|
//! | `parameters`, `setup` | what can be chosen, and the flight that starts from it |
//! | `inputs`, `limits` | inputs between communication points: polynomials in time, and when they meet their limits |
//! | `controlled_vehicle`, `method` | the vehicle under its inputs as the integrator sees it; the integrator |
//! | `in_flight` | inputs, states, outputs; step by step |
//! | `tangent`, `snapshot` | directional derivatives; what has to be remembered |
//! | `envelope_error`, `advice` | why a flight ends; what is probably not meant |

mod advice;
mod controlled_vehicle;
mod envelope_error;
mod in_flight;
mod inputs;
mod limits;
mod method;
mod parameters;
mod setup;
mod snapshot;
mod tangent;

pub use advice::BeyondLimit;
pub use in_flight::{Flight, Sample};
pub use inputs::{INPUT_ORDER, INPUTS, Inputs};
pub use method::{DEFAULT_TOLERANCE, TOLERANCES, method};
pub use parameters::{InputMode, Offsets, Parameters};
pub use setup::Setup;
pub use snapshot::Snapshot;
