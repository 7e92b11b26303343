//! FMU states: saved, restored, as bytes, elsewhere, and damaged.

use super::{Api, Slave};
use crate::common::configurations;
use crate::master::{Api as _, Random};
use ahv::variables::TABLE;
use fmi_model::status::Status;
use std::ptr::null_mut;

/// Flies on for a while: bits of all values after each step.
fn fly(slave: &Slave, from: f64) -> Vec<Vec<u64>> {
    (0..5)
        .map(|i| {
            let i = f64::from(i);
            assert_eq!(slave.set("delta_e", 0.003 * i), Status::Ok);
            assert_eq!(slave.step(from + i * 0.1, 0.1), Status::Ok);
            slave.bits()
        })
        .collect()
}

#[test]
fn a_restored_flight_goes_on_with_the_same_bits_in_any_instance_also_by_way_of_bytes() {
    let api = Api::load();
    configurations().into_iter().for_each(|configuration| go_on(&api, configuration));
}

fn go_on(api: &Api, configuration: i32) {
    let slave = Slave::flying_as(api, configuration);
    assert_eq!(slave.set("phi", 0.01), Status::Ok);
    assert_eq!(slave.step(0.0, 0.25), Status::Ok);
    let saved = slave.save();
    let bytes = slave.bytes(saved);
    assert!(bytes.len() <= 1024, "{}", bytes.len());
    let expected = fly(&slave, 0.25);

    assert_eq!(slave.load(saved), Status::Ok);
    assert_eq!(fly(&slave, 0.25), expected, "in the same instance");
    let other = Slave::new(api);
    assert_eq!(other.load(saved), Status::Ok, "into one that was never initialised");
    assert_eq!(fly(&other, 0.25), expected);
    slave.free(saved);
    drop(slave);

    let third = Slave::flying_as(api, 1);
    assert_eq!(third.set("delta_e", -0.01), Status::Ok);
    assert_eq!(third.step(0.0, 0.7), Status::Ok);
    let (status, state) = third.state_of(&bytes);
    assert_eq!(status, Status::Ok);
    assert_eq!(third.bytes(state), bytes, "bytes of the state of these bytes");
    assert_eq!(third.load(state), Status::Ok);
    assert_eq!(fly(&third, 0.25), expected, "by way of bytes");
    third.free(state);
}

#[test]
fn a_state_object_is_reused_and_survives_being_set() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let mut state = slave.save();
    let (place, first) = (state, slave.bytes(state));
    assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    assert_eq!(api.get_state(slave.c, &mut state), Status::Ok);
    assert_eq!(state, place);
    let second = slave.bytes(state);
    assert_ne!(second, first);
    for _ in 0..3 {
        assert_eq!(slave.load(state), Status::Ok);
        assert_eq!(slave.bytes(state), second);
        assert_eq!(slave.step(0.1, 0.1), Status::Ok);
    }
    let bytes = slave.bytes(state);
    let status = api.deserialize(slave.c, &first, &mut state);
    assert_eq!((status, state), (Status::Ok, place), "bytes go into the object that is there");
    assert_ne!(slave.bytes(state), bytes);
    slave.free(state);
}

#[test]
fn a_state_brings_its_place_in_the_lifecycle_along() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let new = slave.save();
    assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
    assert_eq!(slave.begin_with(None, 0.0, Some(30.0)), Status::Ok);
    let initialising = slave.save();
    assert_eq!(slave.exit(), Status::Ok);
    let ready = slave.save();
    slave.leave_envelope();
    let (failed, time) = (slave.save(), slave.time());
    assert_eq!(slave.terminate(), Status::Ok);
    let terminated = slave.save();

    assert_eq!(slave.load(ready), Status::Ok);
    assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    assert_eq!(slave.step(0.1, 40.0), Status::Error, "the stop time is part of the state");
    assert_eq!(slave.load(failed), Status::Ok);
    assert_eq!(slave.time(), time);
    assert_eq!(slave.step(time, 0.1), Status::Error, "the run has ended");
    assert_eq!(slave.load(terminated), Status::Ok);
    assert_eq!(slave.terminate(), Status::Error);
    assert_eq!(slave.load(initialising), Status::Ok);
    assert_eq!(slave.set("mach0", 7.5), Status::Ok);
    assert_eq!(slave.exit(), Status::Ok);
    assert_eq!(slave.load(new), Status::Ok);
    slave.start();
    for state in [new, initialising, ready, failed, terminated] {
        slave.free(state);
    }
}

