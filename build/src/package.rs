//! Builds the library and puts the FMU together.

use crate::cli::Package;
use crate::describe::{self, MODEL_IDENTIFIER};
use crate::workspace::{cargo, read, root, shown, target, write};
use crate::{documentation, licenses};
use anyhow::{Context, Result, anyhow, bail};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

/// Platforms by their name in an FMU, with the ending of a library there.
const PLATFORMS: [(&str, &str); 3] = [("linux64", "so"), ("win64", "dll"), ("darwin64", "dylib")];

/// The platform of this machine, with the ending of its libraries.
pub const HOST: (&str, &str) = if cfg!(windows) {
    PLATFORMS[1]
} else if cfg!(target_os = "macos") {
    PLATFORMS[2]
} else {
    PLATFORMS[0]
};

pub fn run(options: &Package) -> Result<()> {
    let output = options.output.clone().unwrap_or_else(default_output);
    let libraries = if options.library.is_empty() {
        vec![(HOST, library()?)]
    } else {
        options.library.iter().map(|text| given(text)).collect::<Result<_>>()?
    };
    let size = package(&libraries, &output)?;
    let platforms: Vec<_> = libraries.iter().map(|((name, _), _)| *name).collect();
    println!("{}: {} kB, {}", shown(&output), size.div_ceil(1000), platforms.join(", "));
    Ok(())
}

/// Builds and packages for this machine; the path of the FMU.
pub fn build() -> Result<PathBuf> {
    let output = default_output();
    package(&[(HOST, library()?)], &output)?;
    Ok(output)
}

fn default_output() -> PathBuf {
    target().join(MODEL_IDENTIFIER).with_extension("fmu")
}

/// A library given as `platform=file`.
fn given(text: &str) -> Result<((&'static str, &'static str), PathBuf)> {
    let known = || PLATFORMS.map(|(name, _)| name).join(", ");
    let Some((name, file)) = text.split_once('=') else {
        bail!("--library {text}: PLATFORM=FILE is expected; platforms are {}", known());
    };
    let Some(platform) = PLATFORMS.into_iter().find(|(known, _)| *known == name) else {
        bail!("--library {text}: there is no platform `{name}`; platforms are {}", known());
    };
    Ok((platform, file.into()))
}

/// Compiles the library; where Cargo put it.
///
/// It has a target directory of its own, because its compiler flags differ from those of a plain
/// build, and the two would otherwise overwrite each other.
fn library() -> Result<PathBuf> {
    let mut command = cargo();
    command
        .args(["build", "--quiet", "--release", "--package", "ahv-fmu", "--lib"])
        .args(["--config", "profile.release.strip='symbols'"])
        .arg("--message-format=json-render-diagnostics")
        .arg("--target-dir")
        .arg(target().join("fmu"))
        .env("CARGO_ENCODED_RUSTFLAGS", rustflags())
        .stderr(Stdio::inherit());
    let output = command.output().context("cannot start cargo")?;
    if !output.status.success() {
        bail!("the library does not build: see the messages of cargo above");
    }
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .filter(|message| message["reason"] == "compiler-artifact")
        .filter_map(|message| message["filenames"].as_array().cloned())
        .flatten()
        .filter_map(|file| file.as_str().map(PathBuf::from))
        .find(|file| {
            file.extension().is_some_and(|ending| ending == HOST.1)
                && file.file_stem().is_some_and(|stem| {
                    stem.to_string_lossy().trim_start_matches("lib") == MODEL_IDENTIFIER
                })
        })
        .ok_or_else(|| anyhow!("cargo did not say where the library ahv.{} is", HOST.1))
}

/// Flags that keep the builder's directories out of the library: panic messages name source files.
fn rustflags() -> OsString {
    let home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::home_dir().map(|home| home.join(".cargo")));
    let mut prefixes = vec![(root().to_path_buf(), MODEL_IDENTIFIER)];
    let registries = home.and_then(|home| fs::read_dir(home.join("registry/src")).ok());
    let directories = registries.into_iter().flatten().flatten();
    prefixes.extend(directories.map(|directory| (directory.path(), "crates")));
    prefixes.sort();
    let mut flags =
        OsString::from(std::env::var("RUSTFLAGS").unwrap_or_default().replace(' ', "\x1f"));
    for (path, name) in prefixes {
        if !flags.is_empty() {
            flags.push("\x1f");
        }
        flags.push("--remap-path-prefix=");
        flags.push(path);
        flags.push(format!("={name}"));
    }
    flags
}

/// Writes the FMU; its size in bytes.
fn package(libraries: &[((&str, &str), PathBuf)], output: &Path) -> Result<usize> {
    let mut files = BTreeMap::new();
    files.insert("modelDescription.xml".to_string(), describe::xml()?.into_bytes());
    files.insert("documentation/index.html".to_string(), documentation::html()?.into_bytes());
    files.extend(licenses::collect()?);
    let icon = root().join("modelDescription/model.png");
    if icon.exists() {
        files.insert("model.png".to_string(), read(&icon)?);
    }
    for ((platform, ending), library) in libraries {
        let name = format!("binaries/{platform}/{MODEL_IDENTIFIER}.{ending}");
        files.insert(name, read(library)?);
    }
    let bytes = zip(&files)?;
    write(output, &bytes)?;
    Ok(bytes.len())
}

/// Plain zip that every unzipper reads: deflate, sorted names, one date, no zip64. The same files
/// give the same bytes.
fn zip(files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(9))
            .last_modified_time(DateTime::default())
            .system(System::Unix)
            .unix_permissions(mode);
        zip.start_file(name.as_str(), options)?;
        zip.write_all(content)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Little-endian number of two bytes.
    fn word(bytes: &[u8], at: usize) -> u16 {
        u16::from_le_bytes([bytes[at], bytes[at + 1]])
    }

    #[test]
    fn zip_is_plain_and_reproducible() {
        let files = BTreeMap::from([
            ("modelDescription.xml".to_string(), b"<x/>".repeat(100)),
            ("binaries/linux64/ahv.so".to_string(), vec![0; 5000]),
        ]);
        let bytes = zip(&files).unwrap();
        assert_eq!(bytes, zip(&files).unwrap());

        // Fields of a local file header: APPNOTE.TXT 6.3.10, section 4.3.7.
        assert_eq!(&bytes[..4], b"PK\x03\x04");
        assert_eq!(word(&bytes, 4), 20, "version needed is 2.0");
        assert_eq!(word(&bytes, 6) & (1 << 3), 0, "no data descriptor");
        assert_eq!(word(&bytes, 8), 8, "deflate");
        assert_eq!((word(&bytes, 10), word(&bytes, 12)), (0, 0x21), "1980-01-01 00:00");
        assert_eq!(word(&bytes, 28), 0, "no extra field, so no zip64");
        assert!(!bytes.windows(4).any(|four| four == b"PK\x06\x06"), "no zip64 directory");

        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        for (index, (name, mode)) in
            [("binaries/linux64/ahv.so", 0o100_755), ("modelDescription.xml", 0o100_644)]
                .into_iter()
                .enumerate()
        {
            let file = archive.by_index(index).unwrap();
            assert_eq!((file.name().unwrap().as_ref(), file.unix_mode()), (name, Some(mode)));
        }
    }

    #[test]
    fn library_options_name_the_platform() {
        assert_eq!(given("win64=a.dll").unwrap(), (("win64", "dll"), PathBuf::from("a.dll")));
        let message = given("win32=a.dll").unwrap_err().to_string();
        assert!(message.contains("`win32`") && message.contains("linux64, win64, darwin64"));
    }
}
