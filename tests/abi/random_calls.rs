//! Random sequences of calls; `AHV_FUZZ=<number of sequences>` tries another number.

use crate::master::fuzz;
use ahv::flight::Setup;

#[test]
fn every_function_is_played() {
    fuzz::assert_every_function_is_played::<Setup>();
}

#[test]
fn random_calls_never_crash_and_follow_the_table_of_legal_calls() {
    // All but those of asynchronous steps and internal errors.
    fuzz::play::<Setup>(8);
}
