//! Tests: files are read with limits and written whole or not at all; the repository is found at run time.
#![allow(clippy::disallowed_methods)]

use super::*;
use std::fs;
use tempfile::TempDir;

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A directory that the search accepts as a repository.
fn repository(directory: &Path) {
    fs::create_dir_all(directory.join("build")).unwrap();
    fs::write(directory.join("Cargo.toml"), "[package]\nname = \"ahv-fmu\"\n").unwrap();
    fs::write(directory.join("build/Cargo.toml"), "[package]\nname = \"ahv\"\n").unwrap();
}

#[test]
fn a_copied_tree_is_its_own_root() {
    let scratch = TempDir::new().unwrap();
    let [ours, copy, elsewhere] = ["ours", "copy", "other"].map(|name| scratch.path().join(name));
    repository(&ours);
    repository(&copy);
    fs::create_dir_all(&elsewhere).unwrap();
    let tool = copy.join("target/release/ahv");
    for (places, root) in [
        (vec![tool.clone(), ours.clone()], Some(&copy)),
        (vec![ours.join("build"), tool], Some(&ours)),
        (vec![elsewhere.join("release/ahv"), copy.join("examples/gusts")], Some(&copy)),
        (vec![elsewhere], None),
    ] {
        assert_eq!(search(&places).as_ref(), root, "{places:?}");
    }
}

#[test]
fn what_is_too_large_or_never_ends_is_not_read() {
    let scratch = TempDir::new().unwrap();
    let file = scratch.path().join("a.toml");
    fs::write(&file, [b'#'; 11]).unwrap();
    assert_eq!(read(&file, 11).unwrap().len(), 11);
    for (path, most, told) in [
        (file.as_path(), 10, "a.toml is too large"),
        (scratch.path(), 10, "is a directory; a file is expected"),
        #[cfg(unix)]
        (Path::new("/dev/zero"), 10, "/dev/zero is a device or a pipe"),
    ] {
        let message = format!("{:#}", read(path, most).unwrap_err());
        assert!(message.contains(told), "{message}");
    }
}

#[test]
fn a_written_file_leaves_nothing_beside_it_and_keeps_links_and_permissions() {
    let scratch = TempDir::new().unwrap();
    let file = scratch.path().join("new/a.csv");
    write(&file, "old").unwrap();
    write(&file, "new").unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"new");
    assert_eq!(names(file.parent().unwrap()), ["a.csv"]);
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
        fs::set_permissions(&file, fs::Permissions::from_mode(0o755)).unwrap();
        let link = scratch.path().join("link.csv");
        symlink(&file, &link).unwrap();
        write(&link, "through").unwrap();
        assert!(link.is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"through");
        assert_eq!(fs::metadata(&file).unwrap().mode() & 0o777, 0o755);
    }
}

#[test]
fn what_is_no_file_of_ours_is_not_replaced() {
    let scratch = TempDir::new().unwrap();
    let file = scratch.path().join("a.csv");
    write(&file, "old").unwrap();
    let mut permissions = fs::metadata(&file).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&file, permissions).unwrap();
    for (path, told) in [
        (file.as_path(), "a.csv: it is read-only"),
        (scratch.path(), "it is a directory"),
        (&file.join("b.csv"), "a.csv is a file, not a directory"),
        #[cfg(unix)]
        (Path::new("/dev/full"), "it is a device or a pipe"),
    ] {
        let message = format!("{:#}", write(path, "new").unwrap_err());
        assert!(message.contains(told), "{message}");
    }
    assert_eq!(fs::read(&file).unwrap(), b"old");
}

#[test]
fn files_that_belong_together_are_replaced_together() {
    let scratch = TempDir::new().unwrap();
    let of = |content: &str, names: [&str; 2]| -> Files {
        names.map(|name| (scratch.path().join(name), content.as_bytes().to_vec())).into()
    };
    write_together(&of("old", ["a.svg", "b.png"])).unwrap();
    // The second cannot be written: below a file there is no place.
    write_together(&of("new", ["a.svg", "b.png/c"])).unwrap_err();
    assert_eq!(fs::read(scratch.path().join("a.svg")).unwrap(), b"old");
    assert_eq!(names(scratch.path()), ["a.svg", "b.png"]);
    write_together(&of("new", ["a.svg", "b.png"])).unwrap();
    assert_eq!(fs::read(scratch.path().join("b.png")).unwrap(), b"new");
}
