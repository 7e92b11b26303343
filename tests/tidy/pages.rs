//! Pages name what exists.

use crate::{is_test, quoted, read, root, tested};
use std::fs;

#[test]
fn tidy_errata_count_on_and_name_tests_that_exist() {
    let errata = include_str!("../../src/data/errata.md");
    let number = |line: &str| line.split_once(". ")?.0.parse::<usize>().ok();
    let numbers: Vec<usize> = errata.lines().filter_map(number).collect();
    assert_eq!(numbers, (1..=numbers.len()).collect::<Vec<_>>());

    let code = tested();
    let is_named =
        |word: &&str| ["paper_", "verif_", "tests/"].iter().any(|start| word.starts_with(start));
    let named: Vec<&str> = quoted(errata).into_iter().filter(is_named).collect();
    assert!(named.len() > 5, "errata name the tests that hold them");
    for name in named {
        let found = root().join(name).exists() || is_test(&code, name);
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
        [
            "README.md",
            "CONTRIBUTING.md",
            "examples/README.md",
            "examples/FROM_THE_PAPER.md",
            "tests/README.md",
        ]
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
            // Letters, digits and hyphens are kept.
            let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
            let heading = |line: &str| {
                let title: String =
                    line.trim_start_matches('#').trim().chars().filter(kept).collect();
                title.replace(' ', "-")
            };
            let known = anchors.lines().any(|line| line.starts_with('#') && heading(line) == place);
            assert!(place.is_empty() || known, "{}: {link}", page.display());
            seen += 1;
        }
    }
    assert!(seen > 20, "links and pictures: {seen}");
}

#[test]
fn tidy_the_guide_for_contributors_names_what_exists() {
    let page = read("CONTRIBUTING.md");
    let (code, scripts) = page.split("```").enumerate().partition::<Vec<_>, _>(|(i, _)| i % 2 == 0);
    let prose: String = code.into_iter().map(|(_, text)| text).collect();
    let paths = quoted(&prose)
        .into_iter()
        .filter(|word| word.contains('/') && !word.contains([' ', '=']) && !word.contains("NAME"));
    let mut seen = 0;
    for path in paths.filter(|path| !path.starts_with("target/")) {
        assert!(root().join(path).exists(), "CONTRIBUTING.md names {path}: no such file");
        seen += 1;
    }
    let commands = read("build/src/cli.rs").to_lowercase();
    for (_, script) in scripts {
        for rest in script.split("cargo ahv ").skip(1) {
            let name = rest.split(|c: char| !c.is_ascii_lowercase()).next().unwrap_or_default();
            assert!(commands.contains(&format!("    {name}(")), "no such command: {name}");
            seen += 1;
        }
    }
    assert!(seen > 5, "paths and commands: {seen}");
}

#[test]
fn tidy_the_citation_has_the_version_of_the_package() {
    let version = format!("\nversion: {}\n", env!("CARGO_PKG_VERSION"));
    assert!(read("CITATION.cff").contains(&version), "CITATION.cff: {version}");
}
