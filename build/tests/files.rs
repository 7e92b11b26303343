//! Files that the tool reads and writes: invalid input is refused, and a failed write keeps the old file.

mod tool;

use std::fs;
use std::io::{Cursor, Read, Write};
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
        ("linux64", &text, "README.md: this is not a shared library"),
        ("linux64", &half, "half.so: "),
        ("linux64", &tool, "linux64 needs the functions of FMI 2.0 and 3.0: this library has none"),
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
#[cfg(target_os = "linux")]
fn a_library_that_crashes_its_process_does_not_crash_the_tool() {
    use object::{Object, ObjectSection};
    let (directory, _, fmu) = scratch();
    fs::write(&fmu, "good").unwrap();
    let mut content = fs::read(library()).unwrap();
    let parsed = object::File::parse(&content[..]).unwrap();
    let (start, size) = parsed.section_by_name(".text").unwrap().file_range().unwrap();
    content[start as usize..(start + size) as usize].fill(0);
    let broken = directory.path().join("broken.so");
    fs::write(&broken, content).unwrap();
    let option = format!("linux64={}", broken.display());
    let done = ahv(&["package", "--library", &option, "--output", fmu.to_str().unwrap()]);
    assert!(
        !done.ok && done.err.contains("crashes the process that loads it: signal"),
        "{}",
        done.err
    );
    assert_eq!(fs::read(&fmu).unwrap(), b"good");
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
        [["trim"].as_slice(), &["modes", "--json"], &["poles"], &["--help"], &["fly", "--help"]]
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

/// The FMU with one file in it changed; its new name and content.
fn with(fmu: &[u8], name: &str, change: impl Fn(&str, Vec<u8>) -> (String, Vec<u8>)) -> Vec<u8> {
    let mut old = zip::ZipArchive::new(Cursor::new(fmu)).unwrap();
    let mut new = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for index in 0..old.len() {
        let mut file = old.by_index(index).unwrap();
        let mut content = Vec::new();
        file.read_to_end(&mut content).unwrap();
        let own = file.name().unwrap().into_owned();
        let (own, content) = if own == name { change(&own, content) } else { (own, content) };
        new.start_file(own, zip::write::SimpleFileOptions::default()).unwrap();
        new.write_all(&content).unwrap();
    }
    new.finish().unwrap().into_inner()
}

#[test]
#[cfg(target_os = "linux")]
fn a_foreign_fmu_is_looked_into_before_it_is_loaded() {
    let (directory, option, fmu) = scratch();
    let good = package(&option, &fmu);
    let (xml, library) = ("modelDescription.xml", "binaries/linux64/ahv.so");
    let edit = |from: &str, to: &str| {
        with(&good, xml, |name, text| {
            let text = String::from_utf8(text).unwrap();
            assert!(text.contains(from), "{from}");
            (name.into(), text.replace(from, to).into_bytes())
        })
    };
    for (content, told) in [
        (
            with(&good, library, |name, whole| (name.into(), whole[..10_000].into())),
            "ahv.so: this is not a",
        ),
        (with(&good, library, |name, _| (name.into(), b"text".into())), "ahv.so: this is not a"),
        (
            with(&good, library, |_, whole| ("../../ahv.so".into(), whole)),
            "may lead out of the target folder",
        ),
        (with(&good, xml, |name, _| (name.into(), vec![b'x'; 100_000])), "cannot be read"),
        (with(&good, xml, |name, _| (name.into(), vec![0xff])), "is not UTF-8 text"),
        (
            edit("modelIdentifier=\"ahv\"", "modelIdentifier=\"../ahv\""),
            "\"../ahv\" is not a C identifier",
        ),
        (edit("fmiVersion=\"2.0\"", "fmiVersion=\"1.0\""), "for FMI 1.0; FMI 2.0 or 3.0 is needed"),
        (edit("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\""), "missing field `@instantiationToken`"),
        (edit("CoSimulation", "Other"), "does not support co-simulation"),
    ] {
        let file = directory.path().join("foreign.fmu");
        fs::write(&file, content).unwrap();
        let output = directory.path().join("flight");
        let fly =
            ahv(&["fly", "--fmu", file.to_str().unwrap(), "--output", output.to_str().unwrap()]);
        assert!(!fly.ok && fly.err.contains(told), "{told}: {}", fly.err);
        assert!(fly.err.len() < 1000, "{}", fly.err.len());
    }
}

#[test]
fn numbers_in_messages_are_short() {
    let (directory, option, fmu) = scratch();
    package(&option, &fmu);
    let (fmu, output) = (fmu.to_str().unwrap(), directory.path().to_str().unwrap());
    for arguments in [
        ["fly", "--fmu", fmu, "--output", output, "--stop", "1e150"].as_slice(),
        &["fly", "--fmu", fmu, "--output", output, "--step", "1e-300"],
        &["fly", "--fmu", fmu, "--output", output, "--step", "-1e150"],
        &["trim", "--set", "mach0=1e150"],
        &["trim", "--set", "altitude0=1e-300"],
    ] {
        let done = ahv(arguments);
        assert!(!done.ok && !done.err.contains("00000000"), "{arguments:?}: {}", done.err);
    }
    // A step beyond the end is one step to it.
    let done = ahv(&["fly", "--fmu", fmu, "--output", output, "--step", "1e150", "--stop", "0.01"]);
    assert!(done.ok && done.out.contains("0.01 s in steps of 1e150 s"), "{}{}", done.out, done.err);
}

#[test]
fn a_moved_tool_works_on_the_tree_that_it_lies_in() {
    let scratch = TempDir::new().unwrap();
    let copy = scratch.path().canonicalize().unwrap();
    let built = Path::new(env!("CARGO_BIN_EXE_ahv"));
    let tool = copy.join("target/release").join(built.file_name().unwrap());
    fs::create_dir_all(tool.parent().unwrap()).unwrap();
    fs::copy(built, &tool).unwrap();
    let describe = |told: &str| {
        let mut command = Command::new(&tool);
        command.arg("describe").current_dir("/").env_remove("CARGO_MANIFEST_DIR");
        let done: Outcome = command.output().unwrap().into();
        assert!(format!("{}{}", done.out, done.err).contains(told), "{}{}", done.out, done.err);
    };
    describe("no sources of ahv at or above");
    fs::write(copy.join("Cargo.toml"), "[package]\nname = \"ahv-fmu\"\n").unwrap();
    describe("modelDescription.xml");
    assert!(copy.join("modelDescription/modelDescription.xml").exists());
}
