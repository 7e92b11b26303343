//! The identity of the model.

use super::{Kind, Role, TABLE};
use crate::data::{EARTH, OWN, PARKER2007, SHOCK_EXPANSION, VEHICLE, XU2015};

/// Of the 128-bit hash of Fowler, Noll and Vo.
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;

/// 128-bit FNV-1a (Fowler, Noll, Vo), continued from `hash`.
const fn fnv(mut hash: u128, bytes: &[u8]) -> u128 {
    let mut i = 0;
    while i < bytes.len() {
        hash = (hash ^ bytes[i] as u128).wrapping_mul(PRIME);
        i += 1;
    }
    hash
}

const fn fnv_text(hash: u128, text: &str) -> u128 {
    fnv(hash, text.as_bytes())
}

const fn fnv_bits(hash: u128, bits: u64) -> u128 {
    fnv(hash, &bits.to_le_bytes())
}

const fn fnv_kind(mut hash: u128, kind: &Kind) -> u128 {
    match kind {
        Kind::Real(unit) => fnv_text(hash, unit.name),
        Kind::Boolean => fnv_text(hash, "Boolean"),
        Kind::Enumeration(name, items) => {
            hash = fnv_text(hash, name);
            let mut i = 0;
            while i < items.len() {
                hash = fnv_text(fnv_bits(hash, items[i].1 as u64), items[i].0);
                i += 1;
            }
            hash
        }
    }
}

/// Causality and variability as a number; a state also counts its place.
const fn role(role: &Role) -> u64 {
    match role {
        Role::Input(i) => *i as u64,
        Role::Output => 100,
        Role::OutputState(i) => 200 + *i as u64,
        Role::LocalState(i) => 300 + *i as u64,
        Role::Derivative(i) => 400 + *i as u64,
        Role::Parameter => 500,
        Role::Calculated => 600,
    }
}

/// Hash of the table and of all numbers behind it: the same model, and only the same model, has it.
///
/// Start values need no place of their own: they come from the numbers.
pub const MODEL_HASH: u128 = {
    let mut hash = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    let mut row = 0;
    while row < TABLE.len() {
        let variable = &TABLE[row];
        hash = fnv_text(hash, variable.name);
        hash = fnv_text(hash, variable.description);
        hash = fnv_kind(hash, &variable.kind);
        hash = fnv_bits(hash, role(&variable.role));
        let claims = variable.dependencies;
        hash = fnv_bits(hash, claims.dependent as u64);
        hash = fnv_bits(hash, claims.fixed as u64);
        hash = fnv_bits(hash, claims.constant as u64);
        if let Some([min, max]) = variable.range {
            hash = fnv_bits(fnv_bits(hash, min.to_bits()), max.to_bits());
        }
        row += 1;
    }
    hash = fnv_text(hash, VEHICLE.text);
    hash = fnv_text(hash, EARTH.text);
    hash = fnv_text(hash, XU2015.text);
    hash = fnv_text(hash, PARKER2007.text);
    hash = fnv_text(hash, SHOCK_EXPANSION.text);
    if let Some(own) = OWN {
        hash = fnv_text(hash, own.text);
    }
    fnv_text(hash, env!("CARGO_PKG_VERSION"))
};

/// The FMU's GUID: [`MODEL_HASH`] in braces, grouped as usual.
pub fn guid() -> String {
    let hex = format!("{MODEL_HASH:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}
