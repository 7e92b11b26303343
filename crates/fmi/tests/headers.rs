//! Proof that `src/v2/sys.rs` and `src/v3/sys.rs` say what the official headers say: a C compiler compares them.
//!
//! `FMI_INCLUDE=<folder with fmi2Functions.h and fmi3Functions.h>
//! cargo test --package fmi-model --test headers -- --ignored`
//!
//! The files are those of `headers/` of the distributions of FMI 2.0.5 and 3.0.2; FMPy has the same ones in
//! `c-code/`. `cargo ahv test` takes those of FMPy. The bindings of the crate fmi-sys would say nothing more,
//! and bindgen needs libclang to make them.

use fmi_model::{v2, v3};
use std::any::type_name;
use std::fmt::Write;
use std::io::Write as _;
use std::mem::{offset_of, size_of};
use std::process::{Command, Stdio};

/// What is compared of a version.
struct Version {
    /// Prefix of its C names.
    prefix: &'static str,
    signatures: Vec<(&'static str, &'static str)>,
    /// Callbacks: names in C, and the Rust types that stand for them.
    callbacks: Vec<(&'static str, &'static str)>,
    /// Types: names in C, and in C again what stands for them.
    types: Vec<(&'static str, &'static str)>,
    /// Expressions in C, and their values.
    numbers: Vec<(&'static str, usize)>,
}

fn fmi2() -> Version {
    use v2::sys;
    type Functions = sys::CallbackFunctions;
    Version {
        prefix: "fmi2",
        signatures: sys::signatures(),
        callbacks: vec![
            ("fmi2CallbackLogger", type_name::<sys::CallbackLogger>()),
            ("fmi2CallbackAllocateMemory", type_name::<sys::CallbackAllocateMemory>()),
            ("fmi2CallbackFreeMemory", type_name::<sys::CallbackFreeMemory>()),
            ("fmi2StepFinished", type_name::<sys::StepFinished>()),
        ],
        types: vec![("fmi2ValueReference", "unsigned int"), ("fmi2Byte", "char")],
        numbers: vec![
            ("sizeof(fmi2CallbackFunctions)", size_of::<Functions>()),
            ("offsetof(fmi2CallbackFunctions, logger)", offset_of!(Functions, logger)),
            (
                "offsetof(fmi2CallbackFunctions, allocateMemory)",
                offset_of!(Functions, allocate_memory),
            ),
            ("offsetof(fmi2CallbackFunctions, freeMemory)", offset_of!(Functions, free_memory)),
            ("offsetof(fmi2CallbackFunctions, stepFinished)", offset_of!(Functions, step_finished)),
            (
                "offsetof(fmi2CallbackFunctions, componentEnvironment)",
                offset_of!(Functions, environment),
            ),
            ("sizeof(fmi2EventInfo)", size_of::<sys::EventInfo>()),
            (
                "offsetof(fmi2EventInfo, nextEventTimeDefined)",
                offset_of!(sys::EventInfo, next_event_time_defined),
            ),
            ("offsetof(fmi2EventInfo, nextEventTime)", offset_of!(sys::EventInfo, next_event_time)),
            ("sizeof(fmi2Status)", size_of::<sys::Status>()),
            ("sizeof(fmi2Type)", size_of::<sys::Type>()),
            ("sizeof(fmi2StatusKind)", size_of::<sys::StatusKind>()),
            ("fmi2True", sys::TRUE as usize),
            ("fmi2False", sys::FALSE as usize),
            ("fmi2OK", sys::Status::Ok as usize),
            ("fmi2Warning", sys::Status::Warning as usize),
            ("fmi2Discard", sys::Status::Discard as usize),
            ("fmi2Error", sys::Status::Error as usize),
            ("fmi2Fatal", sys::Status::Fatal as usize),
            ("fmi2ModelExchange", sys::Type::MODEL_EXCHANGE.0 as usize),
            ("fmi2CoSimulation", sys::Type::CO_SIMULATION.0 as usize),
            ("fmi2DoStepStatus", sys::StatusKind::DO_STEP_STATUS.0 as usize),
            ("fmi2PendingStatus", sys::StatusKind::PENDING_STATUS.0 as usize),
            ("fmi2LastSuccessfulTime", sys::StatusKind::LAST_SUCCESSFUL_TIME.0 as usize),
            ("fmi2Terminated", sys::StatusKind::TERMINATED.0 as usize),
        ],
    }
}

fn fmi3() -> Version {
    use v3::sys;
    Version {
        prefix: "fmi3",
        signatures: sys::signatures(),
        callbacks: vec![
            ("fmi3LogMessageCallback", type_name::<sys::LogMessageCallback>()),
            ("fmi3IntermediateUpdateCallback", type_name::<sys::IntermediateUpdateCallback>()),
            ("fmi3ClockUpdateCallback", type_name::<sys::ClockUpdateCallback>()),
            ("fmi3LockPreemptionCallback", type_name::<sys::PreemptionCallback>()),
            ("fmi3UnlockPreemptionCallback", type_name::<sys::PreemptionCallback>()),
        ],
        types: vec![
            ("fmi3ValueReference", "unsigned int"),
            ("fmi3Byte", "unsigned char"),
            ("fmi3Boolean", "_Bool"),
            ("fmi3Clock", "_Bool"),
        ],
        numbers: vec![
            ("sizeof(fmi3Boolean)", size_of::<sys::Boolean>()),
            ("_Alignof(fmi3Boolean)", align_of::<sys::Boolean>()),
            ("fmi3True", sys::Boolean::TRUE.0.into()),
            ("fmi3False", sys::Boolean::FALSE.0.into()),
            ("sizeof(fmi3DependencyKind)", size_of::<sys::Enumeration>()),
            ("sizeof(fmi3IntervalQualifier)", size_of::<sys::Enumeration>()),
            ("sizeof(fmi3Status)", size_of::<sys::Status>()),
            ("fmi3OK", sys::Status::Ok as usize),
            ("fmi3Warning", sys::Status::Warning as usize),
            ("fmi3Discard", sys::Status::Discard as usize),
            ("fmi3Error", sys::Status::Error as usize),
            ("fmi3Fatal", sys::Status::Fatal as usize),
        ],
    }
}

impl Version {
    /// Whether a function has strings: `c_char` is `i8` or `u8`, which are also numbers of FMI 3.0, though not
    /// of the same functions.
    fn has_strings(&self, function: &str) -> bool {
        let named = |word| function.contains(word);
        self.prefix == "fmi2" || ["Version", "Log", "Instantiate", "String"].iter().any(named)
    }

