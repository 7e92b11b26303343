//! What a Mach-O file says of itself.

use crate::package::macos::{OLDEST, install_name};
use crate::package::platform::Platform;
use anyhow::{Result, bail};
use object::Endianness;
use object::macho::{LC_CODE_SIGNATURE, MachHeader64};
use object::read::macho::{LoadCommandVariant, MachOFile};
use std::collections::BTreeSet;

/// Properties that only libraries for macOS have.
#[derive(Debug, Default)]
pub struct MachO {
    /// The name by which others load it.
    name: String,
    /// The oldest macOS that it says it runs on: major, minor.
    oldest: (u16, u8),
    signed: bool,
}

/// Properties and needed libraries.
pub fn properties(
    file: &MachOFile<'_, MachHeader64<Endianness>>,
) -> Result<(MachO, BTreeSet<String>)> {
    let endian = file.endian();
    let mut found = MachO::default();
    let mut needed = BTreeSet::new();
    let mut commands = file.macho_load_commands()?;
    while let Some(command) = commands.next()? {
        let text = |name| Ok::<_, object::Error>(command.string(endian, name)?.to_vec());
        let utf8 = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        let version = |packed: u32| ((packed >> 16) as u16, (packed >> 8) as u8);
        match command.variant()? {
            LoadCommandVariant::IdDylib(library) => found.name = utf8(text(library.dylib.name)?),
            LoadCommandVariant::Dylib(library) => {
                needed.insert(utf8(text(library.dylib.name)?));
            }
            LoadCommandVariant::BuildVersion(build, _) => {
                found.oldest = version(build.minos.get(endian).0);
            }
            LoadCommandVariant::VersionMin(least) => {
                found.oldest = version(least.version.get(endian).0);
            }
            _ => found.signed |= command.cmd() == LC_CODE_SIGNATURE,
        }
    }
    Ok((found, needed))
}

impl MachO {
    /// Checks that a process may load it.
    pub fn check(&self, platform: Platform) -> Result<()> {
        if platform.arch == "aarch64" && !self.signed {
            bail!("{} needs a signature: macOS on ARM ends a process without", platform.fmi2);
        }
        Ok(())
    }

    /// Also checks that it may lie anywhere and runs on an old system.
    pub fn check_everywhere(&self, platform: Platform, identifier: &str) -> Result<()> {
        if self.name != install_name(identifier) {
            bail!("{} has the install name {:?}", platform.fmi2, self.name);
        }
        let ((major, minor), least) = (self.oldest, OLDEST);
        if self.oldest > least {
            bail!(
                "{} needs macOS {major}.{minor}, newer than {}.{}",
                platform.fmi2,
                least.0,
                least.1
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::package::platform::{MACOS, MACOS_ARM};

    #[test]
    fn what_macos_would_not_load_everywhere_is_refused() {
        let good = || MachO { name: install_name("ahv"), oldest: OLDEST, signed: true };
        let everywhere = |library: MachO, platform| {
            library.check(platform)?;
            library.check_everywhere(platform, "ahv")
        };
        for platform in [MACOS, MACOS_ARM] {
            everywhere(good(), platform).unwrap();
        }
        everywhere(MachO { signed: false, ..good() }, MACOS).unwrap();
        for (library, reason) in [
            (MachO { signed: false, ..good() }, "needs a signature"),
            (MachO { name: "/tmp/ahv.dylib".into(), ..good() }, "install name \"/tmp/ahv.dylib\""),
            (MachO { oldest: (12, 3), ..good() }, "needs macOS 12.3, newer than 11.0"),
        ] {
            let message = everywhere(library, MACOS_ARM).unwrap_err().to_string();
            assert!(message.contains(reason), "{message}");
        }
    }
}
