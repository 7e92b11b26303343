//! The identity of a model.

use crate::kinds::Kind;
use crate::model::{About, Model, Resources};
use crate::variable::{Role, Variable};

/// Of the 128-bit hash of Fowler, Noll and Vo.
const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;
const BASIS: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;

/// 128-bit FNV-1a (Fowler, Noll, Vo), continued from `hash`.
pub const fn fnv(mut hash: u128, bytes: &[u8]) -> u128 {
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
        Kind::Integer => fnv_text(hash, "Integer"),
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

/// Causality and variability as a number; a state, a derivative and an input also count their place.
const fn role<M: Model>(role: &Role<M>) -> u64 {
    match role {
        Role::Input(i) => *i as u64,
        Role::Output(_) => 100,
        Role::OutputState(i) => 200 + *i as u64,
        Role::LocalState(i) => 300 + *i as u64,
        Role::Derivative(i) => 400 + *i as u64,
        Role::Parameter { .. } => 500,
        Role::Calculated(_) => 600,
    }
}

/// Hash of identifier, version and table.
pub const fn hash_of_table<M: Model>(about: &About, table: &[Variable<M>]) -> u128 {
    let mut hash = fnv_text(fnv_text(BASIS, about.identifier), about.version);
    let mut row = 0;
    while row < table.len() {
        let variable = &table[row];
        hash = fnv_text(hash, variable.name);
        hash = fnv_text(hash, variable.description);
        hash = fnv_kind(hash, &variable.kind);
        hash = fnv_bits(hash, role(&variable.role));
        let claims = variable.dependencies;
        hash = fnv_bits(hash, claims.dependent);
        hash = fnv_bits(hash, claims.fixed);
        hash = fnv_bits(hash, claims.constant);
        if let Some([min, max]) = variable.range {
            hash = fnv_bits(fnv_bits(hash, min.to_bits()), max.to_bits());
        }
        if variable.accepts_non_finite {
            hash = fnv_text(hash, "also if not finite");
        }
        if let Some(nominal) = variable.nominal {
            hash = fnv_bits(hash, nominal.to_bits());
        }
        row += 1;
    }
    hash
}

/// GUID of the FMU with the built-in data.
pub fn guid<M: Model>() -> String {
    guid_of(M::IDENTITY)
}

/// GUID of the FMU of a model: its data count unless they can be replaced within the package.
pub fn guid_in_package<M: Model>(model: &M) -> String {
    guid_of(match M::RESOURCES {
        Resources::Replaceable(_) => M::IDENTITY,
        Resources::None | Resources::Identified(_) => model.identity(),
    })
}

/// A model's identity as GUID (FMI 2.0) and instantiation token (FMI 3.0): in braces, grouped as usual.
pub fn guid_of(identity: u128) -> String {
    let hex = format!("{identity:032x}");
    format!("{{{}-{}-{}-{}-{}}}", &hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..])
}