    /// A Rust type, as `core::any::type_name` prints it, in C.
    fn c_type(&self, rust: &str, strings: bool) -> String {
        if let Some(target) = rust.strip_prefix("*const ") {
            return format!("{} const*", self.c_type(target, strings));
        }
        if let Some(target) = rust.strip_prefix("*mut ") {
            return format!("{}*", self.c_type(target, strings));
        }
        if let Some(function) = rust.strip_prefix("core::option::Option<") {
            let function = function.strip_suffix('>').unwrap();
            return self.c_signature(function, strings).replacen('(', "(*)(", 1);
        }
        let name = match (self.prefix, rust.rsplit("::").next().unwrap()) {
            (_, "()" | "c_void") => "void",
            (_, "f32") => "float",
            (_, "f64") => "double",
            (_, "i8" | "u8") if strings => "char",
            (_, "i8") => "int8_t",
            (_, "u8") => "uint8_t",
            (_, "i16") => "int16_t",
            (_, "u16") => "uint16_t",
            (_, "i32") => "int",
            (_, "u32") => "unsigned int",
            (_, "i64") => "int64_t",
            (_, "u64") => "uint64_t",
            (_, "usize") => "size_t",
            (_, "...") => "...",
            ("fmi3", "Boolean") => "_Bool",
            (prefix, name) => return format!("{prefix}{name}"),
        };
        name.to_string()
    }

