//! What an ELF file says of its dependencies.

use super::Glibc;
use anyhow::{Context, Result};
use object::Endianness;
use object::elf::FileHeader64;
use object::read::elf::{FileHeader, SectionHeader};
use std::collections::BTreeSet;

/// Needed libraries and needed versions of an ELF file.
pub fn dependencies(bytes: &[u8]) -> Result<(BTreeSet<String>, BTreeSet<String>)> {
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

/// Parses `GLIBC_2.14` or `GLIBC_2.2.5`; `None` for versions of other libraries.
pub fn version(name: &str) -> Option<Glibc> {
    let mut numbers = name.strip_prefix("GLIBC_")?.split('.').map(str::parse);
    // An unreadable version counts as the newest, and is refused.
    let mut number = || numbers.next().and_then(Result::ok).unwrap_or(u32::MAX);
    Some((number(), number()))
}
