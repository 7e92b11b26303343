//! Tests of the libraries for other platforms, in emulators.

use crate::cli::Test;
use crate::package::{self, LINUX_ARM, Platform, WINDOWS};
use crate::test::pytest;
use crate::workspace::{check, works};
use anyhow::{Result, bail};

/// An emulator.
pub struct Emulator {
    platform: Platform,
    program: &'static str,
    /// Arguments that succeed where it is installed with the platform's libraries.
    trial: &'static [&'static str],
    /// Its Debian packages.
    packages: &'static str,
    /// The tests.
    run: fn() -> Result<()>,
}

pub const WINE: Emulator = Emulator {
    platform: WINDOWS,
    program: "wine",
    trial: &["--version"],
    packages: "wine wine64",
    // All programs in wine share one server, so they run one after the other.
    run: || pytest(&["tests/platforms", "-k", "windows", "--numprocesses", "0"]),
};

pub const QEMU: Emulator = Emulator {
    platform: LINUX_ARM,
    program: "qemu-aarch64",
    trial: &["/usr/aarch64-linux-gnu/lib/ld-linux-aarch64.so.1", "--version"],
    packages: "qemu-user libc6-arm64-cross",
    run: || {
        pytest(&["tests/platforms", "-k", "arm"])?;
        check(&mut package::guard_on_arm("qemu-aarch64 -L /usr/aarch64-linux-gnu")?)
    },
};

/// Runs the tests; without the compiler or the emulator they are skipped or, with `--all-targets`, fail.
pub fn emulated(options: &Test, emulator: &Emulator) -> Result<()> {
    match missing(emulator) {
        Ok(()) => (emulator.run)(),
        Err(missing) if options.all_targets => Err(missing),
        Err(missing) => {
            errln!("skipped: {missing:#}");
            Ok(())
        }
    }
}

fn missing(emulator: &Emulator) -> Result<()> {
    package::can_build_for(emulator.platform)?;
    if !works(emulator.program, emulator.trial) {
        let Emulator { program, packages, .. } = emulator;
        bail!("{program} is missing or incomplete; on Debian: apt-get install {packages}");
    }
    Ok(())
}
