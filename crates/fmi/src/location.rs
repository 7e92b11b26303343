//! Where a package's resources are: the folder that a master names by a URI (FMI 2.0, section 2.1.5) or
//! by its path; and the files in it.

use std::fs::{File, symlink_metadata};
use std::io::{Error, Read, Result};
use std::path::{Path, PathBuf};

/// The text of a file, up to a size. Links, devices and pipes are refused: those may never end.
///
/// # Errors
/// Those of the system, and what is refused.
#[expect(clippy::disallowed_methods, reason = "the one place of the library that reads files")]
pub fn text(path: &Path, most_bytes: u64) -> Result<String> {
    let file = symlink_metadata(path)?;
    if !file.is_file() {
        return Err(Error::other("it is no regular file"));
    }
    if file.len() > most_bytes {
        return Err(Error::other(format!("it has more than {} MB", most_bytes / 1_000_000)));
    }
    let mut text = String::new();
    File::open(path)?.take(most_bytes).read_to_string(&mut text)?;
    Ok(text)
}

/// The folder that `fmuResourceLocation` names: a URI with the scheme `file`, or a plain path, as some
/// masters pass; none if it is empty.
pub fn folder(location: &str) -> Option<PathBuf> {
    (!location.is_empty()).then(|| path(location, cfg!(windows)).into())
}

/// The URI of a folder, which [`folder`] turns back into its path.
pub fn uri(folder: &Path) -> String {
    let text = folder.to_string_lossy();
    let text = if cfg!(windows) { text.replace('\\', "/") } else { text.into_owned() };
    let mut uri = String::from(if text.starts_with('/') { "file://" } else { "file:///" });
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' | b':' => {
                uri.push(byte.into());
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

fn path(location: &str, windows: bool) -> String {
    let Some(rest) = after_scheme(location) else { return location.to_string() };
    let path = match rest.strip_prefix("//") {
        None => decoded(rest),
        Some(rest) => {
            let (host, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
            match host {
                "" => decoded(path),
                _ if host.eq_ignore_ascii_case("localhost") => decoded(path),
                // A slash too few before the drive.
                _ if windows && is_drive(host) => decoded(rest),
                // Another machine's folder on Windows; elsewhere the host is the first folder.
                _ => decoded(&format!("//{rest}")),
            }
        }
    };
    match path.strip_prefix('/') {
        Some(drive) if windows && is_drive(drive.split('/').next().unwrap_or_default()) => {
            drive.to_string()
        }
        _ => path,
    }
}

/// What follows `file:`, in letters of any size.
fn after_scheme(location: &str) -> Option<&str> {
    let (scheme, rest) = location.split_once(':')?;
    scheme.eq_ignore_ascii_case("file").then_some(rest)
}

fn is_drive(text: &str) -> bool {
    matches!(text.as_bytes(), [letter, b':'] if letter.is_ascii_alphabetic())
}

/// Without percent-encoding; a percent sign without two digits stands for itself.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        let code = match rest {
            [b'%', high, low, ..] => {
                let digit = |byte: &u8| char::from(*byte).to_digit(16);
                digit(high).zip(digit(low)).map(|(high, low)| (16 * high + low) as u8)
            }
            _ => None,
        };
        bytes.push(code.unwrap_or(*first));
        rest = if code.is_some() { &rest[3..] } else { after };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_name_a_folder_leads_to_it() {
        for (location, expected) in [
            ("file:///tmp/a/resources", "/tmp/a/resources"),
            ("file:/tmp/a/resources", "/tmp/a/resources"),
            ("file://localhost/tmp/a/resources", "/tmp/a/resources"),
            ("FILE:///tmp/resources/", "/tmp/resources/"),
            ("file:///tmp/with%20space/resources", "/tmp/with space/resources"),
            ("file:///tmp/with space/resources", "/tmp/with space/resources"),
            ("file:///tmp/gr%C3%BCn/resources", "/tmp/grün/resources"),
            ("file:///tmp/grün/resources", "/tmp/grün/resources"),
            ("file:///tmp/50%/100%zz/%4", "/tmp/50%/100%zz/%4"),
            ("file:///tmp/a%2Fb%25", "/tmp/a/b%"),
            ("file:///C:/a", "/C:/a"),
            ("file:relative/a", "relative/a"),
            ("file://tmp/a", "//tmp/a"),
            ("/tmp/with%20percent/resources", "/tmp/with%20percent/resources"),
            ("relative/resources", "relative/resources"),
            ("file", "file"),
        ] {
            assert_eq!(path(location, false), expected, "{location}");
        }
    }

    #[test]
    fn drives_of_windows_have_no_slash_before_them() {
        for (location, expected) in [
            ("file:///C:/My%20FMUs/resources", "C:/My FMUs/resources"),
            ("file:/C:/resources", "C:/resources"),
            ("file:C:/resources", "C:/resources"),
            ("file://localhost/c:/resources/", "c:/resources/"),
            ("file://C:/resources", "C:/resources"),
            ("file:///C%3A/resources", "C:/resources"),
            ("file://server/share/resources", "//server/share/resources"),
            ("C:\\FMUs\\resources", "C:\\FMUs\\resources"),
            ("\\\\server\\share", "\\\\server\\share"),
        ] {
            assert_eq!(path(location, true), expected, "{location}");
        }
    }

    #[test]
    fn a_folder_without_a_name_is_none_and_a_uri_leads_back_to_its_folder() {
        assert_eq!(folder(""), None);
        for name in ["/tmp/a", "/tmp/50%25 #?/grün", "/"] {
            let name = if cfg!(windows) { format!("C:{name}") } else { name.to_string() };
            let uri = uri(Path::new(&name));
            assert!(uri.is_ascii() && uri.starts_with("file:///"), "{uri}");
            assert_eq!(folder(&uri), Some(PathBuf::from(name)));
        }
    }
}
