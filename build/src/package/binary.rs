//! What a library needs from the machine that loads it, and what it offers: read from the file.

use super::platform::{LINUX, Platform, WINDOWS};
use ahv::fmi::sys::signatures;
use anyhow::{Context, Result, bail};
use object::elf::FileHeader64;
use object::read::elf::{FileHeader, SectionHeader};
use object::read::{File, NameOrOrdinal};
use object::{Endianness, Object};
use std::collections::BTreeSet;

/// Version of the GNU C library: major, minor.
pub type Glibc = (u32, u32);

/// The newest glibc that the library for Linux may ask for: that of the oldest distributions in
/// use, and of Rust's own standard library.
pub const GLIBC: Glibc = (2, 17);

/// Parts of glibc, which every Linux has.
const LINUX_LIBRARIES: [&str; 5] =
    ["libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2"];

/// Libraries that every Windows has, in lower case.
const WINDOWS_LIBRARIES: [&str; 9] = [
    "kernel32.dll",
    "kernelbase.dll",
    "ntdll.dll",
    "msvcrt.dll",
    "advapi32.dll",
    "bcryptprimitives.dll",
    "userenv.dll",
    "ws2_32.dll",
    "api-ms-win-core-synch-l1-2-0.dll",
];

/// A library as its file describes it.
#[derive(Debug)]
pub struct Binary {
    /// Newest version of glibc that a symbol asks for; none if there is no such symbol.
    pub glibc: Option<Glibc>,
    /// Names of the libraries that are loaded with it.
    pub needed: BTreeSet<String>,
    /// Names of exported functions.
    exports: BTreeSet<String>,
}

impl Binary {
    /// Reads an ELF or PE file.
    pub fn parse(bytes: &[u8]) -> Result<Self> {
        let file = File::parse(bytes).context("this is no shared library")?;
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let exports = file.exports()?.map(|export| {
            Ok(match export?.name() {
                NameOrOrdinal::Name(name) => text(name),
                NameOrOrdinal::Ordinal(number) => format!("number {number}"),
            })
        });
        let exports = exports.collect::<Result<_>>()?;
        if let File::Elf64(_) = file {
            let (needed, versions) = elf(bytes)?;
            let glibc = versions.iter().filter_map(|name| version(name)).max();
            return Ok(Self { glibc, needed, exports });
        }
        let imports = file.imports()?.map(|import| Ok(text(import?.library()).to_lowercase()));
        Ok(Self { glibc: None, needed: imports.collect::<Result<_>>()?, exports })
    }

    /// Refuses a library that a user's machine may not be able to load.
    pub fn check(&self, platform: Platform) -> Result<()> {
        let known: &[&str] = match platform {
            LINUX => &LINUX_LIBRARIES,
            WINDOWS => &WINDOWS_LIBRARIES,
            _ => bail!("{}: which libraries are the system's is not known", platform.name),
        };
        let foreign: Vec<_> =
            self.needed.iter().filter(|name| !known.contains(&name.as_str())).cloned().collect();
        if !foreign.is_empty() {
            bail!("{} needs {}: not part of the system", platform.name, foreign.join(", "));
        }
        if let Some((major, minor)) = self.glibc.filter(|version| *version > GLIBC) {
            let (most, least) = GLIBC;
            bail!("{} needs glibc {major}.{minor}, newer than {most}.{least}", platform.name);
        }
        let standard: BTreeSet<_> =
            signatures().into_iter().map(|(name, _)| name.to_string()).collect();
        let differ: Vec<_> = self.exports.symmetric_difference(&standard).cloned().collect();
        if !differ.is_empty() {
            bail!("{} exports too much or too little: {}", platform.name, differ.join(", "));
        }
        Ok(())
    }
}

/// Needed libraries and needed versions of an ELF file.
fn elf(bytes: &[u8]) -> Result<(BTreeSet<String>, BTreeSet<String>)> {
    let header = FileHeader64::<Endianness>::parse(bytes)?;
    let endian = header.endian()?;
    let sections = header.sections(endian, bytes)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let mut needed = BTreeSet::new();
    let mut versions = BTreeSet::new();
    if let Some((mut files, link)) = sections.gnu_verneed(endian, bytes)? {
        let strings = sections.strings(endian, bytes, link)?;
        while let Some((_, mut symbols)) = files.next()? {
            while let Some(symbol) = symbols.next()? {
                versions.insert(text(symbol.name(endian, strings)?));
            }
        }
    }
    for section in sections.iter() {
        let Some((entries, link)) = section.dynamic(endian, bytes)? else { continue };
        let strings = sections.strings(endian, bytes, link)?;
        for entry in entries {
            if entry.d_tag.get(endian) == object::elf::DT_NEEDED {
                let offset = u32::try_from(entry.d_val.get(endian))?;
                needed.insert(text(strings.get(offset).ok().context("a name is missing")?));
            }
        }
    }
    Ok((needed, versions))
}

/// `GLIBC_2.14` or `GLIBC_2.2.5`; nothing for the versions of other libraries.
fn version(name: &str) -> Option<Glibc> {
    let mut numbers = name.strip_prefix("GLIBC_")?.split('.').map(str::parse);
    // An unknown version is refused as the newest.
    let mut number = || numbers.next().and_then(Result::ok).unwrap_or(u32::MAX);
    Some((number(), number()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn binary(glibc: Glibc, needed: &str) -> Binary {
        let exports = signatures().into_iter().map(|(name, _)| name.to_string()).collect();
        Binary { glibc: Some(glibc), needed: [needed.to_string()].into(), exports }
    }

    #[test]
    fn versions_are_compared_by_number() {
        assert_eq!(version("GLIBC_2.2.5"), Some((2, 2)));
        assert_eq!(version("GLIBC_2.17"), Some((2, 17)));
        assert_eq!(version("GCC_3.0"), None);
        assert!(version("GLIBC_PRIVATE") > Some(GLIBC));
        assert!(version("GLIBC_2.4") < version("GLIBC_2.17"));
    }

    #[test]
    fn what_users_may_not_have_is_refused() {
        assert!(binary((2, 17), "libc.so.6").check(LINUX).is_ok());
        for (binary, platform, reason) in [
            (binary((2, 18), "libc.so.6"), LINUX, "needs glibc 2.18"),
            (binary((2, 17), "libgcc_s.so.1"), LINUX, "needs libgcc_s.so.1"),
            (binary((2, 17), "libwinpthread-1.dll"), WINDOWS, "needs libwinpthread-1.dll"),
        ] {
            let message = binary.check(platform).unwrap_err().to_string();
            assert!(message.contains(reason), "{message}");
        }
        let mut more = binary((2, 17), "libc.so.6");
        more.exports.insert("rust_eh_personality".into());
        assert!(more.check(LINUX).unwrap_err().to_string().contains("rust_eh_personality"));
        let mut less = binary((2, 17), "libc.so.6");
        less.exports.remove("fmi2DoStep");
        assert!(less.check(LINUX).unwrap_err().to_string().contains("fmi2DoStep"));
    }
}
