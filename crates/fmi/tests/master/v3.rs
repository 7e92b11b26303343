//! The library through FMI 3.0.

mod look;

use super::{Completed, Package, Record, Sink, Stepped, functions, same_calls};
use fmi_model::Model;
use fmi_model::instance::Interface;
use fmi_model::phase::Call;
use fmi_model::standard::Standard;
use fmi_model::v3::calls;
use fmi_model::v3::sys::{self, Boolean, FmiString, Status};
pub use look::*;
use std::ffi::{CStr, c_char, c_void};

functions! { sys:
    get_version: GetVersion "fmi3GetVersion";
    set_debug_logging: SetDebugLogging "fmi3SetDebugLogging";
    instantiate_model_exchange: InstantiateModelExchange "fmi3InstantiateModelExchange";
    instantiate_co_simulation: InstantiateCoSimulation "fmi3InstantiateCoSimulation";
    instantiate_scheduled_execution: InstantiateScheduledExecution "fmi3InstantiateScheduledExecution";
    free_instance: FreeInstance "fmi3FreeInstance";
    enter_initialization_mode: EnterInitializationMode "fmi3EnterInitializationMode";
    exit_initialization_mode: ExitInitializationMode "fmi3ExitInitializationMode";
    enter_event_mode: EnterEventMode "fmi3EnterEventMode";
    terminate: Terminate "fmi3Terminate";
    reset: Reset "fmi3Reset";
    get_float32: GetFloat32 "fmi3GetFloat32";
    get_float64: GetFloat64 "fmi3GetFloat64";
    get_int8: GetInt8 "fmi3GetInt8";
    get_uint8: GetUInt8 "fmi3GetUInt8";
    get_int16: GetInt16 "fmi3GetInt16";
    get_uint16: GetUInt16 "fmi3GetUInt16";
    get_int32: GetInt32 "fmi3GetInt32";
    get_uint32: GetUInt32 "fmi3GetUInt32";
    get_int64: GetInt64 "fmi3GetInt64";
    get_uint64: GetUInt64 "fmi3GetUInt64";
    get_boolean: GetBoolean "fmi3GetBoolean";
    get_string: GetString "fmi3GetString";
    get_binary: GetBinary "fmi3GetBinary";
    get_clock: GetClock "fmi3GetClock";
    set_float32: SetFloat32 "fmi3SetFloat32";
    set_float64: SetFloat64 "fmi3SetFloat64";
    set_int8: SetInt8 "fmi3SetInt8";
    set_uint8: SetUInt8 "fmi3SetUInt8";
    set_int16: SetInt16 "fmi3SetInt16";
    set_uint16: SetUInt16 "fmi3SetUInt16";
    set_int32: SetInt32 "fmi3SetInt32";
    set_uint32: SetUInt32 "fmi3SetUInt32";
    set_int64: SetInt64 "fmi3SetInt64";
    set_uint64: SetUInt64 "fmi3SetUInt64";
    set_boolean: SetBoolean "fmi3SetBoolean";
    set_string: SetString "fmi3SetString";
    set_binary: SetBinary "fmi3SetBinary";
    set_clock: SetClock "fmi3SetClock";
    get_number_of_variable_dependencies: GetNumberOfVariableDependencies "fmi3GetNumberOfVariableDependencies";
    get_variable_dependencies: GetVariableDependencies "fmi3GetVariableDependencies";
    get_state: GetFmuState "fmi3GetFMUState";
    set_state: SetFmuState "fmi3SetFMUState";
    free_state: FreeFmuState "fmi3FreeFMUState";
    state_size: SerializedFmuStateSize "fmi3SerializedFMUStateSize";
    serialize: SerializeFmuState "fmi3SerializeFMUState";
    deserialize: DeserializeFmuState "fmi3DeserializeFMUState";
    directional_derivative: GetDirectionalDerivative "fmi3GetDirectionalDerivative";
    adjoint_derivative: GetAdjointDerivative "fmi3GetAdjointDerivative";
    enter_configuration_mode: EnterConfigurationMode "fmi3EnterConfigurationMode";
    exit_configuration_mode: ExitConfigurationMode "fmi3ExitConfigurationMode";
    get_interval_decimal: GetIntervalDecimal "fmi3GetIntervalDecimal";
    get_interval_fraction: GetIntervalFraction "fmi3GetIntervalFraction";
    get_shift_decimal: GetShiftDecimal "fmi3GetShiftDecimal";
    get_shift_fraction: GetShiftFraction "fmi3GetShiftFraction";
    set_interval_decimal: SetIntervalDecimal "fmi3SetIntervalDecimal";
    set_interval_fraction: SetIntervalFraction "fmi3SetIntervalFraction";
    set_shift_decimal: SetShiftDecimal "fmi3SetShiftDecimal";
    set_shift_fraction: SetShiftFraction "fmi3SetShiftFraction";
    evaluate_discrete_states: EvaluateDiscreteStates "fmi3EvaluateDiscreteStates";
    update_discrete_states: UpdateDiscreteStates "fmi3UpdateDiscreteStates";
    enter_continuous_time_mode: EnterContinuousTimeMode "fmi3EnterContinuousTimeMode";
    completed_integrator_step: CompletedIntegratorStep "fmi3CompletedIntegratorStep";
    set_time: SetTime "fmi3SetTime";
    set_continuous_states: SetContinuousStates "fmi3SetContinuousStates";
    get_derivatives: GetContinuousStateDerivatives "fmi3GetContinuousStateDerivatives";
    get_event_indicators: GetEventIndicators "fmi3GetEventIndicators";
    get_continuous_states: GetContinuousStates "fmi3GetContinuousStates";
    get_nominals_of_continuous_states: GetNominalsOfContinuousStates "fmi3GetNominalsOfContinuousStates";
    get_number_of_event_indicators: GetNumberOfEventIndicators "fmi3GetNumberOfEventIndicators";
    get_number_of_continuous_states: GetNumberOfContinuousStates "fmi3GetNumberOfContinuousStates";
    enter_step_mode: EnterStepMode "fmi3EnterStepMode";
    get_output_derivatives: GetOutputDerivatives "fmi3GetOutputDerivatives";
    do_step: DoStep "fmi3DoStep";
    activate_model_partition: ActivateModelPartition "fmi3ActivateModelPartition";
}

