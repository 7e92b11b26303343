//! A step allocates nothing. A binary of its own: it replaces the allocator.
#![allow(unsafe_code)]

use ahv_actuator::Actuator;
use fmi_model::{Model, Simulation};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// Counts what this thread asks the system's allocator for.
struct Counting;

// SAFETY: every call is handed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promise is ours.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is ours.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn verif_a_step_with_a_full_delay_allocates_nothing() {
    let actuator = Actuator { delay: 0.25, ..Actuator::DEFAULT };
    let mut running = actuator.start(0.0, 1e-6).unwrap();
    let before = ALLOCATIONS.with(Cell::get);
    assert!(before > 0, "the counter counts");
    for step in 1..=3000 {
        running.set_input(0, f64::from(step % 7) - 3.0);
        running.advance(f64::from(step) * 1e-3).unwrap();
        running.evaluate().unwrap();
    }
    assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0);
}
