//! The shared library exports the functions of both versions of the standard and nothing else.

use fmi_model::{v2, v3};
use object::read::NameOrOrdinal;
use object::{Object, ObjectSymbol};
use std::collections::BTreeSet;

/// Functions of FMI 2.0.5, typed from the standard.
#[rustfmt::skip]
const FMI2: [&str; 44] = [
    "fmi2GetTypesPlatform", "fmi2GetVersion", "fmi2SetDebugLogging", "fmi2Instantiate",
    "fmi2FreeInstance", "fmi2SetupExperiment", "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode", "fmi2Terminate", "fmi2Reset", "fmi2GetReal", "fmi2GetInteger",
    "fmi2GetBoolean", "fmi2GetString", "fmi2SetReal", "fmi2SetInteger", "fmi2SetBoolean",
    "fmi2SetString", "fmi2GetFMUstate", "fmi2SetFMUstate", "fmi2FreeFMUstate",
    "fmi2SerializedFMUstateSize", "fmi2SerializeFMUstate", "fmi2DeSerializeFMUstate",
    "fmi2GetDirectionalDerivative", "fmi2SetRealInputDerivatives", "fmi2GetRealOutputDerivatives",
    "fmi2EnterEventMode", "fmi2NewDiscreteStates", "fmi2EnterContinuousTimeMode",
    "fmi2CompletedIntegratorStep", "fmi2SetTime", "fmi2SetContinuousStates", "fmi2GetDerivatives",
    "fmi2GetEventIndicators", "fmi2GetContinuousStates", "fmi2GetNominalsOfContinuousStates",
    "fmi2DoStep", "fmi2CancelStep", "fmi2GetStatus", "fmi2GetRealStatus", "fmi2GetIntegerStatus",
    "fmi2GetBooleanStatus", "fmi2GetStringStatus",
];

/// Functions of FMI 3.0.2, typed from the standard.
#[rustfmt::skip]
const FMI3: [&str; 75] = [
    "fmi3GetVersion", "fmi3InstantiateModelExchange", "fmi3InstantiateCoSimulation",
    "fmi3InstantiateScheduledExecution", "fmi3FreeInstance", "fmi3SetDebugLogging",
    "fmi3EnterInitializationMode", "fmi3ExitInitializationMode", "fmi3EnterEventMode",
    "fmi3Terminate", "fmi3Reset", "fmi3GetFloat32", "fmi3GetFloat64", "fmi3GetInt8", "fmi3GetUInt8",
    "fmi3GetInt16", "fmi3GetUInt16", "fmi3GetInt32", "fmi3GetUInt32", "fmi3GetInt64",
    "fmi3GetUInt64", "fmi3GetBoolean", "fmi3GetString", "fmi3GetBinary", "fmi3GetClock",
    "fmi3SetFloat32", "fmi3SetFloat64", "fmi3SetInt8", "fmi3SetUInt8", "fmi3SetInt16",
    "fmi3SetUInt16", "fmi3SetInt32", "fmi3SetUInt32", "fmi3SetInt64", "fmi3SetUInt64",
    "fmi3SetBoolean", "fmi3SetString", "fmi3SetBinary", "fmi3SetClock",
    "fmi3GetNumberOfVariableDependencies", "fmi3GetVariableDependencies", "fmi3GetFMUState",
    "fmi3SetFMUState", "fmi3FreeFMUState", "fmi3SerializedFMUStateSize", "fmi3SerializeFMUState",
    "fmi3DeserializeFMUState", "fmi3GetDirectionalDerivative", "fmi3GetAdjointDerivative",
    "fmi3EnterConfigurationMode", "fmi3ExitConfigurationMode", "fmi3GetIntervalDecimal",
    "fmi3GetIntervalFraction", "fmi3GetShiftDecimal", "fmi3GetShiftFraction",
    "fmi3SetIntervalDecimal", "fmi3SetIntervalFraction", "fmi3SetShiftDecimal",
    "fmi3SetShiftFraction", "fmi3EvaluateDiscreteStates", "fmi3UpdateDiscreteStates",
    "fmi3EnterContinuousTimeMode", "fmi3CompletedIntegratorStep", "fmi3SetTime",
    "fmi3SetContinuousStates", "fmi3GetContinuousStateDerivatives", "fmi3GetEventIndicators",
    "fmi3GetContinuousStates", "fmi3GetNominalsOfContinuousStates",
    "fmi3GetNumberOfEventIndicators", "fmi3GetNumberOfContinuousStates", "fmi3EnterStepMode",
    "fmi3GetOutputDerivatives", "fmi3DoStep", "fmi3ActivateModelPartition",
];

fn standard() -> BTreeSet<String> {
    FMI2.iter().chain(&FMI3).map(|name| name.to_string()).collect()
}

#[test]
fn exactly_the_functions_of_the_standard_are_exported() {
    let bytes = std::fs::read(crate::master::library_path::<ahv::flight::Setup>()).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    // Mach-O puts an underscore before every C name.
    let name = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim_start_matches('_').to_string();
    let exports: BTreeSet<_> = file
        .exports()
        .unwrap()
        .map(|export| match export.unwrap().name() {
            NameOrOrdinal::Name(bytes) => name(bytes),
            NameOrOrdinal::Ordinal(number) => format!("number {number}"),
        })
        .collect();
    assert_eq!(exports, standard());
    let symbols: BTreeSet<_> = file
        .dynamic_symbols()
        .filter(|symbol| symbol.is_definition() && symbol.is_global())
        .map(|symbol| name(symbol.name_bytes().unwrap()))
        .collect();
    assert!(symbols.is_subset(&standard()), "{symbols:?}");
}

#[test]
fn every_function_of_the_standard_has_a_signature_that_the_headers_are_compared_with() {
    let signatures = v2::sys::signatures().into_iter().chain(v3::sys::signatures());
    let names: BTreeSet<_> = signatures.map(|(name, _)| name.to_string()).collect();
    assert_eq!(names, standard());
}
