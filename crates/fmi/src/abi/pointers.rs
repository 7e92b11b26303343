//! What a master's pointers lead to: NULL, misalignment and absurd lengths are refused, not trusted.

use crate::failure::{Failure, Outcome};
use core::ffi::{CStr, c_char};
use core::mem::MaybeUninit;
use core::slice;

/// Whether `count` elements can lie at `pointer`: alignment, and a length that a negative number
/// cast to `size_t` does not have.
fn plausible<T>(pointer: *const T, count: usize) -> bool {
    !pointer.is_null() && pointer.is_aligned() && count <= isize::MAX as usize / size_of::<T>()
}

/// What arguments point to.
const ARRAY: &str = "an array of the length given";
const PLACE: &str = "a place for the result";
const TEXT: &str = "a C string";

/// An array to read; no element needs no array.
///
/// # Safety
/// `pointer` is NULL or leads to `count` elements that nobody changes meanwhile.
pub(crate) unsafe fn input<'a, T>(
    argument: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if !plausible(pointer, count) {
        return Err(Failure::BadPointer { argument, place: ARRAY });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// An array to write, which a master need not have initialised; no element needs no array.
///
/// # Safety
/// `pointer` is NULL or leads to room for `count` elements that nobody else uses meanwhile.
pub(crate) unsafe fn output<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    if !plausible(pointer, count) {
        return Err(Failure::BadPointer { argument, place: ARRAY });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// Room for a single result, which a master need not have initialised.
///
/// # Safety
/// `pointer` is NULL or leads to room for one value that nobody else uses meanwhile.
pub(crate) unsafe fn room<'a, T>(
    argument: &'static str,
    pointer: *mut T,
) -> Result<&'a mut MaybeUninit<T>, Failure> {
    // SAFETY: by this function's contract.
    unsafe { place(argument, pointer.cast(), PLACE) }
}

/// A single result.
///
/// # Safety
/// `pointer` is NULL or leads to room for one value.
pub(crate) unsafe fn store<T>(argument: &'static str, pointer: *mut T, value: T) -> Outcome {
    // SAFETY: by this function's contract.
    unsafe { room(argument, pointer) }?.write(value);
    Ok(())
}

/// What a pointer leads to, to read it and to write it.
///
/// # Safety
/// `pointer` is NULL or leads to a value that nobody else uses meanwhile.
pub(crate) unsafe fn place<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    place: &'static str,
) -> Result<&'a mut T, Failure> {
    if !plausible(pointer, 1) {
        return Err(Failure::BadPointer { argument, place });
    }
    // SAFETY: plausible, and valid by this function's contract.
    Ok(unsafe { &mut *pointer })
}

/// A string; what is not UTF-8 is replaced, as it only goes into messages and comparisons.
///
/// # Safety
/// `pointer` is NULL or a C string.
pub(crate) unsafe fn string(
    argument: &'static str,
    pointer: *const c_char,
) -> Result<String, Failure> {
    if pointer.is_null() {
        return Err(Failure::BadPointer { argument, place: TEXT });
    }
    // SAFETY: not NULL, and a C string by this function's contract.
    Ok(unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned())
}
