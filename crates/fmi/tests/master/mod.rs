//! A master in Rust, for tests of any model's shared library, in both versions of the standard.
#![allow(unsafe_code, dead_code)]

use fmi_model::Model;
use fmi_model::instance::Interface;
use fmi_model::phase::Call;
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use libloading::library_filename;
use std::ffi::{CStr, c_char, c_void};
use std::path::PathBuf;
use std::ptr::null;
use std::sync::Mutex;

pub mod fuzz;
pub mod order;
mod random;
mod slave;
pub mod v2;
pub mod v3;
#[allow(unused_imports)]
pub use {random::Random, slave::*};

/// The library that `cargo test` built: beside the test's own executable, or one folder up.
pub fn library_path<M: Model>() -> PathBuf {
    let test = std::env::current_exe().expect("the path of this test");
    let name = library_filename(M::ABOUT.identifier);
    test.ancestors()
        .skip(1)
        .take(2)
        .map(|folder| folder.join(&name))
        .find(|path| path.exists())
        .expect("the shared library beside the test")
}

/// What a logger was told. FMI 3.0 does not say by which instance.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    pub name: String,
    pub status: Status,
    pub category: String,
    pub message: String,
}

/// Where a logger keeps it.
pub type Sink = Mutex<Vec<Record>>;

/// What a master says of the package that it instantiates.
#[derive(Debug, Clone, Copy)]
pub struct Package<'a> {
    /// GUID or instantiation token.
    pub token: &'a CStr,
    /// Where the resources are.
    pub resources: Option<&'a CStr>,
}

impl Package<'_> {
    /// The resources as C has them.
    pub fn resources(&self) -> *const c_char {
        self.resources.map_or(null(), CStr::as_ptr)
    }
}

/// What a step came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepped {
    pub status: Status,
    /// Whether the simulation should end.
    pub ended: bool,
    /// The end of the last step, s.
    pub time: f64,
}

/// Answers at the end of an integrator's step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Completed {
    pub status: Status,
    pub event: bool,
    pub end: bool,
}

/// A model's library in a version of the standard: all its functions, and the calls that both versions have.
///
/// Instances are those of the same library and alive; arrays have the lengths given, which are those needed.
pub trait Api: Sized + Sync {
    type Model: Model;
    const STANDARD: Standard;
    const CALLS: &'static [Call];
    /// What is returned for a value that a variable cannot take.
    const REFUSED: Status;
    /// What the environment pointer leads to.
    type Environment: Default;
    /// Where messages go.
    fn sink(environment: &Self::Environment) -> &Sink;

    /// Loads the library and all functions.
    fn load() -> Self;
    /// Unloads the library.
    fn close(self);

