//! The library through FMI 2.0.

use super::{Completed, Package, Record, Sink, Slave, Stepped, functions, reference, same_calls};
use fmi_model::Model;
use fmi_model::instance::Interface;
use fmi_model::phase::Call;
use fmi_model::standard::Standard;
use fmi_model::v2::calls;
use fmi_model::v2::sys::{self, EventInfo, FmiString, Status, StatusKind};
use std::ffi::{CStr, c_char, c_void};

functions! { sys:
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

impl<M: Model> super::Api for Api<M> {
    type Model = M;
    const STANDARD: Standard = Standard::Fmi2;
    const CALLS: &'static [Call] = calls::CALLS;
    const REFUSED: Status = Status::Error;
    type Environment = Sink;

    fn sink(environment: &Sink) -> &Sink {
        environment
    }

    same_calls!();

    fn instantiate(
        &self,
        interface: Interface,
        package: Package,
        on: bool,
        at: &Sink,
    ) -> *mut c_void {
        let kind = match interface {
            Interface::ModelExchange => sys::Type::MODEL_EXCHANGE,
            Interface::CoSimulation => sys::Type::CO_SIMULATION,
        };
        let (name, guid) = (c"one".as_ptr(), package.token.as_ptr());
        let (functions, function, on) = (callbacks(at), self.instantiate, on.into());
        unsafe { function(name, kind, guid, package.resources(), &functions, 0, on) }
    }
    fn begin(
        &self,
        c: *mut c_void,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Status {
        match self.setup(c, tolerance, start, stop) {
            Status::Ok => unsafe { (self.enter_initialization_mode)(c) },
            refused => refused,
        }
    }

    fn get_reals(&self, c: *mut c_void, references: &[u32], values: &mut [f64]) -> Status {
        unsafe { (self.get_real)(c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }
    fn set_reals(&self, c: *mut c_void, references: &[u32], values: &[f64]) -> Status {
        unsafe { (self.set_real)(c, references.as_ptr(), references.len(), values.as_ptr()) }
    }
    fn get_enumeration(&self, c: *mut c_void, reference: u32) -> (Status, i64) {
        let mut value = -1;
        (unsafe { (self.get_integer)(c, &reference, 1, &mut value) }, value.into())
    }
    fn set_enumeration(&self, c: *mut c_void, reference: u32, value: i32) -> Status {
        unsafe { (self.set_integer)(c, &reference, 1, &value) }
    }
    fn get_boolean(&self, c: *mut c_void, reference: u32) -> (Status, bool) {
        let mut value = -1;
        (unsafe { (self.get_boolean)(c, &reference, 1, &mut value) }, value == sys::TRUE)
    }
    fn set_boolean(&self, c: *mut c_void, reference: u32, value: bool) -> Status {
        unsafe { (self.set_boolean)(c, &reference, 1, &value.into()) }
    }

    fn directional(
        &self,
        c: *mut c_void,
        y: &[u32],
        x: &[u32],
        seed: &[f64],
        changes: &mut [f64],
    ) -> Status {
        let (function, seed, changes) =
            (self.directional_derivative, seed.as_ptr(), changes.as_mut_ptr());
        unsafe { function(c, y.as_ptr(), y.len(), x.as_ptr(), x.len(), seed, changes) }
    }
    fn output_derivatives(
        &self,
        c: *mut c_void,
        outputs: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Status {
        let (count, values) = (outputs.len(), values.as_mut_ptr());
        let function = self.get_output_derivatives;
        unsafe { function(c, outputs.as_ptr(), count, orders.as_ptr(), values) }
    }

    fn step(&self, c: *mut c_void, point: f64, step: f64) -> Stepped {
        let status = unsafe { (self.do_step)(c, point, step, 0) };
        let (ended, time) = match status {
            Status::Ok | Status::Discard => (self.wants_to_end(c), self.time(c)),
            _ => (false, f64::NAN),
        };
        Stepped { status, ended, time }
    }
    fn time(&self, c: *mut c_void) -> f64 {
        let (mut time, kind) = (f64::NAN, StatusKind::LAST_SUCCESSFUL_TIME);
        assert_eq!(unsafe { (self.get_real_status)(c, kind, &mut time) }, Status::Ok);
        time
    }

    fn update(&self, c: *mut c_void) -> (Status, bool) {
        let mut event = EventInfo::default();
        let status = unsafe { (self.new_discrete_states)(c, &mut event) };
        let end = event.terminate_simulation == sys::TRUE;
        event.terminate_simulation = 0;
        assert_eq!(event, EventInfo::default(), "nothing else happens at an event");
        (status, end)
    }
    fn completed(&self, c: *mut c_void) -> Completed {
        let (mut event, mut end) = (-1, -1);
        let status = unsafe { (self.completed_integrator_step)(c, 1, &mut event, &mut end) };
        Completed { status, event: event != 0, end: end != 0 }
    }
}

impl<M: Model> Api<M> {
    fn setup(
        &self,
        c: *mut c_void,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Status {
        let (defined, tolerance) = (tolerance.is_some().into(), tolerance.unwrap_or(f64::NAN));
        let (stops, stop) = (stop.is_some().into(), stop.unwrap_or(f64::NAN));
        // SAFETY: a live instance; likewise below.
        unsafe { (self.setup_experiment)(c, defined, tolerance, start, stops, stop) }
    }

    fn wants_to_end(&self, c: *mut c_void) -> bool {
        let (mut value, kind) = (-1, StatusKind::TERMINATED);
        assert_eq!(unsafe { (self.get_boolean_status)(c, kind, &mut value) }, Status::Ok);
        value == sys::TRUE
    }
}

/// What FMI 2.0 alone has.
impl<M: Model> Slave<'_, Api<M>> {
    pub fn setup(&self) -> Status {
        self.setup_with(None, 0.0, None)
    }

    pub fn setup_with(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        self.api.setup(self.c, tolerance, start, stop)
    }

    pub fn enter(&self) -> Status {
        // SAFETY: a live instance; likewise below.
        unsafe { (self.api.enter_initialization_mode)(self.c) }
    }

    pub fn wants_to_end(&self) -> bool {
        self.api.wants_to_end(self.c)
    }

    /// The derivative of an order of an input, for the next step.
    pub fn set_input_derivative(&self, name: &str, order: i32, value: f64) -> Status {
        let input = reference::<M>(name);
        unsafe { (self.api.set_input_derivatives)(self.c, &input, 1, &order, &value) }
    }
}
