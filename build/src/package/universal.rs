//! Universal binaries of macOS: libraries for several processors in one file.

use super::platform::Platform;
use anyhow::{Context, Result};
use object::macho::{CPU_TYPE_ARM64, CPU_TYPE_X86_64, FAT_MAGIC};
use object::read::macho::{FatArch, MachOFatFile32};

/// Parts begin at multiples of two to this power: the page size of macOS on ARM.
const ALIGNMENT: u32 = 14;

/// Puts libraries for macOS into one file.
pub fn join(parts: &[&[u8]]) -> Vec<u8> {
    let page = 1_usize << ALIGNMENT;
    let mut header = Vec::new();
    let mut add = |number: u32| header.extend(number.to_be_bytes());
    add(FAT_MAGIC);
    add(parts.len() as u32);
    let mut start = page;
    for part in parts {
        // Type and subtype of the processor follow the magic number of each part.
        for bytes in [&part[4..8], &part[8..12]] {
            add(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
        }
        add(start as u32);
        add(part.len() as u32);
        add(ALIGNMENT);
        start = (start + part.len()).next_multiple_of(page);
    }
    let mut file = header;
    for part in parts {
        file.resize(file.len().next_multiple_of(page), 0);
        file.extend_from_slice(part);
    }
    file
}

/// The library for a platform; the whole file if it is not universal.
pub fn part(file: &[u8], platform: Platform) -> Result<&[u8]> {
    let Ok(universal) = MachOFatFile32::parse(file) else { return Ok(file) };
    let processor = if platform.arch == "x86_64" { CPU_TYPE_X86_64 } else { CPU_TYPE_ARM64 };
    let part = universal.arches().iter().find(|part| part.cputype() == processor);
    let part = part.with_context(|| format!("it has no library for {}", platform.arch))?;
    part.data(file).ok().context("the end of this library is missing")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::package::platform::{LINUX, MACOS, MACOS_ARM};

    /// The first bytes of a library.
    fn library(processor: u32, length: usize) -> Vec<u8> {
        let mut bytes: Vec<u8> =
            [0xfeed_facf, processor, 3].iter().flat_map(|word: &u32| word.to_le_bytes()).collect();
        bytes.resize(length, processor as u8);
        bytes
    }

    #[test]
    fn each_processor_finds_its_part_on_a_page_of_its_own() {
        let [intel, arm] = [(CPU_TYPE_X86_64, 20_000), (CPU_TYPE_ARM64, 30)]
            .map(|(processor, length)| library(processor.0, length));
        let file = join(&[&intel, &arm]);
        assert_eq!(part(&file, MACOS).unwrap(), intel);
        assert_eq!(part(&file, MACOS_ARM).unwrap(), arm);
        let universal = MachOFatFile32::parse(&*file).unwrap();
        for found in universal.arches() {
            assert_eq!(found.offset.get(object::BigEndian) % (1 << ALIGNMENT), 0);
            assert_eq!(found.cpusubtype().0, 3);
        }
    }

    #[test]
    fn another_file_is_its_own_part_and_a_missing_part_is_told() {
        assert_eq!(part(b"ELF", LINUX).unwrap(), b"ELF");
        let intel = join(&[&library(CPU_TYPE_X86_64.0, 100)]);
        let message = part(&intel, MACOS_ARM).unwrap_err().to_string();
        assert_eq!(message, "it has no library for aarch64");
        assert!(part(&intel[..20_000.min(intel.len() - 1)], MACOS).is_err());
    }
}
