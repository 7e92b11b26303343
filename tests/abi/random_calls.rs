//! Random sequences of calls; `AHV_FUZZ=<number of sequences>` tries another number.

use crate::common::{fmi2, fmi3};
use crate::master::fuzz;

#[test]
fn every_function_is_played() {
    fuzz::assert_every_function_is_played::<fmi2::Api>();
    fuzz::assert_every_function_is_played::<fmi3::Api>();
}

// All states but those of asynchronous steps and internal errors are in reach.
#[test]
fn random_calls_never_crash_and_follow_the_table_of_legal_calls() {
    fuzz::play::<fmi2::Api>(8);
}

#[test]
fn random_calls_of_fmi3_never_crash_and_follow_the_table_of_legal_calls() {
    fuzz::play::<fmi3::Api>(8);
}
