//! A step allocates nothing, and no data file makes the library allocate much. A binary of its own: it replaces the
//! allocator.
#![allow(unsafe_code)]

mod model;

use ahv::data::{DataFile, VEHICLE, VehicleData};
use ahv::flight::Setup;
use ahv::vehicle::DELTA_E;
use fmi_model::failure::Outcome;
use fmi_model::instance::{Instance, Interface};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    /// Bytes in use, of what this thread allocated and freed, and their largest number.
    static LIVE: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
}

/// Counts what this thread asks the system's allocator for.
struct Counting;

// SAFETY: every call is handed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        LIVE.with(|live| live.set(live.get() + layout.size() as isize));
        PEAK.with(|peak| peak.set(peak.get().max(LIVE.with(Cell::get))));
        // SAFETY: the caller's promise is ours.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        LIVE.with(|live| live.set(live.get() - layout.size() as isize));
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

/// Bytes that a hostile file may cost.
const MOST_BYTES: isize = 64_000_000;

#[test]
fn verif_no_data_file_costs_more_than_64_mb() {
    let numbers = |count: usize| format!("x = [{}]", "0,".repeat(count));
    let stations = VEHICLE.text.replacen(
        "mass_kg_per_m",
        &format!("# {}\nmass_kg_per_m", "9".repeat(900_000)),
        1,
    );
    for text in [
        "x = ".to_string() + &"[".repeat(900_000),
        "x = ".to_string() + &"{a=".repeat(300_000),
        numbers(9_990),
        numbers(450_000),
        (0..90_000).map(|i| format!("k{i}=1\n")).collect(),
        "[[a]]\n".repeat(150_000),
        format!("x = \"{}\"", "a".repeat(900_000)),
        stations,
    ] {
        let before = LIVE.with(Cell::get);
        PEAK.with(|peak| peak.set(before));
        let _ = VehicleData::parse("mine.toml", &text);
        let cost = PEAK.with(Cell::get) - before;
        assert!(cost > 0 && cost < MOST_BYTES, "{cost} bytes for {}", &text[..20]);
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
