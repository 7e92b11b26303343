//! A step allocates nothing. A binary of its own: it replaces the allocator.
#![allow(unsafe_code)]

mod model;

use ahv::vehicle::DELTA_E;
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
fn verif_a_step_with_all_outputs_allocates_nothing() {
    for configuration in model::CONFIGURATIONS {
        let mut flight = model::flight(configuration);
        let before = ALLOCATIONS.with(Cell::get);
        assert!(before > 0, "the counter counts");
        for step in 1..=50 {
            flight.set_input(DELTA_E, 1e-3 * f64::from(step % 3));
            flight.advance(f64::from(step) * 0.01).unwrap();
            flight.evaluate().unwrap();
        }
        assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0, "{configuration:?}");
    }
}
