//! Tests that the tools accept every command in the pages and help texts.

use crate::cli::Cli;
use ahv_tool::cli::{Cli as Tool, Command};
use ahv_tool::workspace::{MAX_TEXT_BYTES, read_text, root};
use clap::Parser;
use clap::error::ErrorKind;

/// The commands in a text: what follows `cargo ahv` on a line, up to one of the ends.
fn commands<'a>(text: &'a str, ends: &[&str]) -> Vec<Vec<&'a str>> {
    let lines = text.lines().flat_map(|line| line.split("cargo ahv ").skip(1));
    lines
        .map(|rest| {
            let end = ends.iter().filter_map(|end| rest.find(end)).min();
            let words = rest[..end.unwrap_or(rest.len())].split_whitespace();
            ["cargo ahv"].into_iter().chain(words).collect()
        })
        .collect()
}

fn taken(command: &[&str]) -> Result<(), clap::Error> {
    let research = match Tool::try_parse_from(command) {
        Ok(Tool { command }) => matches!(
            command,
            Command::Reproduce(_)
                | Command::Identify(_)
                | Command::Fit(_)
                | Command::Methods(_)
                | Command::Bench(_)
        ),
        Err(error) if error.kind() == ErrorKind::DisplayHelp => false,
        Err(error) => return Err(error),
    };
    if research { Cli::try_parse_from(command).map(drop) } else { Ok(()) }
}

#[test]
fn every_command_on_a_page_or_in_a_help_text_is_taken() {
    const PAGES: [&str; 8] = [
        "README.md",
        "tests/README.md",
        "examples/README.md",
        "examples/FROM_THE_PAPER.md",
        "examples/closed_loop/README.md",
        "examples/ensemble/README.md",
        "examples/gusts/README.md",
        "examples/own_vehicle/README.md",
    ];
    const HELP: [&str; 2] = ["build/src/cli.rs", "crates/research/src/cli.rs"];
    let mut seen = 0;
    let pages = PAGES.iter().map(|page| (page, &["`", "#", ">"][..]));
    let help = HELP.iter().map(|page| (page, &["    ", "\"", "`", ";"][..]));
    for (page, ends) in pages.chain(help) {
        let text = read_text(&root().join(page), MAX_TEXT_BYTES).unwrap();
        for command in commands(&text, ends) {
            // A placeholder.
            if command.get(1) == Some(&"COMMAND") {
                continue;
            }
            taken(&command).unwrap_or_else(|error| panic!("{page}: {command:?}: {error}"));
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}
