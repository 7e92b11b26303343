//! The library in the hands of a master that calls anything at any time.

#![allow(unsafe_code)]

#[path = "../../fmi/tests/master/mod.rs"]
mod master;

use ahv_autopilot::Autopilot;
use master::fuzz;

/// Instantiated, initialising, stepping, terminated, and ended by an error: a start can fail.
const STATES: usize = 5;

#[test]
fn random_calls_never_crash_it_in_fmi_2() {
    // And after a step with too many samples, which is discarded.
    fuzz::play::<master::v2::Api<Autopilot>>(STATES + 1);
}

#[test]
fn random_calls_never_crash_it_in_fmi_3() {
    fuzz::play::<master::v3::Api<Autopilot>>(STATES);
}
