//! Reading files with a size limit, and replacing files whole or not at all.

use super::shown;
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::fs::{self, File, Permissions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Size limit of a data file; ours have 8 kB.
pub const MAX_DATA_BYTES: u64 = 1_000_000;
/// Size limit of a text; the record of a million steps has 200 MB.
pub const MAX_TEXT_BYTES: u64 = 500_000_000;
/// Size limit of a library or an FMU.
pub const MAX_BINARY_BYTES: u64 = 500_000_000;

/// Contents of files that belong together, by path.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// Reads a regular file of at most `most` bytes. Devices and pipes, which may never end, are refused.
#[allow(clippy::disallowed_methods)]
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let name = shown(path);
    let cannot = || format!("cannot read {name}");
    let kind = fs::metadata(path).with_context(cannot)?;
    if kind.is_dir() {
        bail!("{name} is a directory; a file is expected");
    }
    if !kind.is_file() {
        bail!("{name} is a device or a pipe; a regular file is expected");
    }
    let mut content = Vec::new();
    let file = File::open(path).with_context(cannot)?;
    file.take(most + 1).read_to_end(&mut content).with_context(cannot)?;
    if content.len() as u64 > most {
        bail!("{name} is too large: the limit is {} MB", most / 1_000_000);
    }
    Ok(content)
}

/// Reads a text file of at most `most` bytes.
pub fn read_text(path: &Path, most: u64) -> Result<String> {
    match String::from_utf8(read(path, most)?) {
        Ok(text) => Ok(text),
        Err(_) => bail!("{} is not a text file in UTF-8", shown(path)),
    }
}

/// Writes a file and creates its directories. After a failure the old file is unchanged.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
    Staged::new(path, content.as_ref())?.rename()
}

/// Writes files that belong together: all are on the disk before the first is renamed.
pub fn write_together(files: &Files) -> Result<()> {
    let staged = files.iter().map(|(path, content)| Staged::new(path, content));
    for (done, staged) in staged.collect::<Result<Vec<_>>>()?.into_iter().enumerate() {
        staged.rename().with_context(|| {
            format!(
                "{done} of {} files that belong together were replaced, the others were not",
                files.len()
            )
        })?;
    }
    Ok(())
}

/// Fails if a file cannot be written; called before long computations.
pub fn can_write(path: &Path) -> Result<()> {
    writable_path(path).map(drop)
}

/// The path to write to; for a link, its target. Creates the directories.
fn writable_path(path: &Path) -> Result<PathBuf> {
    let cannot = || format!("cannot write {}", shown(path));
    match fs::metadata(path) {
        Ok(old) if old.is_dir() => bail!("{}: it is a directory", cannot()),
        Ok(old) if !old.is_file() => bail!("{}: it is a device or a pipe", cannot()),
        Ok(old) if old.permissions().readonly() => bail!("{}: it is read-only", cannot()),
        Ok(_) => return path.canonicalize().with_context(cannot),
        Err(_) => {}
    }
    let path = std::path::absolute(path).with_context(cannot)?;
    let directory = path.parent().with_context(cannot)?;
    if let Some(file) = directory.ancestors().find(|above| above.is_file()) {
        bail!("{}: {} is a file, not a directory", cannot(), shown(file));
    }
    fs::create_dir_all(directory)
        .with_context(|| format!("cannot create the directory {}", shown(directory)))?;
    Ok(path)
}

/// A temporary file beside its destination, deleted when dropped.
struct Staged {
    file: NamedTempFile,
    path: PathBuf,
}

impl Staged {
    fn new(path: &Path, content: &[u8]) -> Result<Self> {
        let cannot = || format!("cannot write {}", shown(path));
        let old = fs::metadata(path).ok();
        let path = writable_path(path)?;
        let directory = path.parent().with_context(cannot)?;
        let mut file = beside(directory).with_context(cannot)?;
        file.write_all(content).with_context(cannot)?;
        if let Some(old) = old {
            file.as_file().set_permissions(old.permissions()).with_context(cannot)?;
        }
        // Some file systems report a full disk only here.
        file.as_file().sync_all().with_context(cannot)?;
        Ok(Self { file, path })
    }

    fn rename(self) -> Result<()> {
        let Self { file, path } = self;
        file.persist(&path).with_context(|| format!("cannot write {}", shown(&path)))?;
        Ok(())
    }
}

/// A temporary file with the default permissions of new files.
fn beside(directory: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".ahv-");
    #[cfg(unix)]
    let permissions: Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.tempfile_in(directory)
}
