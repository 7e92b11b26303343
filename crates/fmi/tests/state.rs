//! Bytes that were made up, with a right checksum.
#![allow(missing_docs)]

use dahlquist::Dahlquist;
use fmi_model::failure::Failure;
use fmi_model::instance::{Instance, Interface};
use fmi_model::state::FmuState;

/// Magic, version, length, identity; then phase and flags.
const HEADER: usize = 8 + 4 + 4 + 16;
const FIRST_NUMBER: usize = HEADER + 2;

/// The bytes with another checksum, 64-bit FNV-1a.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - 8;
    let sum = bytes[..end].iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    bytes
}

fn instance(started: bool) -> Instance<Dahlquist> {
    let mut instance = Instance::new(Interface::CoSimulation, false).unwrap();
    instance.setup_experiment(None, 0.5, Some(3.0)).unwrap();
    instance.enter_initialization_mode().unwrap();
    if started {
        instance.exit_initialization_mode().unwrap();
        instance.do_step(0.5, 0.25).unwrap();
    }
    instance
}

#[test]
fn no_number_of_a_state_may_be_absurd() {
    for started in [false, true] {
        let instance = instance(started);
        let bytes = instance.state().unwrap().encode().unwrap();
        assert_eq!(bytes, sealed(bytes.clone()), "the checksum is FNV-1a");
        assert!(instance.deserialize(&bytes).is_ok());
        // Before the start the input takes one of the three places of the simulation.
        let idle = if started { 0..0 } else { 4..6 };
        for number in (0..(bytes.len() - FIRST_NUMBER - 8) / 8).filter(|i| !idle.contains(i)) {
            for value in [f64::NAN, f64::NEG_INFINITY] {
                let mut forged = bytes.clone();
                let at = FIRST_NUMBER + 8 * number;
                forged[at..at + 8].copy_from_slice(&value.to_le_bytes());
                let refused = instance.deserialize(&sealed(forged));
                assert!(matches!(refused, Err(Failure::Bytes { .. })), "{number} {value}");
            }
        }
    }
}

#[test]
fn phases_that_cannot_be_saved_and_bytes_of_others_are_refused() {
    let instance = instance(true);
    let good = instance.state().unwrap().encode().unwrap();
    assert_eq!(good.len(), FmuState::<Dahlquist>::encoded_len().unwrap());
    for (at, byte) in
        [(0, b'f'), (8, 9), (12, 0), (16, !good[16]), (HEADER, 3), (HEADER, 8), (HEADER, 99)]
    {
        let mut forged = good.clone();
        forged[at] = byte;
        let refused = instance.deserialize(&sealed(forged));
        assert!(matches!(refused, Err(Failure::Bytes { .. })), "byte {at} = {byte}");
    }
    for length in [0, 10, HEADER, good.len() - 1] {
        assert!(instance.deserialize(&good[..length]).is_err(), "{length} bytes");
    }
}

#[test]
fn a_restored_instance_goes_on_bit_for_bit() {
    let mut one = instance(true);
    let state = one.deserialize(&one.state().unwrap().encode().unwrap()).unwrap();
    let mut other = instance(false);
    other.set_state(&state).unwrap();
    for instance in [&mut one, &mut other] {
        instance.set_real(&[0], &[2.0]).unwrap();
        instance.do_step(0.75, 0.5).unwrap();
    }
    assert_eq!(one.state().unwrap(), other.state().unwrap());
}
