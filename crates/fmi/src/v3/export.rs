//! The exported functions, from one list.

/// The list: name of the type in [`sys`](crate::v3::sys), name in the standard, arguments, result.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_functions {
    ($with:ident $($what:tt)*) => {
        $crate::$with! {
            [$($what)*]
            GetVersion fmi3GetVersion() -> *const c_char;
            SetDebugLogging fmi3SetDebugLogging(instance: Instance, loggingOn: Boolean, nCategories: usize, categories: *const FmiString) -> Status;
            InstantiateModelExchange fmi3InstantiateModelExchange(instanceName: FmiString, instantiationToken: FmiString, resourcePath: FmiString, visible: Boolean, loggingOn: Boolean, instanceEnvironment: InstanceEnvironment, logMessage: Option<LogMessageCallback>) -> Instance;
            InstantiateCoSimulation fmi3InstantiateCoSimulation(instanceName: FmiString, instantiationToken: FmiString, resourcePath: FmiString, visible: Boolean, loggingOn: Boolean, eventModeUsed: Boolean, earlyReturnAllowed: Boolean, requiredIntermediateVariables: *const ValueReference, nRequiredIntermediateVariables: usize, instanceEnvironment: InstanceEnvironment, logMessage: Option<LogMessageCallback>, intermediateUpdate: Option<IntermediateUpdateCallback>) -> Instance;
            InstantiateScheduledExecution fmi3InstantiateScheduledExecution(instanceName: FmiString, instantiationToken: FmiString, resourcePath: FmiString, visible: Boolean, loggingOn: Boolean, instanceEnvironment: InstanceEnvironment, logMessage: Option<LogMessageCallback>, clockUpdate: Option<ClockUpdateCallback>, lockPreemption: Option<PreemptionCallback>, unlockPreemption: Option<PreemptionCallback>) -> Instance;
            FreeInstance fmi3FreeInstance(instance: Instance);
            EnterInitializationMode fmi3EnterInitializationMode(instance: Instance, toleranceDefined: Boolean, tolerance: Float64, startTime: Float64, stopTimeDefined: Boolean, stopTime: Float64) -> Status;
            ExitInitializationMode fmi3ExitInitializationMode(instance: Instance) -> Status;
            EnterEventMode fmi3EnterEventMode(instance: Instance) -> Status;
            Terminate fmi3Terminate(instance: Instance) -> Status;
            Reset fmi3Reset(instance: Instance) -> Status;
            GetFloat32 fmi3GetFloat32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Float32, nValues: usize) -> Status;
            GetFloat64 fmi3GetFloat64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Float64, nValues: usize) -> Status;
            GetInt8 fmi3GetInt8(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Int8, nValues: usize) -> Status;
            GetUInt8 fmi3GetUInt8(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut UInt8, nValues: usize) -> Status;
            GetInt16 fmi3GetInt16(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Int16, nValues: usize) -> Status;
            GetUInt16 fmi3GetUInt16(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut UInt16, nValues: usize) -> Status;
            GetInt32 fmi3GetInt32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Int32, nValues: usize) -> Status;
            GetUInt32 fmi3GetUInt32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut UInt32, nValues: usize) -> Status;
            GetInt64 fmi3GetInt64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Int64, nValues: usize) -> Status;
            GetUInt64 fmi3GetUInt64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut UInt64, nValues: usize) -> Status;
            GetBoolean fmi3GetBoolean(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Boolean, nValues: usize) -> Status;
            GetString fmi3GetString(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut FmiString, nValues: usize) -> Status;
            GetBinary fmi3GetBinary(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, valueSizes: *mut usize, values: *mut Binary, nValues: usize) -> Status;
            GetClock fmi3GetClock(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *mut Boolean) -> Status;
            SetFloat32 fmi3SetFloat32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Float32, nValues: usize) -> Status;
            SetFloat64 fmi3SetFloat64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Float64, nValues: usize) -> Status;
            SetInt8 fmi3SetInt8(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Int8, nValues: usize) -> Status;
            SetUInt8 fmi3SetUInt8(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const UInt8, nValues: usize) -> Status;
            SetInt16 fmi3SetInt16(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Int16, nValues: usize) -> Status;
            SetUInt16 fmi3SetUInt16(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const UInt16, nValues: usize) -> Status;
            SetInt32 fmi3SetInt32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Int32, nValues: usize) -> Status;
            SetUInt32 fmi3SetUInt32(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const UInt32, nValues: usize) -> Status;
            SetInt64 fmi3SetInt64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Int64, nValues: usize) -> Status;
            SetUInt64 fmi3SetUInt64(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const UInt64, nValues: usize) -> Status;
            SetBoolean fmi3SetBoolean(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Boolean, nValues: usize) -> Status;
            SetString fmi3SetString(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const FmiString, nValues: usize) -> Status;
            SetBinary fmi3SetBinary(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, valueSizes: *const usize, values: *const Binary, nValues: usize) -> Status;
            SetClock fmi3SetClock(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, values: *const Boolean) -> Status;
            GetNumberOfVariableDependencies fmi3GetNumberOfVariableDependencies(instance: Instance, valueReference: ValueReference, nDependencies: *mut usize) -> Status;
            GetVariableDependencies fmi3GetVariableDependencies(instance: Instance, dependent: ValueReference, elementIndicesOfDependent: *mut usize, independents: *mut ValueReference, elementIndicesOfIndependents: *mut usize, dependencyKinds: *mut Enumeration, nDependencies: usize) -> Status;
            GetFmuState fmi3GetFMUState(instance: Instance, FMUState: *mut FmuState) -> Status;
            SetFmuState fmi3SetFMUState(instance: Instance, FMUState: FmuState) -> Status;
            FreeFmuState fmi3FreeFMUState(instance: Instance, FMUState: *mut FmuState) -> Status;
            SerializedFmuStateSize fmi3SerializedFMUStateSize(instance: Instance, FMUState: FmuState, size: *mut usize) -> Status;
            SerializeFmuState fmi3SerializeFMUState(instance: Instance, FMUState: FmuState, serializedState: *mut Byte, size: usize) -> Status;
            DeserializeFmuState fmi3DeserializeFMUState(instance: Instance, serializedState: *const Byte, size: usize, FMUState: *mut FmuState) -> Status;
            GetDirectionalDerivative fmi3GetDirectionalDerivative(instance: Instance, unknowns: *const ValueReference, nUnknowns: usize, knowns: *const ValueReference, nKnowns: usize, seed: *const Float64, nSeed: usize, sensitivity: *mut Float64, nSensitivity: usize) -> Status;
            GetAdjointDerivative fmi3GetAdjointDerivative(instance: Instance, unknowns: *const ValueReference, nUnknowns: usize, knowns: *const ValueReference, nKnowns: usize, seed: *const Float64, nSeed: usize, sensitivity: *mut Float64, nSensitivity: usize) -> Status;
            EnterConfigurationMode fmi3EnterConfigurationMode(instance: Instance) -> Status;
            ExitConfigurationMode fmi3ExitConfigurationMode(instance: Instance) -> Status;
            GetIntervalDecimal fmi3GetIntervalDecimal(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, intervals: *mut Float64, qualifiers: *mut Enumeration) -> Status;
            GetIntervalFraction fmi3GetIntervalFraction(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, counters: *mut UInt64, resolutions: *mut UInt64, qualifiers: *mut Enumeration) -> Status;
            GetShiftDecimal fmi3GetShiftDecimal(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, shifts: *mut Float64) -> Status;
            GetShiftFraction fmi3GetShiftFraction(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, counters: *mut UInt64, resolutions: *mut UInt64) -> Status;
            SetIntervalDecimal fmi3SetIntervalDecimal(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, intervals: *const Float64) -> Status;
            SetIntervalFraction fmi3SetIntervalFraction(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, counters: *const UInt64, resolutions: *const UInt64) -> Status;
            SetShiftDecimal fmi3SetShiftDecimal(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, shifts: *const Float64) -> Status;
            SetShiftFraction fmi3SetShiftFraction(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, counters: *const UInt64, resolutions: *const UInt64) -> Status;
            EvaluateDiscreteStates fmi3EvaluateDiscreteStates(instance: Instance) -> Status;
            UpdateDiscreteStates fmi3UpdateDiscreteStates(instance: Instance, discreteStatesNeedUpdate: *mut Boolean, terminateSimulation: *mut Boolean, nominalsOfContinuousStatesChanged: *mut Boolean, valuesOfContinuousStatesChanged: *mut Boolean, nextEventTimeDefined: *mut Boolean, nextEventTime: *mut Float64) -> Status;
            EnterContinuousTimeMode fmi3EnterContinuousTimeMode(instance: Instance) -> Status;
            CompletedIntegratorStep fmi3CompletedIntegratorStep(instance: Instance, noSetFMUStatePriorToCurrentPoint: Boolean, enterEventMode: *mut Boolean, terminateSimulation: *mut Boolean) -> Status;
            SetTime fmi3SetTime(instance: Instance, time: Float64) -> Status;
            SetContinuousStates fmi3SetContinuousStates(instance: Instance, continuousStates: *const Float64, nContinuousStates: usize) -> Status;
            GetContinuousStateDerivatives fmi3GetContinuousStateDerivatives(instance: Instance, derivatives: *mut Float64, nContinuousStates: usize) -> Status;
            GetEventIndicators fmi3GetEventIndicators(instance: Instance, eventIndicators: *mut Float64, nEventIndicators: usize) -> Status;
            GetContinuousStates fmi3GetContinuousStates(instance: Instance, continuousStates: *mut Float64, nContinuousStates: usize) -> Status;
            GetNominalsOfContinuousStates fmi3GetNominalsOfContinuousStates(instance: Instance, nominals: *mut Float64, nContinuousStates: usize) -> Status;
            GetNumberOfEventIndicators fmi3GetNumberOfEventIndicators(instance: Instance, nEventIndicators: *mut usize) -> Status;
            GetNumberOfContinuousStates fmi3GetNumberOfContinuousStates(instance: Instance, nContinuousStates: *mut usize) -> Status;
            EnterStepMode fmi3EnterStepMode(instance: Instance) -> Status;
            GetOutputDerivatives fmi3GetOutputDerivatives(instance: Instance, valueReferences: *const ValueReference, nValueReferences: usize, orders: *const Int32, values: *mut Float64, nValues: usize) -> Status;
            DoStep fmi3DoStep(instance: Instance, currentCommunicationPoint: Float64, communicationStepSize: Float64, noSetFMUStatePriorToCurrentPoint: Boolean, eventHandlingNeeded: *mut Boolean, terminateSimulation: *mut Boolean, earlyReturn: *mut Boolean, lastSuccessfulTime: *mut Float64) -> Status;
            ActivateModelPartition fmi3ActivateModelPartition(instance: Instance, clockReference: ValueReference, activationTime: Float64) -> Status;
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_export {
    ([$model:ty] $($function:ident $c:ident ($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        $(
            #[unsafe(no_mangle)]
            unsafe extern "C" fn $c($($argument: $type),*) $(-> $result)? {
                // SAFETY: the master keeps to the standard.
                unsafe { $crate::v3::abi::$c::<$model>($($argument),*) }
            }
            const _: $crate::v3::sys::$function = $c;
        )*
    };
}
