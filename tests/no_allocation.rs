//! A step allocates nothing. A binary of its own: it replaces the allocator.
#![allow(unsafe_code)]

mod model;

use ahv::flight::Setup;
use ahv::vehicle::DELTA_E;
use fmi_model::failure::Outcome;
use fmi_model::instance::{Instance, Interface};
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

/// A step of an instance, from a point and so long, s.
type Step = fn(&mut Instance<Setup>, f64, f64) -> Outcome;

#[test]
fn a_step_of_an_instance_allocates_nothing_in_either_version_once_it_has_made_one() {
    for step in [Instance::do_step as Step, Instance::whole_step] {
        let mut instance = Instance::<Setup>::new(Interface::CoSimulation, false).unwrap();
        instance.setup_experiment(None, 0.0, None).unwrap();
        instance.enter_initialization_mode().unwrap();
        instance.exit_initialization_mode().unwrap();
        step(&mut instance, 0.0, 0.01).unwrap();
        let before = ALLOCATIONS.with(Cell::get);
        for i in 1..50 {
            step(&mut instance, f64::from(i) * 0.01, 0.01).unwrap();
            instance.get_real(&[0, 1], |_, value| assert!(value.is_finite())).unwrap();
        }
        assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0);
    }
}
