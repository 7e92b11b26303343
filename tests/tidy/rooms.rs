//! Rooms import from rooms below them alone, and no files import each other in a circle.

use crate::{code, root, sources};
use std::path::Path;

/// Rooms of the physics from the bottom up: each imports from itself and from those before it alone.
const ROOMS: [&str; 11] = [
    "solve",
    "short",
    "error",
    "data",
    "structure",
    "air",
    "vehicle",
    "dynamics",
    "flight",
    "variables",
    "fmu",
];

/// A file of a room: its path of modules, `["structure", "modes", "align"]`, and those that it imports.
struct Module {
    path: Vec<String>,
    imports: Vec<Vec<String>>,
    /// Whether it only declares and re-exports others.
    is_list: bool,
}

/// Words of a code, paths in one piece; a name in braces comes with the path before them.
fn words(code: &str) -> Vec<String> {
    let inside = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let (mut found, mut rest) = (Vec::new(), code);
    while let Some(start) = rest.find(inside) {
        let end = rest[start..].find(|c| !inside(c)).map_or(rest.len(), |end| start + end);
        let word = &rest[start..end];
        rest = &rest[end..];
        match rest.strip_prefix('{').filter(|_| word.ends_with("::")) {
            None => found.push(word.to_owned()),
            Some(group) => {
                let (names, after) = group.split_once('}').unwrap_or((group, ""));
                found.extend(names.split(',').map(|name| format!("{word}{}", name.trim())));
                rest = after;
            }
        }
    }
    found
}

/// Words of a code, without re-exports of names that it does not use itself.
fn used_words(code: &str) -> Vec<String> {
    let is_export = |statement: &&str| {
        let exports = ["pub use ", "pub(crate) use "];
        exports.iter().any(|export| statement.trim_start().starts_with(export))
    };
    let (exports, own): (Vec<_>, Vec<_>) = code.split(';').partition(is_export);
    let own = words(&own.join(";"));
    let is_used = |path: &String| {
        let name = path.rsplit("::").next();
        path.contains("::") && own.iter().any(|word| word.split("::").next() == name)
    };
    let used: Vec<_> = words(&exports.join(";")).into_iter().filter(is_used).collect();
    [own, used].concat()
}

/// The file, of those in `paths`, that a word in another one names, if it is a path at all.
fn imported(paths: &[Vec<String>], from: &[String], word: &str) -> Option<Vec<String>> {
    let parts: Vec<_> = word.split("::").map(str::to_owned).collect();
    let ups = parts.iter().take_while(|part| *part == "super").count();
    let mut to = match parts[0].as_str() {
        _ if parts.len() < 2 => return None,
        "crate" => parts[1..].to_vec(),
        "super" => [&from[..from.len() - ups], &parts[ups..]].concat(),
        _ => [from, &parts].concat(),
    };
    while !paths.contains(&to) {
        to.pop()?;
    }
    Some(to).filter(|to| to != from)
}

fn modules() -> Vec<Module> {
    let module = |path: &Path| -> Vec<String> {
        let path = path.strip_prefix(root().join("src")).unwrap().with_extension("");
        let parts = path.iter().map(|part| part.to_str().unwrap().to_owned());
        parts.filter(|part| part != "mod" && part != "lib").collect()
    };
    let sources = sources("src");
    let paths: Vec<_> = sources.iter().map(|(path, _)| module(path)).collect();
    let files = sources.iter().zip(&paths);
    files
        .filter(|(_, path)| !path.is_empty())
        .map(|((_, text), path)| {
            let code = code(text);
            let words = used_words(code.split("#[cfg(test)]").next().unwrap_or_default());
            let items = ["fn", "struct", "enum", "trait", "impl", "const", "type"];
            Module {
                path: path.clone(),
                imports: words.iter().filter_map(|word| imported(&paths, path, word)).collect(),
                is_list: !words.iter().any(|word| items.contains(&word.as_str())),
            }
        })
        .collect()
}

#[test]
fn tidy_rooms_import_from_those_below_alone() {
    let place = |path: &[String]| {
        ROOMS.iter().position(|room| Some(*room) == path.first().map(String::as_str))
    };
    for Module { path, imports, .. } in modules() {
        let own = place(&path);
        assert!(own.is_some(), "{path:?} is in no room");
        for import in imports {
            let below = place(&import).is_some_and(|room| Some(room) <= own);
            assert!(below, "{path:?} imports {import:?}, which is above it");
        }
    }
}

#[test]
fn tidy_no_files_import_each_other_in_a_circle() {
    let mut left = modules();
    let imports: usize = left.iter().map(|module| module.imports.len()).sum();
    assert!(imports > 100, "{imports} imports");
    let lists = left.iter().filter(|module| module.is_list).map(|list| list.path.clone());
    let lists: Vec<_> = lists.collect();
    for Module { path, imports, .. } in &left {
        let hidden =
            imports.iter().find(|import| lists.contains(import) && path.starts_with(import));
        assert_eq!(hidden, None, "{path:?} imports from its own room: name the file, not the room");
    }
    loop {
        let known: Vec<_> = left.iter().map(|module| module.path.clone()).collect();
        left.retain(|module| module.imports.iter().any(|import| known.contains(import)));
        if left.len() == known.len() {
            break;
        }
    }
    let left: Vec<_> = left.iter().map(|module| module.path.join("::")).collect();
    assert!(left.is_empty(), "in a circle, or above one: {left:?}");
}
