//! Watches calls: which floating-point exceptions they raise, and how deep they go into the stack.

use fmi_model::phase::Call;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::c_int;

// SAFETY: the C library has them, and they change nothing but the thread's floating-point environment.
unsafe extern "C" {
    safe fn feclearexcept(excepts: c_int) -> c_int;
    safe fn fetestexcept(excepts: c_int) -> c_int;
    safe fn feenableexcept(excepts: c_int) -> c_int;
}

/// `FE_INVALID`, `FE_DIVBYZERO` and `FE_OVERFLOW` of the C library's fenv.h.
#[cfg(target_arch = "x86_64")]
const EXCEPTIONS: [(c_int, &str); 3] = [(1, "invalid"), (4, "division by zero"), (8, "overflow")];
#[cfg(not(target_arch = "x86_64"))]
const EXCEPTIONS: [(c_int, &str); 3] = [(1, "invalid"), (2, "division by zero"), (4, "overflow")];
const ALL: c_int = EXCEPTIONS[0].0 | EXCEPTIONS[1].0 | EXCEPTIONS[2].0;

/// Makes every exception of this thread a signal.
pub fn trap() {
    assert_ne!(feenableexcept(ALL), -1);
}

/// Stack that is watched, bytes.
const SPAN: usize = 160 << 10;
/// Stack below a call's frame that painting and scanning use themselves, bytes.
const OWN: usize = 1 << 10;
const PAINT: u64 = 0xa5a5_5a5a_c3c3_3c3c;

fn watched(top: usize) -> impl Iterator<Item = *mut u64> {
    let top = (top - OWN) & !7;
    (top - SPAN..top).step_by(8).map(|address| address as *mut u64)
}

#[inline(never)]
fn paint(top: usize) {
    // SAFETY: free stack of this thread, which is larger.
    watched(top).for_each(|place| unsafe { place.write_volatile(PAINT) });
}

/// Bytes below `top` down to the last that lost its paint.
#[inline(never)]
fn depth(top: usize) -> usize {
    // SAFETY: as above.
    let used = watched(top).find(|place| unsafe { place.read_volatile() } != PAINT);
    used.map_or(0, |place| top - place as usize)
}

/// A frame of its own, below the painter's.
#[inline(never)]
fn apart<T>(call: impl FnOnce() -> T) -> T {
    call()
}

/// What was seen.
#[derive(Default)]
pub struct Watch {
    /// Whether calls are only made.
    idle: bool,
    pub calls: usize,
    /// Function, exceptions, and where.
    pub raised: BTreeSet<String>,
    /// Bytes of stack by function.
    pub deepest: BTreeMap<&'static str, usize>,
}

impl Watch {
    /// One that looks away.
    pub fn idle() -> Self {
        Self { idle: true, ..Self::default() }
    }

    #[inline(never)]
    pub fn call<T>(&mut self, name: &'static str, scene: &str, call: impl FnOnce() -> T) -> T {
        if self.idle {
            return call();
        }
        let local = 0_u8;
        let top = &raw const local as usize;
        paint(top);
        feclearexcept(ALL);
        let result = apart(call);
        let flags = fetestexcept(ALL);
        let depth = depth(top);
        let deepest = self.deepest.entry(name).or_default();
        *deepest = depth.max(*deepest);
        self.calls += 1;
        if flags != 0 {
            let raised = EXCEPTIONS.iter().filter(|(bit, _)| flags & bit != 0);
            let names: Vec<_> = raised.map(|(_, exception)| *exception).collect();
            self.raised.insert(format!("{name}: {}: {scene}", names.join(", ")));
        }
        result
    }

    /// Functions of the standard that were not called.
    pub fn not_called(&self, calls: &'static [Call]) -> Vec<&'static str> {
        let names = calls.iter().map(|call| call.name);
        names.filter(|name| !self.deepest.contains_key(name)).collect()
    }
}
