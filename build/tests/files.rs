//! What the tool reads and writes: rubbish is refused, and what was there stays until the new is whole.
#![allow(clippy::disallowed_methods)]

mod tool;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use tool::{Outcome, ahv, library, package, scratch};

/// The tool where no file may grow beyond 1 kB, as on a full disk.
#[cfg(unix)]
fn on_a_full_disk(arguments: &[&str]) -> Outcome {
    let limited = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
    let tool = env!("CARGO_BIN_EXE_ahv");
    Command::new("sh").args(["-c", limited, tool]).args(arguments).output().unwrap().into()
}

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
#[cfg(unix)]
fn a_full_disk_leaves_the_old_file_whole() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("old.xml");
    fs::write(&file, "old").unwrap();
    let full = on_a_full_disk(&["describe", "--file", file.to_str().unwrap()]);
    assert!(!full.ok && full.err.contains("cannot write "), "{}", full.err);
    assert_eq!(fs::read(&file).unwrap(), b"old");
    assert_eq!(names(directory.path()), ["old.xml"]);
}

#[test]
fn rubbish_replaces_no_fmu() {
    let (directory, _, fmu) = scratch();
    fs::write(&fmu, "good").unwrap();
    let text = directory.path().join("README.md");
    fs::write(&text, "# ahv").unwrap();
    let half = directory.path().join("half.so");
    let whole = fs::read(library()).unwrap();
    fs::write(&half, &whole[..whole.len() / 2]).unwrap();
    let tool = PathBuf::from(env!("CARGO_BIN_EXE_ahv"));
    for (platform, file, told) in [
        ("linux64", &text, "README.md: this is no shared library"),
        ("linux64", &half, "half.so: "),
        ("linux64", &tool, "linux64 needs the functions of FMI 2.0: this library has none"),
        ("win64", &library(), "win64 needs Pe for X86_64, this is Elf for X86_64"),
        ("aarch64-linux", &library(), "aarch64-linux needs Elf for Aarch64"),
        ("linux64", &directory.path().into(), "is a directory; a file is expected"),
    ] {
        let option = format!("{platform}={}", file.display());
        let done = ahv(&["package", "--library", &option, "--output", fmu.to_str().unwrap()]);
        assert!(!done.ok && done.err.contains(told), "{option}: {}", done.err);
        assert_eq!(fs::read(&fmu).unwrap(), b"good");
    }
}

#[test]
fn a_flight_that_cannot_be_written_leaves_the_older_one() {
    let (directory, option, fmu) = scratch();
    package(&option, &fmu);
    let results = directory.path().join("flight");
    fs::create_dir_all(results.join("flight.svg")).unwrap();
    fs::write(results.join("flight.csv"), "old").unwrap();
    let results = results.to_str().unwrap();
    let fly = ahv(&["fly", "--fmu", fmu.to_str().unwrap(), "--stop", "0.02", "--output", results]);
    assert!(!fly.ok && fly.err.contains("flight.svg: it is a directory"), "{}", fly.err);
    assert_eq!(fs::read(Path::new(results).join("flight.csv")).unwrap(), b"old");
}

#[test]
#[cfg(unix)]
fn input_without_end_is_refused_at_once() {
    let directory = TempDir::new().unwrap();
    let pipe = directory.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let pipe = pipe.to_str().unwrap();
    for endless in ["/dev/zero", pipe] {
        for option in ["--vehicle", "--coefficients"] {
            let trim = ahv(&["trim", option, endless]);
            assert!(!trim.ok && trim.err.contains("a regular file is expected"), "{}", trim.err);
        }
        let fly = ahv(&["fly", "--fmu", endless]);
        assert!(!fly.ok && fly.err.contains("a regular file is expected"), "{}", fly.err);
    }
    let large = directory.path().join("large.toml");
    fs::File::create(&large).unwrap().set_len(1 << 40).unwrap();
    let trim = ahv(&["trim", "--vehicle", large.to_str().unwrap()]);
    assert!(!trim.ok && trim.err.contains("large.toml is too large"), "{}", trim.err);
}

#[test]
#[cfg(unix)]
fn output_that_cannot_be_written_is_an_error_and_a_closed_pipe_is_none() {
    let tool = env!("CARGO_BIN_EXE_ahv");
    for arguments in
        [["trim"].as_slice(), &["modes", "--json"], &["poles"], &["--help"], &["fit", "--help"]]
    {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let done = Command::new(tool).args(arguments).stdout(full).output().unwrap();
        let told = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(1), "{arguments:?}: {told}");
        assert!(told.starts_with("error: cannot write to standard output: No space"), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");

        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let done = Command::new(tool).args(arguments).stdout(writer).output().unwrap();
        assert_eq!((done.status.code(), done.stderr.as_slice()), (Some(0), b"".as_slice()));
    }
}
