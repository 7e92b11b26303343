//! The shared library exports the functions of the standard and nothing else.

use fmi_model::v2::sys::signatures;
use object::read::NameOrOrdinal;
use object::{Object, ObjectSymbol};
use std::collections::BTreeSet;

/// Functions of FMI 2.0.5, typed from the standard.
#[rustfmt::skip]
const STANDARD: [&str; 44] = [
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

fn standard() -> BTreeSet<String> {
    STANDARD.iter().map(|name| name.to_string()).collect()
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
    let names: BTreeSet<_> = signatures().into_iter().map(|(name, _)| name.to_string()).collect();
    assert_eq!(names, standard());
}
