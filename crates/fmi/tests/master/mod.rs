//! A master in Rust, for tests of any model's shared library.
#![allow(unsafe_code, dead_code)]

use fmi_model::Model;
use fmi_model::v2::sys::{self, FmiString, Status};
use libloading::{Library, library_filename};
use std::ffi::{CStr, c_void};
use std::marker::PhantomData;
use std::path::PathBuf;
use std::sync::Mutex;

pub mod fuzz;
pub mod order;
mod slave;
#[allow(unused_imports)]
pub use slave::*;

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

macro_rules! api {
    ($($field:ident: $function:ident $name:literal;)*) => {
        /// All functions of a model's library.
        pub struct Api<M> {
            $(pub $field: sys::$function,)*
            library: Library,
            model: PhantomData<fn() -> M>,
        }

        impl<M: Model> Api<M> {
            /// Loads the library and all functions.
            pub fn load() -> Self {
                // SAFETY: the library has no initialiser, and the types are proved elsewhere.
                unsafe {
                    let library = Library::new(library_path::<M>()).expect("the library loads");
                    Self {
                        $($field: *library.get($name).expect($name),)*
                        library,
                        model: PhantomData,
                    }
                }
            }

            /// Unloads the library.
            pub fn close(self) {
                self.library.close().expect("the library unloads");
            }
        }
    };
}

api! {
    get_types_platform: GetTypesPlatform "fmi2GetTypesPlatform";
    get_version: GetVersion "fmi2GetVersion";
    set_debug_logging: SetDebugLogging "fmi2SetDebugLogging";
    instantiate: Instantiate "fmi2Instantiate";
    free_instance: FreeInstance "fmi2FreeInstance";
    setup_experiment: SetupExperiment "fmi2SetupExperiment";
    enter_initialization_mode: EnterInitializationMode "fmi2EnterInitializationMode";
    exit_initialization_mode: ExitInitializationMode "fmi2ExitInitializationMode";
    terminate: Terminate "fmi2Terminate";
    reset: Reset "fmi2Reset";
    get_real: GetReal "fmi2GetReal";
    get_integer: GetInteger "fmi2GetInteger";
    get_boolean: GetBoolean "fmi2GetBoolean";
    get_string: GetString "fmi2GetString";
    set_real: SetReal "fmi2SetReal";
    set_integer: SetInteger "fmi2SetInteger";
    set_boolean: SetBoolean "fmi2SetBoolean";
    set_string: SetString "fmi2SetString";
    get_state: GetFmuState "fmi2GetFMUstate";
    set_state: SetFmuState "fmi2SetFMUstate";
    free_state: FreeFmuState "fmi2FreeFMUstate";
    state_size: SerializedFmuStateSize "fmi2SerializedFMUstateSize";
    serialize: SerializeFmuState "fmi2SerializeFMUstate";
    deserialize: DeSerializeFmuState "fmi2DeSerializeFMUstate";
    directional_derivative: GetDirectionalDerivative "fmi2GetDirectionalDerivative";
    set_input_derivatives: SetRealInputDerivatives "fmi2SetRealInputDerivatives";
    get_output_derivatives: GetRealOutputDerivatives "fmi2GetRealOutputDerivatives";
    enter_event_mode: EnterEventMode "fmi2EnterEventMode";
    new_discrete_states: NewDiscreteStates "fmi2NewDiscreteStates";
    enter_continuous_time_mode: EnterContinuousTimeMode "fmi2EnterContinuousTimeMode";
    completed_integrator_step: CompletedIntegratorStep "fmi2CompletedIntegratorStep";
    set_time: SetTime "fmi2SetTime";
    set_continuous_states: SetContinuousStates "fmi2SetContinuousStates";
    get_derivatives: GetDerivatives "fmi2GetDerivatives";
    get_event_indicators: GetEventIndicators "fmi2GetEventIndicators";
    get_continuous_states: GetContinuousStates "fmi2GetContinuousStates";
    get_nominals_of_continuous_states: GetNominalsOfContinuousStates "fmi2GetNominalsOfContinuousStates";
    do_step: DoStep "fmi2DoStep";
    cancel_step: CancelStep "fmi2CancelStep";
    get_status: GetStatus "fmi2GetStatus";
    get_real_status: GetRealStatus "fmi2GetRealStatus";
    get_integer_status: GetIntegerStatus "fmi2GetIntegerStatus";
    get_boolean_status: GetBooleanStatus "fmi2GetBooleanStatus";
    get_string_status: GetStringStatus "fmi2GetStringStatus";
}

/// What a logger was told.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    pub name: String,
    pub status: Status,
    pub category: String,
    pub message: String,
}

/// Where a logger keeps it; its address is the environment pointer.
pub type Sink = Mutex<Vec<Record>>;

unsafe extern "C" fn record(
    environment: *mut c_void,
    name: FmiString,
    status: Status,
    category: FmiString,
    message: FmiString,
) {
    // SAFETY: the environment is the sink that was handed to fmi2Instantiate, the rest C strings.
    unsafe {
        let text = |pointer| CStr::from_ptr(pointer).to_str().expect("UTF-8").to_string();
        let record =
            Record { name: text(name), status, category: text(category), message: text(message) };
        (*environment.cast::<Sink>()).lock().unwrap().push(record);
    }
}

/// The recording logger. Called without variable arguments, a function of C's variadic kind is
/// called like any other.
pub fn recorder() -> sys::CallbackLogger {
    // SAFETY: see above.
    unsafe {
        std::mem::transmute::<
            unsafe extern "C" fn(*mut c_void, FmiString, Status, FmiString, FmiString),
            sys::CallbackLogger,
        >(record)
    }
}

/// Callbacks with a logger that records into `sink`.
pub fn callbacks(sink: &Sink) -> sys::CallbackFunctions {
    sys::CallbackFunctions {
        logger: Some(recorder()),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        environment: std::ptr::from_ref(sink).cast_mut().cast(),
    }
}
