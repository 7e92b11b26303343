//! The exported functions, from one list.

/// The list: name of the type in [`sys`](crate::v2::sys), name in the standard, arguments, result.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_functions {
    ($with:ident $($what:tt)*) => {
        $crate::$with! {
            [$($what)*]
            GetTypesPlatform fmi2GetTypesPlatform() -> *const c_char;
            GetVersion fmi2GetVersion() -> *const c_char;
            SetDebugLogging fmi2SetDebugLogging(c: Component, loggingOn: Boolean, nCategories: usize, categories: *const FmiString) -> Status;
            Instantiate fmi2Instantiate(instanceName: FmiString, fmuType: Type, fmuGUID: FmiString, fmuResourceLocation: FmiString, functions: *const CallbackFunctions, visible: Boolean, loggingOn: Boolean) -> Component;
            FreeInstance fmi2FreeInstance(c: Component);
            SetupExperiment fmi2SetupExperiment(c: Component, toleranceDefined: Boolean, tolerance: Real, startTime: Real, stopTimeDefined: Boolean, stopTime: Real) -> Status;
            EnterInitializationMode fmi2EnterInitializationMode(c: Component) -> Status;
            ExitInitializationMode fmi2ExitInitializationMode(c: Component) -> Status;
            Terminate fmi2Terminate(c: Component) -> Status;
            Reset fmi2Reset(c: Component) -> Status;
            GetReal fmi2GetReal(c: Component, vr: *const ValueReference, nvr: usize, value: *mut Real) -> Status;
            GetInteger fmi2GetInteger(c: Component, vr: *const ValueReference, nvr: usize, value: *mut Integer) -> Status;
            GetBoolean fmi2GetBoolean(c: Component, vr: *const ValueReference, nvr: usize, value: *mut Boolean) -> Status;
            GetString fmi2GetString(c: Component, vr: *const ValueReference, nvr: usize, value: *mut FmiString) -> Status;
            SetReal fmi2SetReal(c: Component, vr: *const ValueReference, nvr: usize, value: *const Real) -> Status;
            SetInteger fmi2SetInteger(c: Component, vr: *const ValueReference, nvr: usize, value: *const Integer) -> Status;
            SetBoolean fmi2SetBoolean(c: Component, vr: *const ValueReference, nvr: usize, value: *const Boolean) -> Status;
            SetString fmi2SetString(c: Component, vr: *const ValueReference, nvr: usize, value: *const FmiString) -> Status;
            GetFmuState fmi2GetFMUstate(c: Component, FMUstate: *mut FmuState) -> Status;
            SetFmuState fmi2SetFMUstate(c: Component, FMUstate: FmuState) -> Status;
            FreeFmuState fmi2FreeFMUstate(c: Component, FMUstate: *mut FmuState) -> Status;
            SerializedFmuStateSize fmi2SerializedFMUstateSize(c: Component, FMUstate: FmuState, size: *mut usize) -> Status;
            SerializeFmuState fmi2SerializeFMUstate(c: Component, FMUstate: FmuState, serializedState: *mut Byte, size: usize) -> Status;
            DeSerializeFmuState fmi2DeSerializeFMUstate(c: Component, serializedState: *const Byte, size: usize, FMUstate: *mut FmuState) -> Status;
            GetDirectionalDerivative fmi2GetDirectionalDerivative(c: Component, vUnknown_ref: *const ValueReference, nUnknown: usize, vKnown_ref: *const ValueReference, nKnown: usize, dvKnown: *const Real, dvUnknown: *mut Real) -> Status;
            SetRealInputDerivatives fmi2SetRealInputDerivatives(c: Component, vr: *const ValueReference, nvr: usize, order: *const Integer, value: *const Real) -> Status;
            GetRealOutputDerivatives fmi2GetRealOutputDerivatives(c: Component, vr: *const ValueReference, nvr: usize, order: *const Integer, value: *mut Real) -> Status;
            EnterEventMode fmi2EnterEventMode(c: Component) -> Status;
            NewDiscreteStates fmi2NewDiscreteStates(c: Component, fmi2eventInfo: *mut EventInfo) -> Status;
            EnterContinuousTimeMode fmi2EnterContinuousTimeMode(c: Component) -> Status;
            CompletedIntegratorStep fmi2CompletedIntegratorStep(c: Component, noSetFMUStatePriorToCurrentPoint: Boolean, enterEventMode: *mut Boolean, terminateSimulation: *mut Boolean) -> Status;
            SetTime fmi2SetTime(c: Component, time: Real) -> Status;
            SetContinuousStates fmi2SetContinuousStates(c: Component, x: *const Real, nx: usize) -> Status;
            GetDerivatives fmi2GetDerivatives(c: Component, derivatives: *mut Real, nx: usize) -> Status;
            GetEventIndicators fmi2GetEventIndicators(c: Component, eventIndicators: *mut Real, ni: usize) -> Status;
            GetContinuousStates fmi2GetContinuousStates(c: Component, x: *mut Real, nx: usize) -> Status;
            GetNominalsOfContinuousStates fmi2GetNominalsOfContinuousStates(c: Component, x_nominal: *mut Real, nx: usize) -> Status;
            DoStep fmi2DoStep(c: Component, currentCommunicationPoint: Real, communicationStepSize: Real, noSetFMUStatePriorToCurrentPoint: Boolean) -> Status;
            CancelStep fmi2CancelStep(c: Component) -> Status;
            GetStatus fmi2GetStatus(c: Component, s: StatusKind, value: *mut Status) -> Status;
            GetRealStatus fmi2GetRealStatus(c: Component, s: StatusKind, value: *mut Real) -> Status;
            GetIntegerStatus fmi2GetIntegerStatus(c: Component, s: StatusKind, value: *mut Integer) -> Status;
            GetBooleanStatus fmi2GetBooleanStatus(c: Component, s: StatusKind, value: *mut Boolean) -> Status;
            GetStringStatus fmi2GetStringStatus(c: Component, s: StatusKind, value: *mut FmiString) -> Status;
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_export {
    ([$model:ty] $($function:ident $c:ident ($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        $(
            #[unsafe(no_mangle)]
            unsafe extern "C" fn $c($($argument: $type),*) $(-> $result)? {
                // SAFETY: the master keeps to the standard.
                unsafe { $crate::v2::abi::$c::<$model>($($argument),*) }
            }
            const _: $crate::v2::sys::$function = $c;
        )*
    };
}
