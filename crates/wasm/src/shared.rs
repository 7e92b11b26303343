//! Functions that both interfaces have, in the same words: the interface declares them twice.

macro_rules! shared_functions {
    () => {
        $crate::shared::present! {
            set_debug_logging(logging_on: bool, categories: Vec<String>) -> Status;
            enter_initialization_mode(tolerance: Option<f64>, start_time: f64, stop_time: Option<f64>) -> Status;
            exit_initialization_mode() -> Status;
            enter_event_mode() -> Status;
            update_discrete_states() -> Result<DiscreteStatesInfo, Status>;
            terminate() -> Status;
            reset() -> Status;
            get_fmu_state() -> Result<Vec<u8>, Status>;
            set_fmu_state(state: Vec<u8>) -> Status;
            get_directional_derivative(unknowns: Vec<u32>, knowns: Vec<u32>, seed: Vec<f64>) -> Result<Vec<f64>, Status>;
            get_adjoint_derivative(unknowns: Vec<u32>, knowns: Vec<u32>, seed: Vec<f64>) -> Result<Vec<f64>, Status>;
            get_output_derivatives(requests: Vec<(u32, u32)>) -> Result<Vec<f64>, Status>;
        }
        $crate::shared::values! {
            get_float64 GET_FLOAT64, set_float64 SET_FLOAT64: f64, FLOAT64 |x| x, |x| x;
            get_int32 GET_INT32, set_int32 SET_INT32: i32, INT32 |x| x as i32, f64::from;
            get_int64 GET_INT64, set_int64 SET_INT64: i64, INT64 |x| x as i64, |x| x as f64;
            get_boolean GET_BOOLEAN, set_boolean SET_BOOLEAN: bool, BOOLEAN |x| x != 0.0, f64::from;
        }
        $crate::shared::absent_values! {
            get_float32 GET_FLOAT32: f32, set_float32 SET_FLOAT32: f32, FLOAT32;
            get_int8 GET_INT8: i8, set_int8 SET_INT8: i8, INT8;
            get_uint8 GET_UINT8: u8, set_uint8 SET_UINT8: u8, UINT8;
            get_int16 GET_INT16: i16, set_int16 SET_INT16: i16, INT16;
            get_uint16 GET_UINT16: u16, set_uint16 SET_UINT16: u16, UINT16;
            get_uint32 GET_UINT32: u32, set_uint32 SET_UINT32: u32, UINT32;
            get_uint64 GET_UINT64: u64, set_uint64 SET_UINT64: u64, UINT64;
            get_string GET_STRING: String, set_string SET_STRING: String, STRING;
            get_binary GET_BINARY: Vec<u8>, set_binary SET_BINARY: Vec<u8>, BINARY;
            get_clock GET_CLOCK: bool, set_clock SET_CLOCK: bool, CLOCK;
            get_interval_decimal GET_INTERVAL_DECIMAL: (f64, IntervalQualifier),
                set_interval_decimal SET_INTERVAL_DECIMAL: f64, CLOCK;
            get_interval_fraction GET_INTERVAL_FRACTION: (IntervalFraction, IntervalQualifier),
                set_interval_fraction SET_INTERVAL_FRACTION: IntervalFraction, CLOCK;
            get_shift_decimal GET_SHIFT_DECIMAL: f64, set_shift_decimal SET_SHIFT_DECIMAL: f64, CLOCK;
            get_shift_fraction GET_SHIFT_FRACTION: IntervalFraction,
                set_shift_fraction SET_SHIFT_FRACTION: IntervalFraction, CLOCK;
        }
        $crate::shared::absent! {
            enter_configuration_mode() -> Status: ENTER_CONFIGURATION_MODE, "structural parameters";
            exit_configuration_mode() -> Status: EXIT_CONFIGURATION_MODE, "structural parameters";
            evaluate_discrete_states() -> Status: EVALUATE_DISCRETE_STATES, "discrete states";
            enter_step_mode() -> Status: ENTER_STEP_MODE, "an event mode";
        }
        $crate::shared::absent_answers! {
            get_number_of_variable_dependencies(_variable: u32) -> u64:
                GET_NUMBER_OF_VARIABLE_DEPENDENCIES, "dependencies of single elements";
            get_variable_dependencies(_variable: u32) -> Vec<VariableDependency>:
                GET_VARIABLE_DEPENDENCIES, "dependencies of single elements";
        }
    };
}

macro_rules! present {
    ($($function:ident($($argument:ident: $type:ty),*) -> $answer:ty;)*) => {
        $(fn $function(&self, $($argument: $type),*) -> $answer {
            self.$function($($argument),*)
        })*
    };
}

/// How a value is made of a number, and a number of a value.
macro_rules! values {
    ($($get:ident $getter:ident, $set:ident $setter:ident: $type:ty, $kind:ident $make:expr, $number:expr;)*) => {
        $(
            fn $get(&self, references: Vec<u32>) -> Result<Vec<$type>, Status> {
                let numbers = self.get(&calls::$getter, &types::$kind, &references)?;
                Ok(numbers.into_iter().map($make).collect())
            }
            fn $set(&self, references: Vec<u32>, values: Vec<$type>) -> Status {
                let numbers: Vec<f64> = values.into_iter().map($number).collect();
                self.set(&calls::$setter, &types::$kind, &references, &numbers)
            }
        )*
    };
}

/// Types that no variable has: an empty list is read and set, any other is refused.
macro_rules! absent_values {
    ($($get:ident $getter:ident: $has:ty, $set:ident $setter:ident: $takes:ty, $kind:ident;)*) => {
        $(
            fn $get(&self, references: Vec<u32>) -> Result<Vec<$has>, Status> {
                self.get(&calls::$getter, &types::$kind, &references).map(|_| Vec::new())
            }
            fn $set(&self, references: Vec<u32>, values: Vec<$takes>) -> Status {
                let numbers = vec![f64::NAN; values.len()];
                self.set(&calls::$setter, &types::$kind, &references, &numbers)
            }
        )*
    };
}

macro_rules! absent {
    ($($function:ident() -> Status: $call:ident, $capability:literal;)*) => {
        $(fn $function(&self) -> Status {
            self.call(&calls::$call, |_| Err(Failure::NotProvided { capability: $capability }))
        })*
    };
}

macro_rules! absent_answers {
    ($($function:ident($($argument:ident: $type:ty),*) -> $answer:ty: $call:ident, $capability:literal;)*) => {
        $(fn $function(&self, $($argument: $type),*) -> Result<$answer, Status> {
            self.ask(&calls::$call, |_| Err(Failure::NotProvided { capability: $capability }))
        })*
    };
}

pub(crate) use {absent, absent_answers, absent_values, present, shared_functions, values};
