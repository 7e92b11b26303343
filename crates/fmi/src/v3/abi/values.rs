//! Values of variables (section 2.2.6.2): a pair of functions for each type, all of scalars.

use super::entry::{as_many, enter};
use crate::abi::{input, output};
use crate::instance::Instance as Of;
use crate::model::Model;
use crate::v3::sys::{self, Binary, Boolean, FmiString, Instance, Status, ValueReference};
use crate::v3::{calls, types};

/// Functions of a type: how a value is made of a number, and a number of a value.
macro_rules! values {
    ($($get:ident $set:ident $type:ident $get_call:ident $set_call:ident $kind:ident $write:expr, $read:expr;)*) => {
        $(
            pub unsafe fn $get<M: Model>(
                instance: Instance,
                valueReferences: *const ValueReference,
                nValueReferences: usize,
                values: *mut sys::$type,
                nValues: usize,
            ) -> Status {
                let body = |instance: &mut Of<M>| {
                    // SAFETY: the master passes arrays of the lengths it states.
                    let (references, values) = unsafe {
                        as_many("nValues", nValues, nValueReferences)?;
                        let references =
                            input("valueReferences", valueReferences, nValueReferences)?;
                        (references, output("values", values, nValues)?)
                    };
                    let write: fn(f64) -> sys::$type = $write;
                    instance.get(&types::$kind, references, |i, value| {
                        values[i].write(write(value));
                    })
                };
                // SAFETY: the master passes one of its instances.
                unsafe { enter(instance, &calls::$get_call, body) }
            }

            pub unsafe fn $set<M: Model>(
                instance: Instance,
                valueReferences: *const ValueReference,
                nValueReferences: usize,
                values: *const sys::$type,
                nValues: usize,
            ) -> Status {
                let body = |instance: &mut Of<M>| {
                    // SAFETY: the master passes arrays of the lengths it states.
                    let (references, values) = unsafe {
                        as_many("nValues", nValues, nValueReferences)?;
                        let references =
                            input("valueReferences", valueReferences, nValueReferences)?;
                        (references, input("values", values, nValues)?)
                    };
                    let read: fn(sys::$type) -> f64 = $read;
                    instance.set(&types::$kind, references, &|i| read(values[i]))
                };
                // SAFETY: the master passes one of its instances.
                unsafe { enter(instance, &calls::$set_call, body) }
            }
        )*
    };
}

values! {
    fmi3GetFloat64 fmi3SetFloat64 Float64 GET_FLOAT64 SET_FLOAT64 FLOAT64 |x| x, |x| x;
    fmi3GetInt32 fmi3SetInt32 Int32 GET_INT32 SET_INT32 INT32 |x| x as i32, f64::from;
    fmi3GetInt64 fmi3SetInt64 Int64 GET_INT64 SET_INT64 INT64 |x| x as i64, |x| x as f64;
    fmi3GetBoolean fmi3SetBoolean Boolean GET_BOOLEAN SET_BOOLEAN BOOLEAN
        |x| Boolean::from(x != 0.0), |x| f64::from(x.is_true());
}

/// Functions of a type that no variable has: they refuse every variable.
macro_rules! no_values {
    ($($function:ident $call:ident $kind:ident ($($argument:ident: $type:ty),*) $($count:ident)?;)*) => {
        $(
            pub unsafe fn $function<M: Model>(
                instance: Instance,
                valueReferences: *const ValueReference,
                nValueReferences: usize,
                $($argument: $type,)*
                $($count: usize,)?
            ) -> Status {
                $(let _ = $argument;)*
                let body = |_: &mut Of<M>| {
                    $(as_many("nValues", $count, nValueReferences)?;)?
                    // SAFETY: the master passes an array of the length it states.
                    let references =
                        unsafe { input("valueReferences", valueReferences, nValueReferences) }?;
                    Of::<M>::check_type(&types::$kind, references)
                };
                // SAFETY: the master passes one of its instances.
                unsafe { enter(instance, &calls::$call, body) }
            }
        )*
    };
}

no_values! {
    fmi3GetFloat32 GET_FLOAT32 FLOAT32 (values: *mut sys::Float32) nValues;
    fmi3GetInt8 GET_INT8 INT8 (values: *mut sys::Int8) nValues;
    fmi3GetUInt8 GET_UINT8 UINT8 (values: *mut sys::UInt8) nValues;
    fmi3GetInt16 GET_INT16 INT16 (values: *mut sys::Int16) nValues;
    fmi3GetUInt16 GET_UINT16 UINT16 (values: *mut sys::UInt16) nValues;
    fmi3GetUInt32 GET_UINT32 UINT32 (values: *mut sys::UInt32) nValues;
    fmi3GetUInt64 GET_UINT64 UINT64 (values: *mut sys::UInt64) nValues;
    fmi3GetString GET_STRING STRING (values: *mut FmiString) nValues;
    fmi3GetBinary GET_BINARY BINARY (valueSizes: *mut usize, values: *mut Binary) nValues;
    fmi3GetClock GET_CLOCK CLOCK (values: *mut Boolean);
    fmi3SetFloat32 SET_FLOAT32 FLOAT32 (values: *const sys::Float32) nValues;
    fmi3SetInt8 SET_INT8 INT8 (values: *const sys::Int8) nValues;
    fmi3SetUInt8 SET_UINT8 UINT8 (values: *const sys::UInt8) nValues;
    fmi3SetInt16 SET_INT16 INT16 (values: *const sys::Int16) nValues;
    fmi3SetUInt16 SET_UINT16 UINT16 (values: *const sys::UInt16) nValues;
    fmi3SetUInt32 SET_UINT32 UINT32 (values: *const sys::UInt32) nValues;
    fmi3SetUInt64 SET_UINT64 UINT64 (values: *const sys::UInt64) nValues;
    fmi3SetString SET_STRING STRING (values: *const FmiString) nValues;
    fmi3SetBinary SET_BINARY BINARY
        (valueSizes: *const usize, values: *const Binary) nValues;
    fmi3SetClock SET_CLOCK CLOCK (values: *const Boolean);
    fmi3GetIntervalDecimal GET_INTERVAL_DECIMAL CLOCK
        (intervals: *mut sys::Float64, qualifiers: *mut sys::Enumeration);
    fmi3GetIntervalFraction GET_INTERVAL_FRACTION CLOCK
        (counters: *mut sys::UInt64, resolutions: *mut sys::UInt64, qualifiers: *mut sys::Enumeration);
    fmi3GetShiftDecimal GET_SHIFT_DECIMAL CLOCK (shifts: *mut sys::Float64);
    fmi3GetShiftFraction GET_SHIFT_FRACTION CLOCK
        (counters: *mut sys::UInt64, resolutions: *mut sys::UInt64);
    fmi3SetIntervalDecimal SET_INTERVAL_DECIMAL CLOCK (intervals: *const sys::Float64);
    fmi3SetIntervalFraction SET_INTERVAL_FRACTION CLOCK
        (counters: *const sys::UInt64, resolutions: *const sys::UInt64);
    fmi3SetShiftDecimal SET_SHIFT_DECIMAL CLOCK (shifts: *const sys::Float64);
    fmi3SetShiftFraction SET_SHIFT_FRACTION CLOCK
        (counters: *const sys::UInt64, resolutions: *const sys::UInt64);
}
