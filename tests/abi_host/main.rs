//! What a demanding host grants a call: no floating-point exception, as it would trap it, and little stack.
//!
//! A binary of its own: what it looks for ends the process.
//! The compiler vectorises and speculates in a release build only, so `cargo ahv test` runs this in both.

#![cfg(all(target_os = "linux", target_env = "gnu"))]
#![allow(unsafe_code)]

#[path = "../abi/common.rs"]
mod common;
mod edges;
mod flights;
mod host;
#[path = "../../crates/fmi/tests/master/mod.rs"]
mod master;
mod versions;
mod watch;

use common::{fmi2, fmi3};
use fmi_model::instance::Interface;
use fmi_model::phase::Call;
use master::Api as _;
use watch::Watch;

/// Stack that a call may use, bytes.
const STACK: usize = 64 << 10;
/// Stack of the smallest thread that hosts an FMU, bytes: the default of musl.
const SMALL_THREAD: usize = 128 << 10;

#[test]
fn no_call_raises_a_floating_point_exception_or_needs_more_than_64_kb_of_stack() {
    let api = fmi2::Api::load();
    let mut watch = Watch::default();
    for vehicle in flights::vehicles() {
        flights::co_simulation(&api, &mut watch, vehicle);
        flights::model_exchange(&api, &mut watch, vehicle);
    }
    edges::parameters(&api, &mut watch);
    edges::arguments(&api, &mut watch);
    forgives_nothing(&watch, fmi2::Api::CALLS);
}

#[test]
fn fmi3_flies_with_the_bits_of_fmi2_and_asks_no_more_of_its_host() {
    let mut watch = Watch::default();
    versions::compare(&mut watch);
    flights::vehicles().for_each(|vehicle| versions::look(&mut watch, vehicle));
    versions::every_function(&mut watch);
    forgives_nothing(&watch, fmi3::Api::CALLS);
}

/// No exception was raised, no stack was exceeded, and every function was called.
fn forgives_nothing(watch: &Watch, calls: &'static [Call]) {
    let mut deepest: Vec<_> = watch.deepest.iter().collect();
    deepest.sort_by_key(|(_, depth)| std::cmp::Reverse(**depth));
    println!("{} calls; stack, bytes: {:?}", watch.calls, &deepest[..5]);
    assert!(watch.raised.is_empty(), "{:#?}", watch.raised);
    assert!(deepest.iter().all(|(_, depth)| **depth <= STACK), "{deepest:?}");
    let unused = watch.not_called(calls);
    assert!(unused.is_empty(), "every function is watched: {unused:?}");
}

#[test]
fn a_host_that_traps_floating_point_exceptions_flies() {
    let trapping = || {
        // A trap would end this process.
        watch::trap();
        flights::vehicles().for_each(|vehicle| flights::short(&fmi2::Api::load(), vehicle));
        flights::vehicles().for_each(versions::short);
    };
    std::thread::spawn(trapping).join().unwrap();
}

#[test]
fn a_whole_flight_fits_into_a_thread_of_128_kb() {
    let fly = || {
        flights::vehicles().for_each(|vehicle| flights::short(&fmi2::Api::load(), vehicle));
        flights::vehicles().for_each(versions::short);
    };
    // More than is there would end this process.
    std::thread::Builder::new().stack_size(SMALL_THREAD).spawn(fly).unwrap().join().unwrap();
}

#[test]
fn the_watch_sees_exceptions_and_stack() {
    let mut watch = Watch::default();
    let zero = std::hint::black_box(0.0);
    watch.call("division", "", || std::hint::black_box(1.0 / zero));
    watch.call("nothing", "", || ());
    watch.call("deep", "", || std::hint::black_box([1_u8; 100_000])[7]);
    assert_eq!(watch.raised.len(), 1);
    assert!(watch.raised.iter().next().unwrap().starts_with("division"));
    assert!((100_000..110_000).contains(&watch.deepest["deep"]), "{:?}", watch.deepest);
    assert!(watch.deepest["nothing"] < 2000, "{:?}", watch.deepest);
}

/// Both interfaces.
const INTERFACES: [Interface; 2] = [Interface::CoSimulation, Interface::ModelExchange];
