//! The identity of the model.

use super::TABLE;
use crate::params::{EARTH_TOML, PARKER2007_TOML, VEHICLE_TOML};

/// 128-bit FNV-1a (Fowler, Noll, Vo), continued from `hash`.
const fn fnv(mut hash: u128, text: &str) -> u128 {
    let bytes = text.as_bytes();
    let mut i = 0;
    while i < bytes.len() {
        hash = (hash ^ bytes[i] as u128).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013B);
        i += 1;
    }
    hash
}

/// Hash of the table and of all numbers behind it: the same model, and only the same model, has it.
pub const MODEL_HASH: u128 = {
    let mut hash = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    let mut row = 0;
    while row < TABLE.len() {
        hash = fnv(hash, TABLE[row].name);
        hash = fnv(hash, "\n");
        hash = fnv(hash, TABLE[row].description);
        hash = fnv(hash, "\n");
        row += 1;
    }
    hash = fnv(hash, VEHICLE_TOML);
    hash = fnv(hash, EARTH_TOML);
    hash = fnv(hash, PARKER2007_TOML);
    fnv(hash, env!("CARGO_PKG_VERSION"))
};

/// The FMU's GUID: [`MODEL_HASH`] in braces, grouped as usual.
pub fn guid() -> String {
    let hex = format!("{MODEL_HASH:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}
