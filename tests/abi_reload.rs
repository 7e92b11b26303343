//! The library loaded and unloaded again and again, and memory after many instances.
//!
//! A binary with one test: another one in this process would keep the library loaded.

#[path = "abi/common.rs"]
mod common;
#[path = "../crates/fmi/tests/master/mod.rs"]
mod master;

use common::{fmi2, fmi3};
use fmi_model::status::Status;
use master::{Api, Slave};
use std::sync::mpsc::channel;
use std::thread;

/// A version of the vehicle's library.
trait Vehicle: Api<Model = ahv::flight::Setup> {}
impl<A: Api<Model = ahv::flight::Setup>> Vehicle for A {}

fn fly<A: Vehicle>(api: &A) {
    let slave = Slave::flying(api);
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
    let state = slave.save();
    slave.free(state);
    assert_eq!(slave.set("V", 1.0), Status::Error);
}

fn load_fly_unload<A: Vehicle>() {
    let api = A::load();
    fly(&api);
    api.close();
}

/// Whether the library is mapped into this process.
#[cfg(target_os = "linux")]
fn loaded() -> bool {
    let name = libloading::library_filename("ahv").into_string().unwrap();
    std::fs::read_to_string("/proc/self/maps").unwrap().contains(&format!("/{name}"))
}

/// Resident memory of this process, pages of mostly 4 KiB.
#[cfg(target_os = "linux")]
fn resident_pages() -> u64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap();
    text.split(' ').nth(1).unwrap().parse().unwrap()
}

#[cfg(target_os = "linux")]
fn assert_bounded(before: u64) {
    let now = resident_pages();
    println!("{before} pages before, {now} after");
    assert!(now < before + NO_GROWTH, "{} pages more", now - before);
}

/// Loads, flies and unloads so often; whatever this leaves behind adds up.
fn reload(alone: u32, in_threads: u32) {
    for i in 0..alone {
        if i % 2 == 0 {
            load_fly_unload::<fmi2::Api>()
        } else {
            load_fly_unload::<fmi3::Api>()
        }
        #[cfg(target_os = "linux")]
        assert!(!loaded(), "something of the library outlives it");
    }
    for _ in 0..in_threads / THREADS {
        let threads: Vec<_> = [load_fly_unload::<fmi2::Api>, load_fly_unload::<fmi3::Api>]
            .into_iter()
            .cycle()
            .take(THREADS as usize)
            .map(thread::spawn)
            .collect();
        threads.into_iter().for_each(|thread| thread.join().unwrap());
    }
    #[cfg(target_os = "linux")]
    assert!(!loaded());
}

const THREADS: u32 = 4;
/// Growth of the resident memory that is still none, pages: what the allocator keeps for itself.
/// Were a hundred bytes lost in each of 5,000 cycles, it would be half of this.
const NO_GROWTH: u64 = 256;

#[test]
fn the_library_unloads_for_good_every_time_and_instances_leave_no_memory_behind() {
    reload(800, 800);
    #[cfg(target_os = "linux")]
    let before = resident_pages();
    reload(8000, 2000);
    #[cfg(target_os = "linux")]
    assert_bounded(before);

    // A thread that used an instance ends after the library is gone.
    let ((used, wait_for_use), (unloaded, wait_for_unload)) = (channel(), channel());
    let thread = thread::spawn(move || {
        let api = fmi3::Api::load();
        fly(&api);
        used.send(api).unwrap();
        wait_for_unload.recv().unwrap();
    });
    wait_for_use.recv().unwrap().close();
    #[cfg(target_os = "linux")]
    assert!(!loaded());
    unloaded.send(()).unwrap();
    thread.join().unwrap();

    grow_by_nothing(&fmi2::Api::load());
    grow_by_nothing(&fmi3::Api::load());
}

/// Instances that come and go leave nothing behind.
fn grow_by_nothing<A: Vehicle>(api: &A) {
    let instances = |count: u32| (0..count).for_each(|_| fly(api));
    instances(500);
    #[cfg(target_os = "linux")]
    let before = resident_pages();
    instances(5000);
    #[cfg(target_os = "linux")]
    assert_bounded(before);
}
