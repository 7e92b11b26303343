//! The house rules that a compiler cannot hold.
#![allow(missing_docs)]

use std::fs;
use std::path::{Path, PathBuf};

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

fn in_boundary(path: &Path) -> bool {
    path.components().any(|part| part.as_os_str() == "fmi")
}

/// Code without comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

#[test]
fn tidy_physics_never_mentions_fmi() {
    for (path, text) in sources("src") {
        if !in_boundary(&path) {
            assert!(!text.contains("fmi2"), "{}", path.display());
            let uses = code(&text).replace("pub mod fmi;", "");
            assert!(!uses.contains("fmi::"), "{} uses the boundary", path.display());
        }
    }
}

#[test]
fn tidy_unsafe_code_stays_at_the_boundary() {
    for (path, text) in sources("src") {
        let unsafe_code = code(&text).contains("unsafe ") || text.contains("allow(unsafe_code)");
        assert!(!unsafe_code || in_boundary(&path), "{}", path.display());
    }
}

#[test]
fn tidy_the_library_has_no_clock_no_threads_and_prints_nothing() {
    for (path, text) in sources("src") {
        for forbidden in [
            "println!",
            "print!(",
            "dbg!",
            "std::time",
            "std::thread",
            "thread_local!",
            "static mut",
        ] {
            assert!(!code(&text).contains(forbidden), "{}: {forbidden}", path.display());
        }
    }
}

#[test]
fn tidy_elementary_functions_come_from_one_place() {
    // The platform's functions differ in their last bits. What a coefficient set is fitted to must not
    // depend on them either.
    let fitted_to = |path: &PathBuf| {
        path.ends_with("src/gas.rs")
            || path.components().any(|part| part.as_os_str() == "shock_expansion")
            || path.ends_with("src/shock_expansion.rs")
    };
    let research: Vec<_> =
        sources("crates/research/src").into_iter().filter(|(path, _)| fitted_to(path)).collect();
    assert_eq!(research.len(), 6, "gas, shock_expansion");
    for (path, text) in sources("src").into_iter().chain(research) {
        for forbidden in
            [".sin()", ".cos()", ".tan()", ".exp()", ".ln()", ".powf(", ".tanh()", ".cbrt()"]
        {
            let allowed = forbidden == ".exp()" || forbidden == ".ln()";
            let generic = allowed && path.ends_with("src/atmosphere.rs");
            assert!(!code(&text).contains(forbidden) || generic, "{}: {forbidden}", path.display());
        }
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
    for (path, text) in
        sources("src").into_iter().chain(sources("build/src")).chain(sources("crates/research/src"))
    {
        let lines = text.lines().count();
        assert!(lines <= LIMIT, "{} has {lines} lines", path.display());
    }
}

#[test]
fn tidy_errata_count_on_and_name_tests_that_exist() {
    let errata = include_str!("../src/data/errata.md");
    let number = |line: &str| line.split_once(". ")?.0.parse::<usize>().ok();
    let numbers: Vec<usize> = errata.lines().filter_map(number).collect();
    assert_eq!(numbers, (1..=numbers.len()).collect::<Vec<_>>());

    let tests = sources("tests");
    let named: Vec<&str> = quoted(errata)
        .into_iter()
        .filter(|word| word.starts_with("paper_") || word.starts_with("verif_"))
        .collect();
    assert!(named.len() > 5, "errata name the tests that hold them");
    for name in named {
        let found = tests
            .iter()
            .any(|(path, text)| path.ends_with(name) || text.contains(&format!("fn {name}(")));
        assert!(found, "errata.md names {name}: no such test");
    }
}

#[test]
fn tidy_every_pain_in_the_table_has_tests_that_exist() {
    let code = tested();
    let page = read("tests/README.md");
    let (_, rest) = page.split_once("| pain |").expect("the table of pains");
    let table = rest.split("\n\n").next().unwrap_or_default();
    let rows: Vec<_> = table.lines().filter(|line| line.starts_with("| ")).collect();
    assert!(rows.len() > 10, "the table of pains");
    for row in rows {
        let tests = quoted(row);
        assert!(!tests.is_empty(), "no test: {row}");
        for test in tests {
            assert!(is_test(&code, test), "no such test: {test}");
        }
    }
}

#[test]
fn tidy_the_way_from_the_paper_leads_to_what_exists() {
    let (code, table) = (tested(), read("examples/FROM_THE_PAPER.md"));
    let (variables, commands) =
        (read("modelDescription/modelDescription.xml"), read("build/src/cli.rs").to_lowercase());
    let mut seen = [0; 4];
    for word in quoted(&table) {
        let (kind, exists) = if let Some(command) = word.strip_prefix("cargo ahv ") {
            let name = command.split(' ').next().unwrap_or_default();
            (0, commands.contains(&format!("    {name}(")))
        } else if word.contains('/') {
            (1, root().join(word).exists())
        } else if variables.contains(&format!("<ScalarVariable name=\"{word}\"")) {
            (2, true)
        } else {
            (3, is_test(&code, word))
        };
        assert!(exists, "FROM_THE_PAPER.md names `{word}`: no such thing");
        seen[kind] += 1;
    }
    assert!(seen.iter().all(|&count| count > 5), "commands, paths, variables, tests: {seen:?}");
}

#[test]
fn tidy_links_and_pictures_of_every_page_exist() {
    let root = root();
    let mut pages: Vec<_> = fs::read_dir(root.join("examples"))
        .unwrap()
        .map(|entry| entry.unwrap().path().join("README.md"))
        .filter(|page| page.exists())
        .collect();
    pages.extend(
        ["README.md", "examples/README.md", "examples/FROM_THE_PAPER.md", "tests/README.md"]
            .map(|page| root.join(page)),
    );
    let mut seen = 0;
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let pictures = text.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
        for link in links.chain(pictures).filter(|link| !link.contains("://")) {
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let target = page.parent().unwrap().join(file);
            let target = if file.is_empty() { page.clone() } else { target };
            assert!(target.exists(), "{}: {link}", page.display());
            let anchors = fs::read_to_string(&target).unwrap_or_default().to_lowercase();
            let heading = |line: &str| line.trim_start_matches('#').trim().replace(' ', "-");
            let known = anchors.lines().any(|line| line.starts_with('#') && heading(line) == place);
            assert!(place.is_empty() || known, "{}: {link}", page.display());
            seen += 1;
        }
    }
    assert!(seen > 20, "links and pictures: {seen}");
}
