//! The house rules that a compiler cannot hold.

mod pages;
mod rooms;

use std::fs;
use std::path::PathBuf;

/// The repository as Cargo runs it: a copy may hold a test that was compiled elsewhere.
fn root() -> PathBuf {
    std::env::var_os("CARGO_MANIFEST_DIR").expect("Cargo runs the tests").into()
}

fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    files(folder, "rs")
}

fn files(folder: &str, kind: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == kind) {
                let text = fs::read_to_string(&path).unwrap();
                found.push((path, text));
            }
        }
    }
    assert!(found.len() > 5, "{folder} has sources");
    found
}

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

/// What stands between backquotes.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// All code that may hold a test.
fn tested() -> String {
    ["src", "build", "crates", "tests"]
        .iter()
        .flat_map(|folder| sources(folder))
        .chain(files("tests", "py"))
        .map(|(_, text)| text)
        .collect()
}

fn is_test(code: &str, name: &str) -> bool {
    ["fn", "def"].iter().any(|word| code.contains(&format!("{word} {name}(")))
}

/// Code without comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

#[test]
fn tidy_physics_never_mentions_fmi() {
    for (path, text) in sources("src") {
        let boundary = ["src/variables", "src/fmu", "src/lib.rs"];
        let place = path.strip_prefix(root()).unwrap().display().to_string();
        if !boundary.iter().any(|allowed| place.starts_with(allowed)) {
            let code = code(&text);
            assert!(!code.contains("fmi2") && !code.contains("fmi_model"), "{place}");
        }
    }
}

#[test]
fn tidy_the_fmi_layer_knows_no_vehicle() {
    for (path, text) in sources("crates/fmi") {
        for word in ["ahv::", "vehicle", "aircraft", "flight"] {
            assert!(!text.contains(word), "{}: {word}", path.display());
        }
    }
    let manifest = read("crates/fmi/Cargo.toml");
    assert!(!manifest.contains("ahv"), "crates/fmi depends on the vehicle");
}

#[test]
fn tidy_unsafe_code_stays_at_the_boundary() {
    let held = ["src", "crates/fmi/src", "crates/wasm/src"].iter().flat_map(|room| sources(room));
    for (path, text) in held {
        let boundary = [
            "crates/fmi/src/abi.rs",
            "crates/fmi/src/export.rs",
            "crates/fmi/src/v2/abi.rs",
            "crates/fmi/src/v3/abi.rs",
            "crates/wasm/src/lib.rs",
        ];
        let allowed = boundary.iter().any(|place| path.ends_with(place));
        assert!(allowed || !text.contains("allow(unsafe_code"), "{}", path.display());
    }
}

#[test]
fn tidy_the_model_never_reads_the_published_tables() {
    for (path, text) in sources("src") {
        assert!(!text.contains("published.toml"), "{}", path.display());
    }
}

#[test]
fn tidy_files_have_one_job() {
    /// Lines; data tables and tests may be longer.
    const LIMIT: usize = 330;
    for (path, text) in sources("src")
        .into_iter()
        .chain(sources("build/src"))
        .chain(sources("crates/fmi/src"))
        .chain(sources("crates/wasm/src"))
        .chain(sources("crates/research/src"))
        .chain(files("site/src", "ts"))
    {
        let lines = text.lines().count();
        assert!(lines <= LIMIT, "{} has {lines} lines", path.display());
    }
}
