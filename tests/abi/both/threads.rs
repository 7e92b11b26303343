//! Instances in threads.

use super::{Api, Slave};
use crate::common::configurations;
use crate::master::Api as _;
use fmi_model::status::Status;
use std::thread;

const THREADS: u32 = 8;

/// One flight with its own input: bits of all values after each step, interleaved with the others.
fn flights(api: &Api, seed: u32) -> Vec<Vec<u64>> {
    let slaves: Vec<_> = configurations().into_iter().map(|n| Slave::flying_as(api, n)).collect();
    let mut bits = Vec::new();
    for step in 0..10 {
        for (i, slave) in (0..).zip(&slaves) {
            let delta_e = 0.001 * f64::from(seed) - 0.002 * f64::from(i);
            assert_eq!(slave.set("delta_e", delta_e), Status::Ok);
            assert_eq!(slave.step(f64::from(step) * 0.05, 0.05), Status::Ok);
            bits.push(slave.bits());
        }
    }
    bits
}

#[test]
fn many_instances_in_many_threads_give_the_bits_of_one_after_the_other() {
    let api = Api::load();
    let serial: Vec<_> = (0..THREADS).map(|seed| flights(&api, seed)).collect();
    let parallel: Vec<_> = thread::scope(|scope| {
        let threads: Vec<_> = (0..THREADS)
            .map(|seed| {
                scope.spawn({
                    let api = &api;
                    move || flights(api, seed)
                })
            })
            .collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert_eq!(serial, parallel);
}

/// An instance handed from thread to thread, never used by two at once.
struct Handed<'a>(Slave<'a>);

// SAFETY: the FMU keeps nothing per thread; that is what the test shows.
unsafe impl Send for Handed<'_> {}

#[test]
fn an_instance_outlives_the_threads_that_used_it() {
    let api = Api::load();
    let mut handed = Handed(Slave::flying(&api));
    let stay = Slave::flying(&api);
    for i in 0..10 {
        let point = f64::from(i) * 0.1;
        handed = thread::scope(|scope| {
            let step = move || {
                let whole = handed;
                assert_eq!(whole.0.set("delta_e", 0.01), Status::Ok);
                assert_eq!(whole.0.step(point, 0.1), Status::Ok);
                whole
            };
            scope.spawn(step).join().unwrap()
        });
        assert_eq!(stay.set("delta_e", 0.01), Status::Ok);
        assert_eq!(stay.step(point, 0.1), Status::Ok);
        assert_eq!(handed.0.bits(), stay.bits());
    }
}