    /// A new instance, whose logger records into the sink of the environment.
    fn instantiate(
        &self,
        interface: Interface,
        package: Package,
        on: bool,
        at: &Self::Environment,
    ) -> *mut c_void;
    fn free(&self, c: *mut c_void);
    fn switch_logging(&self, c: *mut c_void, on: bool, categories: &[*const c_char]) -> Status;
    /// Tells of the experiment and enters the initialization mode.
    fn begin(
        &self,
        c: *mut c_void,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Status;
    fn exit(&self, c: *mut c_void) -> Status;
    fn terminate(&self, c: *mut c_void) -> Status;
    fn reset(&self, c: *mut c_void) -> Status;

    fn get_reals(&self, c: *mut c_void, references: &[u32], values: &mut [f64]) -> Status;
    fn set_reals(&self, c: *mut c_void, references: &[u32], values: &[f64]) -> Status;
    fn get_enumeration(&self, c: *mut c_void, reference: u32) -> (Status, i64);
    fn set_enumeration(&self, c: *mut c_void, reference: u32, value: i32) -> Status;
    fn get_boolean(&self, c: *mut c_void, reference: u32) -> (Status, bool);
    fn set_boolean(&self, c: *mut c_void, reference: u32, value: bool) -> Status;

    fn get_state(&self, c: *mut c_void, state: &mut *mut c_void) -> Status;
    fn set_state(&self, c: *mut c_void, state: *mut c_void) -> Status;
    fn free_state(&self, c: *mut c_void, state: &mut *mut c_void) -> Status;
    fn state_size(&self, c: *mut c_void, state: *mut c_void, size: &mut usize) -> Status;
    fn serialize(&self, c: *mut c_void, state: *mut c_void, bytes: &mut [u8]) -> Status;
    fn deserialize(&self, c: *mut c_void, bytes: &[u8], state: &mut *mut c_void) -> Status;

    /// Changes of `unknowns` for changes `seed` of `knowns`.
    fn directional(
        &self,
        c: *mut c_void,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        changes: &mut [f64],
    ) -> Status;
    fn output_derivatives(
        &self,
        c: *mut c_void,
        outputs: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Status;

    fn step(&self, c: *mut c_void, point: f64, step: f64) -> Stepped;
    /// Present time of an instance for co-simulation, s.
    fn time(&self, c: *mut c_void) -> f64;

    fn enter_event_mode(&self, c: *mut c_void) -> Status;
    /// Handles events; whether the simulation should end.
    fn update(&self, c: *mut c_void) -> (Status, bool);
    fn enter_continuous_time_mode(&self, c: *mut c_void) -> Status;
    fn completed(&self, c: *mut c_void) -> Completed;
    fn set_time(&self, c: *mut c_void, time: f64) -> Status;
    fn set_states(&self, c: *mut c_void, states: &[f64]) -> Status;
    fn get_states(&self, c: *mut c_void, states: &mut [f64]) -> Status;
    fn get_rates(&self, c: *mut c_void, rates: &mut [f64]) -> Status;
}

/// The functions of a library by their names, in a structure.
macro_rules! functions {
    ($sys:ident: $($field:ident: $function:ident $name:literal;)*) => {
        /// All functions of a model's library.
        pub struct Api<M> {
            $(pub $field: $sys::$function,)*
            library: libloading::Library,
            model: std::marker::PhantomData<fn() -> M>,
        }

        impl<M: fmi_model::Model> Api<M> {
            fn loaded() -> Self {
                let path = $crate::master::library_path::<M>();
                // SAFETY: the library has no initialiser, and the types are proved elsewhere.
                unsafe {
                    let library = libloading::Library::new(path).expect("the library loads");
                    Self {
                        $($field: *library.get($name).expect($name),)*
                        library,
                        model: std::marker::PhantomData,
                    }
                }
            }
        }
    };
}
pub(crate) use functions;

/// The calls whose C types are the same in both versions.
macro_rules! same_calls {
    () => {
        fn load() -> Self {
            Self::loaded()
        }
        fn close(self) {
            self.library.close().expect("the library unloads");
        }
        // SAFETY of all: by the trait's contract.
        fn free(&self, c: *mut c_void) {
            unsafe { (self.free_instance)(c) }
        }
        fn switch_logging(&self, c: *mut c_void, on: bool, names: &[*const c_char]) -> Status {
            unsafe { (self.set_debug_logging)(c, on.into(), names.len(), names.as_ptr()) }
        }
        fn exit(&self, c: *mut c_void) -> Status {
            unsafe { (self.exit_initialization_mode)(c) }
        }
        fn terminate(&self, c: *mut c_void) -> Status {
            unsafe { (self.terminate)(c) }
        }
        fn reset(&self, c: *mut c_void) -> Status {
            unsafe { (self.reset)(c) }
        }
        fn get_state(&self, c: *mut c_void, state: &mut *mut c_void) -> Status {
            unsafe { (self.get_state)(c, state) }
        }
        fn set_state(&self, c: *mut c_void, state: *mut c_void) -> Status {
            unsafe { (self.set_state)(c, state) }
        }
        fn free_state(&self, c: *mut c_void, state: &mut *mut c_void) -> Status {
            unsafe { (self.free_state)(c, state) }
        }
        fn state_size(&self, c: *mut c_void, state: *mut c_void, size: &mut usize) -> Status {
            unsafe { (self.state_size)(c, state, size) }
        }
        fn serialize(&self, c: *mut c_void, state: *mut c_void, bytes: &mut [u8]) -> Status {
            unsafe { (self.serialize)(c, state, bytes.as_mut_ptr().cast(), bytes.len()) }
        }
        fn deserialize(&self, c: *mut c_void, bytes: &[u8], state: &mut *mut c_void) -> Status {
            unsafe { (self.deserialize)(c, bytes.as_ptr().cast(), bytes.len(), state) }
        }
        fn enter_event_mode(&self, c: *mut c_void) -> Status {
            unsafe { (self.enter_event_mode)(c) }
        }
        fn enter_continuous_time_mode(&self, c: *mut c_void) -> Status {
            unsafe { (self.enter_continuous_time_mode)(c) }
        }
        fn set_time(&self, c: *mut c_void, time: f64) -> Status {
            unsafe { (self.set_time)(c, time) }
        }
        fn set_states(&self, c: *mut c_void, states: &[f64]) -> Status {
            unsafe { (self.set_continuous_states)(c, states.as_ptr(), states.len()) }
        }
        fn get_states(&self, c: *mut c_void, states: &mut [f64]) -> Status {
            unsafe { (self.get_continuous_states)(c, states.as_mut_ptr(), states.len()) }
        }
        fn get_rates(&self, c: *mut c_void, rates: &mut [f64]) -> Status {
            unsafe { (self.get_derivatives)(c, rates.as_mut_ptr(), rates.len()) }
        }
    };
}
pub(crate) use same_calls;
