//! Stress tests of the C interface: random call sequences, AddressSanitizer, valgrind.

use crate::workspace::{cargo, check, target, variable, works};
use anyhow::Result;
use std::path::PathBuf;
use std::process::Command;

/// Environment variable with the number of random call sequences.
pub const SEQUENCES_VARIABLE: &str = "AHV_FUZZ";

/// Default number of sequences: a minute and a half in a release build.
const DEFAULT_SEQUENCES: &str = "100000";
/// Memory checkers are ten to fifty times slower.
const SANITIZER_SEQUENCES: &str = "500";
const VALGRIND_SEQUENCES: &str = "40";

/// The only target for which both memory checkers are used.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// A test program of the shared library; `abi` has all tests that need no process of their own.
fn tests(program: &str) -> Command {
    let mut command = cargo();
    command.args(["test", "--quiet", "--package", "ahv-fmu", "--test", program]);
    command
}

/// Random call sequences in a release build, and tests of faults that only optimised code has.
pub fn fuzz() -> Result<()> {
    let wanted = variable(SEQUENCES_VARIABLE).unwrap_or_else(|| DEFAULT_SEQUENCES.into());
    check(
        tests("abi")
            .args(["--release", "--", "--nocapture", "random_calls::"])
            .env(SEQUENCES_VARIABLE, &wanted),
    )?;
    // Those of the parts.
    check(
        cargo()
            .args(["test", "--quiet", "--workspace", "--test", "calls"])
            .args(["--release", "--", "--nocapture"])
            .env(SEQUENCES_VARIABLE, wanted),
    )?;
    check(tests("abi_host").args(["--release", "--", "--nocapture"]))
}

/// The run-time library of AddressSanitizer, if the toolchain has it.
fn sanitizer_runtime() -> Option<PathBuf> {
    let output = Command::new("rustc").args(["--print", "target-libdir"]).output().ok()?;
    let folder = String::from_utf8(output.stdout).ok()?;
    let here = cfg!(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"));
    let entries = std::fs::read_dir(folder.trim()).ok().filter(|_| here)?;
    entries.flatten().map(|entry| entry.path()).find(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.contains("_rt.asan")
    })
}

/// AddressSanitizer with leak check, in the library and its tests but not in the standard library.
pub fn sanitizer() -> Result<()> {
    if sanitizer_runtime().is_none() {
        errln!("skipped: this toolchain has no AddressSanitizer");
        return Ok(());
    }
    check(
        tests("abi")
            .args(["--target", TARGET, "--target-dir"])
            .arg(target().join("sanitizer"))
            // The run-time library exports functions too.
            .args(["--", "--nocapture", "--skip", "symbols::"])
            .env(SEQUENCES_VARIABLE, SANITIZER_SEQUENCES)
            // The stable compiler accepts the unstable flag only with this.
            .env("RUSTC_BOOTSTRAP", "1")
            // The shared library takes the sanitizer's functions from the test program.
            .env("RUSTFLAGS", "-Zsanitizer=address -Clink-arg=-Wl,--export-dynamic"),
    )
}

/// A sample of sequences in valgrind: no invalid access, no uninitialised memory, no leak.
pub fn valgrind() -> Result<()> {
    if !works("valgrind", &["--version"]) {
        errln!("skipped: valgrind is not installed");
        return Ok(());
    }
    let runner = "target.'cfg(all())'.runner = 'valgrind --quiet --error-exitcode=9 \
                  --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite'";
    check(
        tests("abi")
            // valgrind 3.19 does not know every form of the instructions of AVX.
            .args(["--no-default-features", "--target-dir"])
            .arg(target().join("valgrind"))
            .args(["--config", runner, "--", "--nocapture", "--test-threads=1"])
            .args(["random_calls::", "state::"])
            .env(SEQUENCES_VARIABLE, VALGRIND_SEQUENCES),
    )
}
