//! Proof that `src/v2/sys.rs` says what the official headers say: a C compiler compares them.
//!
//! `FMI2_INCLUDE=<folder with fmi2Functions.h> cargo test --package fmi-model --test headers -- --ignored`
//!
//! The folder is `headers/` of the FMI 2.0.5 distribution; FMPy has the same files in `c-code/`, the
//! crate fmi-sys in `fmi-standard2/headers/`. `cargo ahv test` takes those of FMPy. The bindings of fmi-sys
//! itself would say nothing more, and bindgen needs libclang to make them.

use fmi_model::v2::sys::{self, signatures};
use std::fmt::Write;
use std::io::Write as _;
use std::mem::{offset_of, size_of};
use std::process::{Command, Stdio};

/// A Rust type, as `core::any::type_name` prints it, in C.
fn c_type(rust: &str) -> String {
    if let Some(target) = rust.strip_prefix("*const ") {
        return format!("{} const*", c_type(target));
    }
    if let Some(target) = rust.strip_prefix("*mut ") {
        return format!("{}*", c_type(target));
    }
    match rust.rsplit("::").next().unwrap() {
        "()" => "void",
        "c_void" => "void",
        "f64" => "double",
        "i32" => "int",
        "u32" => "unsigned int",
        "usize" => "size_t",
        // `c_char` is one or the other, and neither stands for another C type here.
        "i8" | "u8" => "char",
        "..." => "...",
        "Status" => "fmi2Status",
        "Type" => "fmi2Type",
        "StatusKind" => "fmi2StatusKind",
        "CallbackFunctions" => "fmi2CallbackFunctions",
        "EventInfo" => "fmi2EventInfo",
        other => panic!("no C type for {other}"),
    }
    .to_string()
}

/// A Rust function pointer type, as `core::any::type_name` prints it, as a C function type.
fn c_function(rust: &str) -> String {
    let (_, rest) = rust.split_once("fn(").expect("a function pointer");
    let (arguments, result) = rest.rsplit_once(')').unwrap();
    let arguments = if arguments.is_empty() {
        "void".to_string()
    } else {
        arguments.split(", ").map(c_type).collect::<Vec<_>>().join(", ")
    };
    format!("{}({arguments})", c_type(result.strip_prefix(" -> ").unwrap_or("()")))
}

