//! Values of every type, most of which no variable has.

use super::super::Play;
use super::super::player::{Array, BLANK, Player, RARELY, boolean, integer, real};
use super::super::shared::{NUMBERS, call};
use crate::master::Random;
use crate::master::v3::{Api, UNKNOWN};
use fmi_model::Model;
use fmi_model::v3::sys::{Boolean, Status};
use std::ptr::{null, null_mut};

/// The number of values that the master states: now and then another than that of the variables.
pub fn miscount(r: &mut Random) -> usize {
    if r.below(RARELY) == 0 { 1 + r.below(2) as usize } else { 0 }
}

/// A getter and a setter of a type.
macro_rules! typed {
    ($get_name:literal $set_name:literal $get:ident $set:ident
        $kind:ident $blank:expr, $element:expr, $as_read:expr) => {
        {
        let rows: [(&'static str, Play<Api<M>>); 2] = [
            ($get_name, |p, r| {
                let (get, off) = (p.slave.api.$get, miscount(r));
                // SAFETY: see `call!`; no more values are stated than there are places, or none is written.
                let (status, _) =
                    p.read(r, $kind, $blank, |c, v, n, x| unsafe { get(c, v, n, x, n.wrapping_add(off)) });
                p.unsound |= off > 0;
                status
            }),
            ($set_name, |p, r| {
                let (get, set, off) = (p.slave.api.$get, p.slave.api.$set, miscount(r));
                // SAFETY: likewise.
                let status = unsafe {
                    p.write(
                        r,
                        $kind,
                        $element,
                        $as_read,
                        |c, v, n, x| set(c, v, n, x, n.wrapping_add(off)),
                        |c, v, n, x| get(c, v, n, x, n),
                    )
                };
                p.unsound |= off > 0;
                status
            }),
        ];
        rows
        }
    };
}

pub fn values<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    let mut plays = [
        typed!("fmi3GetFloat64" "fmi3SetFloat64" get_float64 set_float64
            real BLANK, |r| r.pick(&NUMBERS), |x| x),
        typed!("fmi3GetInt64" "fmi3SetInt64" get_int64 set_int64
            integer -77_777, |r| r.pick(&[-1, 0, 1, 2, 3, 4, i64::MAX, i64::MIN]), |x| x),
        // Any byte but zero is true.
        typed!("fmi3GetBoolean" "fmi3SetBoolean" get_boolean set_boolean
            boolean UNKNOWN, |r| Boolean(r.below(256) as u8), |x| x.is_true().into()),
        typed!("fmi3GetFloat32" "fmi3SetFloat32" get_float32 set_float32 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetInt8" "fmi3SetInt8" get_int8 set_int8 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetUInt8" "fmi3SetUInt8" get_uint8 set_uint8 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetInt16" "fmi3SetInt16" get_int16 set_int16 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetUInt16" "fmi3SetUInt16" get_uint16 set_uint16 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetInt32" "fmi3SetInt32" get_int32 set_int32 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetUInt32" "fmi3SetUInt32" get_uint32 set_uint32 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetUInt64" "fmi3SetUInt64" get_uint64 set_uint64 integer 77 as _, |r| r.below(3) as _, |x| x),
        typed!("fmi3GetString" "fmi3SetString" get_string set_string
            boolean c"x".as_ptr(), |_| c"".as_ptr(), |x| x),
    ]
    .concat();
    plays.extend::<[(&'static str, Play<Api<M>>); 2]>([
        ("fmi3GetBinary", |p, r| {
            none(p, r, |p, v, n| call!(p.get_binary(v, n, null_mut(), null_mut(), n)))
        }),
        ("fmi3SetBinary", |p, r| {
            none(p, r, |p, v, n| call!(p.set_binary(v, n, null(), null(), n)))
        }),
    ]);
    plays
}

/// A function of a type that no variable has: refused if any is named.
fn none<M: Model>(
    p: &mut Player<Api<M>>,
    r: &mut Random,
    call: impl FnOnce(&Player<Api<M>>, *const u32, usize) -> Status,
) -> Status {
    let references = Player::<Api<M>>::references(r, boolean, false);
    let count = references.len();
    let references = Array::new(r, references, 0);
    p.unsound = count > 0;
    let claim = p.claim(r, count);
    call(p, references.pointer, claim)
}

pub fn clocks<M: Model>() -> Vec<(&'static str, Play<Api<M>>)> {
    vec![
        ("fmi3GetClock", |p, r| none(p, r, |p, v, n| call!(p.get_clock(v, n, null_mut())))),
        ("fmi3SetClock", |p, r| none(p, r, |p, v, n| call!(p.set_clock(v, n, null())))),
        ("fmi3GetIntervalDecimal", |p, r| {
            none(p, r, |p, v, n| call!(p.get_interval_decimal(v, n, null_mut(), null_mut())))
        }),
        ("fmi3GetIntervalFraction", |p, r| {
            none(p, r, |p, v, n| {
                call!(p.get_interval_fraction(v, n, null_mut(), null_mut(), null_mut()))
            })
        }),
        ("fmi3GetShiftDecimal", |p, r| {
            none(p, r, |p, v, n| call!(p.get_shift_decimal(v, n, null_mut())))
        }),
        ("fmi3GetShiftFraction", |p, r| {
            none(p, r, |p, v, n| call!(p.get_shift_fraction(v, n, null_mut(), null_mut())))
        }),
        ("fmi3SetIntervalDecimal", |p, r| {
            none(p, r, |p, v, n| call!(p.set_interval_decimal(v, n, null())))
        }),
        ("fmi3SetIntervalFraction", |p, r| {
            none(p, r, |p, v, n| call!(p.set_interval_fraction(v, n, null(), null())))
        }),
        ("fmi3SetShiftDecimal", |p, r| {
            none(p, r, |p, v, n| call!(p.set_shift_decimal(v, n, null())))
        }),
        ("fmi3SetShiftFraction", |p, r| {
            none(p, r, |p, v, n| call!(p.set_shift_fraction(v, n, null(), null())))
        }),
    ]
}
