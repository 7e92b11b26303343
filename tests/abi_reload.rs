//! The library loaded and unloaded again and again, and memory after many instances.
//!
//! One test only: a second one in this process would keep the library loaded.

mod common;

use ahv::fmi::sys::Status;
use common::{Api, Slave};
use std::sync::mpsc::channel;
use std::thread;

fn fly(api: &Api) {
    let slave = Slave::flying(api);
    assert_eq!(slave.step(0.0, 0.01), Status::Ok);
    let state = slave.save();
    slave.free(state);
    assert_eq!(slave.set("V", 1.0), Status::Error);
}

fn load_fly_unload() {
    let api = Api::load();
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

#[test]
fn the_library_unloads_for_good_every_time_and_instances_leave_no_memory_behind() {
    for _ in 0..200 {
        load_fly_unload();
        #[cfg(target_os = "linux")]
        assert!(!loaded(), "something of the library outlives it");
    }
    for _ in 0..50 {
        let threads: Vec<_> = (0..4).map(|_| thread::spawn(load_fly_unload)).collect();
        threads.into_iter().for_each(|thread| thread.join().unwrap());
    }
    #[cfg(target_os = "linux")]
    assert!(!loaded());

    // A thread that used an instance ends after the library is gone.
    let ((used, wait_for_use), (unloaded, wait_for_unload)) = (channel(), channel());
    let thread = thread::spawn(move || {
        let api = Api::load();
        fly(&api);
        used.send(api).unwrap();
        wait_for_unload.recv().unwrap();
    });
    wait_for_use.recv().unwrap().close();
    #[cfg(target_os = "linux")]
    assert!(!loaded());
    unloaded.send(()).unwrap();
    thread.join().unwrap();

    let api = Api::load();
    let instances = |count: u32| (0..count).for_each(|_| fly(&api));
    instances(500);
    #[cfg(target_os = "linux")]
    let before = resident_pages();
    instances(5000);
    #[cfg(target_os = "linux")]
    assert!(resident_pages() < before + 256, "{} pages more", resident_pages() - before);
}