fn program() -> String {
    let mut c = String::from("#include <stddef.h>\n#include \"fmi2Functions.h\"\n");
    let mut same = |standard: &str, ours: String| {
        writeln!(
            c,
            "_Static_assert(__builtin_types_compatible_p({standard}, {ours}), \"{standard}\");"
        )
        .unwrap();
    };
    for (name, rust) in signatures() {
        same(&format!("{name}TYPE"), c_function(rust));
    }
    let pointer = |rust: &str| c_function(rust).replacen('(', "(*)(", 1);
    let name = std::any::type_name::<sys::CallbackLogger>();
    same("fmi2CallbackLogger", pointer(name));
    let name = std::any::type_name::<sys::CallbackAllocateMemory>();
    same("fmi2CallbackAllocateMemory", pointer(name));
    same("fmi2CallbackFreeMemory", pointer(std::any::type_name::<sys::CallbackFreeMemory>()));
    same("fmi2StepFinished", pointer(std::any::type_name::<sys::StepFinished>()));
    same("fmi2ValueReference", "unsigned int".into());
    same("fmi2Byte", "char".into());

    let mut equal = |standard: &str, ours: usize| {
        writeln!(c, "_Static_assert({standard} == {ours}, \"{standard}\");").unwrap();
    };
    equal("sizeof(fmi2CallbackFunctions)", size_of::<sys::CallbackFunctions>());
    equal("offsetof(fmi2CallbackFunctions, logger)", offset_of!(sys::CallbackFunctions, logger));
    equal(
        "offsetof(fmi2CallbackFunctions, allocateMemory)",
        offset_of!(sys::CallbackFunctions, allocate_memory),
    );
    equal(
        "offsetof(fmi2CallbackFunctions, freeMemory)",
        offset_of!(sys::CallbackFunctions, free_memory),
    );
    equal(
        "offsetof(fmi2CallbackFunctions, stepFinished)",
        offset_of!(sys::CallbackFunctions, step_finished),
    );
    equal(
        "offsetof(fmi2CallbackFunctions, componentEnvironment)",
        offset_of!(sys::CallbackFunctions, environment),
    );
    equal("sizeof(fmi2EventInfo)", size_of::<sys::EventInfo>());
    equal(
        "offsetof(fmi2EventInfo, nextEventTimeDefined)",
        offset_of!(sys::EventInfo, next_event_time_defined),
    );
    equal("offsetof(fmi2EventInfo, nextEventTime)", offset_of!(sys::EventInfo, next_event_time));
    equal("sizeof(fmi2Status)", size_of::<sys::Status>());
    equal("sizeof(fmi2Type)", size_of::<sys::Type>());
    equal("sizeof(fmi2StatusKind)", size_of::<sys::StatusKind>());
    equal("fmi2True", sys::TRUE as usize);
    equal("fmi2False", sys::FALSE as usize);
    for (name, status) in [
        ("fmi2OK", sys::Status::Ok),
        ("fmi2Warning", sys::Status::Warning),
        ("fmi2Discard", sys::Status::Discard),
        ("fmi2Error", sys::Status::Error),
        ("fmi2Fatal", sys::Status::Fatal),
    ] {
        equal(name, status as usize);
    }
    for (name, number) in [
        ("fmi2ModelExchange", sys::Type::MODEL_EXCHANGE.0),
        ("fmi2CoSimulation", sys::Type::CO_SIMULATION.0),
        ("fmi2DoStepStatus", sys::StatusKind::DO_STEP_STATUS.0),
        ("fmi2PendingStatus", sys::StatusKind::PENDING_STATUS.0),
        ("fmi2LastSuccessfulTime", sys::StatusKind::LAST_SUCCESSFUL_TIME.0),
        ("fmi2Terminated", sys::StatusKind::TERMINATED.0),
    ] {
        equal(name, number as usize);
    }
    c
}

/// Whether the C compiler accepts a program, and what it says.
fn compile(program: &str) -> (bool, String) {
    let include = std::env::var("FMI2_INCLUDE").expect("FMI2_INCLUDE: folder of fmi2Functions.h");
    let mut compiler = Command::new(std::env::var("CC").unwrap_or("cc".into()))
        .args(["-std=gnu11", "-fsyntax-only", "-x", "c", "-I", &include, "-"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("a C compiler");
    compiler.stdin.take().unwrap().write_all(program.as_bytes()).unwrap();
    let output = compiler.wait_with_output().unwrap();
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
#[ignore = "FMI2_INCLUDE: folder of fmi2Functions.h"]
fn types_and_functions_are_those_of_the_official_headers() {
    let (accepted, errors) = compile(&program());
    assert!(accepted, "{errors}");
}

#[test]
#[ignore = "FMI2_INCLUDE: folder of fmi2Functions.h"]
fn every_single_difference_would_be_seen() {
    let program = program();
    for (i, line) in program.lines().enumerate().filter(|(_, line)| line.contains("_Static_assert"))
    {
        let (condition, label) = line.rsplit_once(", \"").unwrap();
        let condition = condition.strip_prefix("_Static_assert(").unwrap();
        let wrong = if condition.starts_with("__builtin") {
            condition.replace("double", "float").replace("int", "long").replace("void*", "int*")
        } else {
            format!("{condition} + 1")
        };
        if wrong == condition {
            continue;
        }
        let wrong = format!(
            "#include <stddef.h>\n#include \"fmi2Functions.h\"\n_Static_assert({wrong}, \"{label}\n"
        );
        assert!(!compile(&wrong).0, "line {i} accepts anything: {wrong}");
    }
}
