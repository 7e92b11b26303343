//! What a call returns.

/// `fmi2Status` and `fmi3Status`, which have the same numbers; `fmi2Pending` does not occur. Only ever produced
/// here, so a Rust enumeration is safe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(C)]
pub enum Status {
    /// Done.
    Ok,
    /// Done, but something is odd: never returned.
    Warning,
    /// Not done; the master may try something else.
    Discard,
    /// Not done; the run cannot go on.
    Error,
    /// No instance can be trusted any more.
    Fatal,
}
