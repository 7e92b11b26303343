//! stub
/// Flexible modes kept.
pub const FLEXIBLE: usize = 3;
/// Slosh modes kept.
pub const SLOSH: usize = 2;
/// All modes kept.
pub const MODES: usize = 5;
