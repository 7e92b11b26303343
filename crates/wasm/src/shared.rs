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
            get_float64(references: Vec<u32>) -> Result<Vec<f64>, Status>;
            get_int64(references: Vec<u32>) -> Result<Vec<i64>, Status>;
            get_boolean(references: Vec<u32>) -> Result<Vec<bool>, Status>;
            set_float64(references: Vec<u32>, values: Vec<f64>) -> Status;
            set_int64(references: Vec<u32>, values: Vec<i64>) -> Status;
            set_boolean(references: Vec<u32>, values: Vec<bool>) -> Status;
            get_directional_derivative(unknowns: Vec<u32>, knowns: Vec<u32>, seed: Vec<f64>) -> Result<Vec<f64>, Status>;
            get_output_derivatives(requests: Vec<(u32, u32)>) -> Result<Vec<f64>, Status>;
        }
        $crate::shared::absent_types! {
            get_float32 GET_FLOAT32, set_float32 SET_FLOAT32: f32, "Float32";
            get_int8 GET_INT8, set_int8 SET_INT8: i8, "Int8";
            get_int16 GET_INT16, set_int16 SET_INT16: i16, "Int16";
            get_int32 GET_INT32, set_int32 SET_INT32: i32, "Int32";
            get_uint8 GET_UINT8, set_uint8 SET_UINT8: u8, "UInt8";
            get_uint16 GET_UINT16, set_uint16 SET_UINT16: u16, "UInt16";
            get_uint32 GET_UINT32, set_uint32 SET_UINT32: u32, "UInt32";
            get_uint64 GET_UINT64, set_uint64 SET_UINT64: u64, "UInt64";
            get_string GET_STRING, set_string SET_STRING: String, "String";
            get_binary GET_BINARY, set_binary SET_BINARY: Vec<u8>, "Binary";
            get_clock GET_CLOCK, set_clock SET_CLOCK: bool, "Clock";
        }
        $crate::shared::absent_clocks! {
            get_interval_decimal GET_INTERVAL_DECIMAL: (f64, IntervalQualifier),
                set_interval_decimal SET_INTERVAL_DECIMAL: f64;
            get_interval_fraction GET_INTERVAL_FRACTION: (IntervalFraction, IntervalQualifier),
                set_interval_fraction SET_INTERVAL_FRACTION: IntervalFraction;
            get_shift_decimal GET_SHIFT_DECIMAL: f64, set_shift_decimal SET_SHIFT_DECIMAL: f64;
            get_shift_fraction GET_SHIFT_FRACTION: IntervalFraction,
                set_shift_fraction SET_SHIFT_FRACTION: IntervalFraction;
        }
        $crate::shared::absent! {
            enter_configuration_mode() ENTER_CONFIGURATION_MODE "no structural parameter";
            exit_configuration_mode() EXIT_CONFIGURATION_MODE "no structural parameter";
            evaluate_discrete_states() EVALUATE_DISCRETE_STATES "providesEvaluateDiscreteStates = false";
            enter_step_mode() ENTER_STEP_MODE "hasEventMode = false";
        }
        $crate::shared::absent_answers! {
            get_number_of_variable_dependencies(_variable: u32) -> u64, GET_NUMBER_OF_VARIABLE_DEPENDENCIES
                "providesPerElementDependencies = false";
            get_variable_dependencies(_variable: u32) -> Vec<VariableDependency>, GET_VARIABLE_DEPENDENCIES
                "providesPerElementDependencies = false";
            get_adjoint_derivative(_unknowns: Vec<u32>, _knowns: Vec<u32>, _seed: Vec<f64>) -> Vec<f64>,
                GET_ADJOINT_DERIVATIVE "providesAdjointDerivatives = false";
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

macro_rules! absent_types {
    ($($get:ident $getter:ident, $set:ident $setter:ident: $type:ty, $name:literal;)*) => {
        $(
            fn $get(&self, references: Vec<u32>) -> Result<Vec<$type>, Status> {
                self.get_absent(&calls::$getter, $name, &references)
            }
            fn $set(&self, references: Vec<u32>, values: Vec<$type>) -> Status {
                self.set_absent(&calls::$setter, $name, &references, values.len())
            }
        )*
    };
}

macro_rules! absent_clocks {
    ($($get:ident $getter:ident: $has:ty, $set:ident $setter:ident: $takes:ty;)*) => {
        $(
            fn $get(&self, references: Vec<u32>) -> Result<Vec<$has>, Status> {
                self.get_absent(&calls::$getter, "Clock", &references)
            }
            fn $set(&self, references: Vec<u32>, values: Vec<$takes>) -> Status {
                self.set_absent(&calls::$setter, "Clock", &references, values.len())
            }
        )*
    };
}

macro_rules! absent {
    ($($function:ident() $call:ident $says:literal;)*) => {
        $(fn $function(&self) -> Status {
            self.call(&calls::$call, |_| not_provided($says))
        })*
    };
}

macro_rules! absent_answers {
    ($($function:ident($($argument:ident: $type:ty),*) -> $answer:ty, $call:ident $says:literal;)*) => {
        $(fn $function(&self, $($argument: $type),*) -> Result<$answer, Status> {
            self.ask(&calls::$call, |_| not_provided($says))
        })*
    };
}

pub(crate) use {absent, absent_answers, absent_clocks, absent_types, present, shared_functions};