/// Value reference of the independent variable, in the model description of every model.
pub const TIME: u32 = 2_147_483_647;
/// A flag that was not written.
pub const UNKNOWN: Boolean = Boolean(77);

pub unsafe extern "C" fn record(
    environment: *mut c_void,
    status: Status,
    category: FmiString,
    message: FmiString,
) {
    // SAFETY: the environment begins with the sink, the rest are C strings.
    unsafe {
        let text = |pointer| CStr::from_ptr(pointer).to_str().expect("UTF-8").to_string();
        let (category, message) = (text(category), text(message));
        let record = Record { name: String::new(), status, category, message };
        (*environment.cast::<Sink>()).lock().unwrap().push(record);
    }
}

/// A flag that was written.
pub fn flag(value: Boolean) -> bool {
    assert!(value.0 < 2, "{value:?} is C's true or false");
    value.is_true()
}

impl<M: Model> super::Api for Api<M> {
    type Model = M;
    const STANDARD: Standard = Standard::Fmi3;
    const CALLS: &'static [Call] = calls::CALLS;
    const REFUSED: Status = Status::Discard;
    type Environment = Environment;

    fn sink(environment: &Environment) -> &Sink {
        &environment.sink
    }

    same_calls!();

    fn instantiate(
        &self,
        interface: Interface,
        package: Package,
        on: bool,
        at: &Environment,
    ) -> *mut c_void {
        match interface {
            Interface::ModelExchange => {
                let (name, token) = (c"one".as_ptr(), package.token.as_ptr());
                let (function, no) = (self.instantiate_model_exchange, Boolean::FALSE);
                let (at, log) = (std::ptr::from_ref(at).cast_mut().cast(), Some(record as _));
                unsafe { function(name, token, package.resources(), no, on.into(), at, log) }
            }
            Interface::CoSimulation => self.co_simulation(package, on, false, &[], None, at),
        }
    }
    fn begin(
        &self,
        c: *mut c_void,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Status {
        let (defined, tolerance) = (tolerance.is_some().into(), tolerance.unwrap_or(f64::NAN));
        let (stops, stop) = (stop.is_some().into(), stop.unwrap_or(f64::NAN));
        unsafe { (self.enter_initialization_mode)(c, defined, tolerance, start, stops, stop) }
    }

    fn get_reals(&self, c: *mut c_void, references: &[u32], values: &mut [f64]) -> Status {
        let (from, count) = (references.as_ptr(), references.len());
        unsafe { (self.get_float64)(c, from, count, values.as_mut_ptr(), values.len()) }
    }
    fn set_reals(&self, c: *mut c_void, references: &[u32], values: &[f64]) -> Status {
        let (from, count) = (references.as_ptr(), references.len());
        unsafe { (self.set_float64)(c, from, count, values.as_ptr(), values.len()) }
    }
    fn get_enumeration(&self, c: *mut c_void, reference: u32) -> (Status, i64) {
        let mut value = -1;
        (unsafe { (self.get_int64)(c, &reference, 1, &mut value, 1) }, value)
    }
    fn set_enumeration(&self, c: *mut c_void, reference: u32, value: i32) -> Status {
        unsafe { (self.set_int64)(c, &reference, 1, &value.into(), 1) }
    }
    fn get_boolean(&self, c: *mut c_void, reference: u32) -> (Status, bool) {
        let mut value = UNKNOWN;
        (unsafe { (self.get_boolean)(c, &reference, 1, &mut value, 1) }, value.is_true())
    }
    fn set_boolean(&self, c: *mut c_void, reference: u32, value: bool) -> Status {
        unsafe { (self.set_boolean)(c, &reference, 1, &value.into(), 1) }
    }

    fn directional(
        &self,
        c: *mut c_void,
        y: &[u32],
        x: &[u32],
        seed: &[f64],
        changes: &mut [f64],
    ) -> Status {
        let (ys, xs) = ((y.as_ptr(), y.len()), (x.as_ptr(), x.len()));
        let (from, to) = ((seed.as_ptr(), seed.len()), (changes.as_mut_ptr(), changes.len()));
        let function = self.directional_derivative;
        unsafe { function(c, ys.0, ys.1, xs.0, xs.1, from.0, from.1, to.0, to.1) }
    }
    fn output_derivatives(
        &self,
        c: *mut c_void,
        outputs: &[u32],
        orders: &[i32],
        values: &mut [f64],
    ) -> Status {
        let (from, count, orders) = (outputs.as_ptr(), outputs.len(), orders.as_ptr());
        let function = self.get_output_derivatives;
        unsafe { function(c, from, count, orders, values.as_mut_ptr(), values.len()) }
    }

    fn step(&self, c: *mut c_void, point: f64, step: f64) -> Stepped {
        let [mut event, mut end, mut early] = [UNKNOWN; 3];
        let (no, mut time, function) = (Boolean::FALSE, f64::NAN, self.do_step);
        let status =
            unsafe { function(c, point, step, no, &mut event, &mut end, &mut early, &mut time) };
        let done = status == Status::Ok;
        let nothing = if done { no } else { UNKNOWN };
        assert_eq!([event, early], [nothing; 2], "neither is allowed");
        assert_eq!((time.is_nan(), end == UNKNOWN), (!done, !done), "all answers or none");
        Stepped { status, ended: done && flag(end), time }
    }
    fn time(&self, c: *mut c_void) -> f64 {
        let mut time = [f64::NAN];
        assert_eq!(self.get_reals(c, &[TIME], &mut time), Status::Ok);
        time[0]
    }

    fn update(&self, c: *mut c_void) -> (Status, bool) {
        let [mut again, mut end, mut nominals, mut values, mut next] = [UNKNOWN; 5];
        let (mut time, function) = (f64::NAN, self.update_discrete_states);
        let status = unsafe {
            function(c, &mut again, &mut end, &mut nominals, &mut values, &mut next, &mut time)
        };
        let done = status == Status::Ok;
        let nothing = if done { Boolean::FALSE } else { UNKNOWN };
        assert_eq!([again, nominals, values, next], [nothing; 4], "nothing else happens");
        (status, done && flag(end))
    }
    fn completed(&self, c: *mut c_void) -> Completed {
        let [mut event, mut end] = [UNKNOWN; 2];
        let function = self.completed_integrator_step;
        let status = unsafe { function(c, Boolean::TRUE, &mut event, &mut end) };
        let done = status == Status::Ok;
        Completed { status, event: done && flag(event), end: done && flag(end) }
    }
}
