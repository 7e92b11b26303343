//! The types of values: each has its own functions, and variables have four of them.

use crate::kinds::Kind;
use crate::standard::Standard;
use crate::values::Type;

macro_rules! types {
    ($($constant:ident $name:literal $fits:expr;)*) => {
        $(
            #[doc = concat!("`fmi3", $name, "`.")]
            pub const $constant: Type =
                Type { name: $name, standard: Standard::Fmi3, fits: $fits };
        )*
    };
}

types! {
    FLOAT32 "Float32" |_| false;
    FLOAT64 "Float64" |kind| matches!(kind, Kind::Real(_));
    INT8 "Int8" |_| false;
    UINT8 "UInt8" |_| false;
    INT16 "Int16" |_| false;
    UINT16 "UInt16" |_| false;
    INT32 "Int32" |kind| matches!(kind, Kind::Integer);
    UINT32 "UInt32" |_| false;
    INT64 "Int64" |kind| matches!(kind, Kind::Enumeration(..));
    UINT64 "UInt64" |_| false;
    BOOLEAN "Boolean" |kind| matches!(kind, Kind::Boolean);
    STRING "String" |_| false;
    BINARY "Binary" |_| false;
    CLOCK "Clock" |_| false;
}