    /// A Rust function pointer type, as `core::any::type_name` prints it, as a C function type.
    fn c_function(&self, name: &str, rust: &str) -> String {
        self.c_signature(rust, self.has_strings(name))
    }

    fn c_signature(&self, rust: &str, strings: bool) -> String {
        let (_, rest) = rust.split_once("fn(").expect("a function pointer");
        let (arguments, result) = parted(rest);
        let arguments: Vec<_> =
            arguments.into_iter().map(|rust| self.c_type(rust, strings)).collect();
        let arguments = if arguments.is_empty() { "void".into() } else { arguments.join(", ") };
        let result = result.strip_prefix(" -> ").unwrap_or("()");
        format!("{}({arguments})", self.c_type(result, strings))
    }

    fn head(&self) -> String {
        format!("#include <stddef.h>\n#include \"{}Functions.h\"\n", self.prefix)
    }

    fn program(&self) -> String {
        let mut c = self.head();
        let mut assert = |condition: String, label: &str| {
            writeln!(c, "_Static_assert({condition}, \"{label}\");").unwrap();
        };
        let functions =
            self.signatures.iter().map(|(c, rust)| (format!("{c}TYPE"), self.c_function(c, rust)));
        let callbacks = self
            .callbacks
            .iter()
            .map(|(c, rust)| (c.to_string(), self.c_function(c, rust).replacen('(', "(*)(", 1)));
        let types = self.types.iter().map(|(c, ours)| (c.to_string(), ours.to_string()));
        for (standard, ours) in functions.chain(callbacks).chain(types) {
            assert(format!("__builtin_types_compatible_p({standard}, {ours})"), &standard);
        }
        for (standard, ours) in &self.numbers {
            assert(format!("{standard} == {ours}"), standard);
        }
        c
    }
}

/// Arguments of a function type after its opening parenthesis, and what follows the closing one.
fn parted(rest: &str) -> (Vec<&str>, &str) {
    let (mut arguments, mut depth, mut start) = (Vec::new(), 0, 0);
    for (i, byte) in rest.bytes().enumerate() {
        match byte {
            b'(' | b'<' => depth += 1,
            b'>' if rest[..i].ends_with('-') => {}
            b')' if depth == 0 => {
                arguments.extend(Some(&rest[start..i]).filter(|last| !last.is_empty()));
                return (arguments, &rest[i + 1..]);
            }
            b')' | b'>' => depth -= 1,
            b',' if depth == 0 => {
                arguments.push(&rest[start..i]);
                start = i + 2;
            }
            _ => {}
        }
    }
    panic!("{rest} has no end");
}

/// Whether the C compiler accepts a program, and what it says.
fn compile(program: &str) -> (bool, String) {
    let include = std::env::var("FMI_INCLUDE").expect("FMI_INCLUDE: folder of the headers");
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
#[ignore = "FMI_INCLUDE: folder of the headers"]
fn types_and_functions_are_those_of_the_official_headers() {
    for version in [fmi2(), fmi3()] {
        let (accepted, errors) = compile(&version.program());
        assert!(accepted, "{errors}");
    }
}

#[test]
#[ignore = "FMI_INCLUDE: folder of the headers"]
fn every_single_difference_would_be_seen() {
    for version in [fmi2(), fmi3()] {
        let (program, head) = (version.program(), version.head());
        for line in program.lines().filter(|line| line.contains("_Static_assert")) {
            let (condition, label) = line.rsplit_once(", \"").unwrap();
            let condition = condition.strip_prefix("_Static_assert(").unwrap();
            let wrong = if condition.starts_with("__builtin") {
                condition.replace("double", "float").replace("int", "long").replace("void*", "int*")
            } else {
                format!("{condition} + 1")
            };
            if wrong != condition {
                let wrong = format!("{head}_Static_assert({wrong}, \"{label}\n");
                assert!(!compile(&wrong).0, "accepts anything: {wrong}");
            }
        }
    }
}
