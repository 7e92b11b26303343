//! C types of FMI 3.0 (`fmi3PlatformTypes.h`, `fmi3FunctionTypes.h`), written by hand and proved
//! against the official headers by `tests/headers.rs`.

pub use crate::status::Status;
use core::ffi::{c_char, c_uint, c_void};

/// `fmi3Instance`.
pub type Instance = *mut c_void;
/// `fmi3InstanceEnvironment`.
pub type InstanceEnvironment = *mut c_void;
/// `fmi3FMUState`.
pub type FmuState = *mut c_void;
/// `fmi3ValueReference`.
pub type ValueReference = u32;
/// `fmi3Float32`.
pub type Float32 = f32;
/// `fmi3Float64`.
pub type Float64 = f64;
/// `fmi3Int8`.
pub type Int8 = i8;
/// `fmi3UInt8`.
pub type UInt8 = u8;
/// `fmi3Int16`.
pub type Int16 = i16;
/// `fmi3UInt16`.
pub type UInt16 = u16;
/// `fmi3Int32`.
pub type Int32 = i32;
/// `fmi3UInt32`.
pub type UInt32 = u32;
/// `fmi3Int64`.
pub type Int64 = i64;
/// `fmi3UInt64`.
pub type UInt64 = u64;
/// `fmi3String`.
pub type FmiString = *const c_char;
/// `fmi3Byte`.
pub type Byte = u8;
/// `fmi3Binary`.
pub type Binary = *const Byte;

/// `fmi3Boolean` and `fmi3Clock`: C's `bool`. A master may pass a byte of any value, so this is no Rust
/// `bool`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(transparent)]
pub struct Boolean(pub u8);

impl Boolean {
    /// `fmi3False`.
    pub const FALSE: Self = Self(0);
    /// `fmi3True`.
    pub const TRUE: Self = Self(1);

    /// Whether it is true.
    pub const fn is_true(self) -> bool {
        self.0 != 0
    }
}

impl From<bool> for Boolean {
    fn from(value: bool) -> Self {
        Self(value.into())
    }
}

/// `fmi3IntervalQualifier`, `fmi3DependencyKind`: never written here.
pub type Enumeration = c_uint;

/// `fmi3LogMessageCallback`.
pub type LogMessageCallback = unsafe extern "C" fn(
    environment: InstanceEnvironment,
    status: Status,
    category: FmiString,
    message: FmiString,
);
/// `fmi3IntermediateUpdateCallback`.
pub type IntermediateUpdateCallback = unsafe extern "C" fn(
    environment: InstanceEnvironment,
    time: Float64,
    set_requested: Boolean,
    get_allowed: Boolean,
    step_finished: Boolean,
    can_return_early: Boolean,
    early_return_requested: *mut Boolean,
    early_return_time: *mut Float64,
);
/// `fmi3ClockUpdateCallback`.
pub type ClockUpdateCallback = unsafe extern "C" fn(environment: InstanceEnvironment);
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`.
pub type PreemptionCallback = unsafe extern "C" fn();

/// Types of the exported functions: `fmi3GetVersionTYPE` is `GetVersion` here.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_types {
    ([] $($function:ident $c:ident ($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        $(
            #[doc = concat!("`", stringify!($c), "TYPE`.")]
            pub type $function = unsafe extern "C" fn($($type),*) $(-> $result)?;
        )*
        /// The standard's name of each function and the Rust type that stands for it.
        pub fn signatures() -> Vec<(&'static str, &'static str)> {
            vec![$((stringify!($c), core::any::type_name::<$function>())),*]
        }
    };
}

crate::__fmi3_functions!(__fmi3_types);