#[test]
fn a_restored_state_ends_the_error_of_an_impossible_trim() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(slave.begin(), Status::Ok);
    let saved = slave.save();
    assert_eq!(slave.set("altitude0", 60000.0), Status::Ok);
    assert_eq!(slave.exit(), Status::Error);
    assert_eq!(slave.load(saved), Status::Ok);
    assert_eq!(slave.set_enumeration("configuration", 1), Status::Ok);
    assert_eq!(slave.exit(), Status::Ok);
    slave.free(saved);
}

#[test]
fn damaged_truncated_and_foreign_bytes_are_refused_and_change_nothing() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    assert_eq!(slave.step(0.0, 0.1), Status::Ok);
    let saved = slave.save();
    let good = slave.bytes(saved);
    let refused = |bytes: &[u8], what: &str| {
        slave.refuses(Status::Error, &["no FMU state of this model"], |slave| {
            let (status, state) = slave.state_of(bytes);
            assert!(state.is_null(), "{what}");
            status
        });
    };
    for bit in 0..8 * good.len() {
        let mut bytes = good.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        refused(&bytes, &format!("bit {bit}"));
    }
    for length in 0..good.len() {
        refused(&good[..length], &format!("the first {length} bytes"));
    }
    let longer: Vec<u8> = good.iter().copied().chain([0]).collect();
    refused(&longer, "one byte more");
    let mut random = Random(1);
    for i in 0..1000 {
        let mut bytes: Vec<u8> = good.iter().map(|_| random.below(256) as u8).collect();
        let kept = random.below(good.len() as u64) as usize;
        bytes[..kept].copy_from_slice(&good[..kept]);
        refused(&bytes, &format!("random tail {i}"));
    }
    let now = slave.save();
    assert_eq!(slave.bytes(now), good);
    slave.free(now);
    slave.free(saved);
}

/// Magic, version, length, identity; then phase and flags.
const FIRST_NUMBER: usize = 8 + 4 + 4 + 16 + 2;

/// The bytes with their right checksum, 64-bit FNV-1a.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - 8;
    let sum = bytes[..end].iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    bytes
}

#[test]
fn no_number_of_a_state_may_be_forged_into_none() {
    let api = Api::load();
    for configuration in configurations() {
        let slave = Slave::flying_as(&api, configuration);
        assert_eq!(slave.step(0.0, 0.1), Status::Ok);
        let saved = slave.save();
        let good = slave.bytes(saved);
        slave.free(saved);
        assert_eq!(good, sealed(good.clone()), "the checksum is FNV-1a");
        let numbers = (good.len() - FIRST_NUMBER - 8) / 8;
        assert!(numbers > TABLE.len() / 2, "{numbers}");
        for number in 0..numbers {
            for value in [f64::NAN, f64::NEG_INFINITY] {
                let mut bytes = good.clone();
                let at = FIRST_NUMBER + 8 * number;
                bytes[at..at + 8].copy_from_slice(&value.to_le_bytes());
                let (status, state) = slave.state_of(&sealed(bytes));
                assert_eq!(
                    (status, state),
                    (Status::Error, null_mut()),
                    "number {number}: {value}"
                );
            }
        }
    }
}

#[test]
fn a_refused_deserialisation_leaves_an_existing_state_object_as_it_was() {
    let api = Api::load();
    let slave = Slave::flying(&api);
    let mut state = slave.save();
    let (place, good) = (state, slave.bytes(state));
    let mut bytes = good.clone();
    bytes[40] ^= 1;
    let status = api.deserialize(slave.c, &bytes, &mut state);
    assert_eq!((status, state), (Status::Error, place));
    assert_eq!(slave.bytes(state), good);
    for size in [0, good.len() - 1, good.len() + 1] {
        let mut room = vec![7_u8; good.len() + 1];
        let status = api.serialize(slave.c, state, &mut room[..size]);
        assert_eq!(status, Status::Error, "{size}");
        assert!(room.iter().all(|&byte| byte == 7), "nothing is written");
    }
    slave.free(state);
}
