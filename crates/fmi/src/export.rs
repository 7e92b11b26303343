//! What makes a model a library.

use crate::{v2, v3};

/// Names of the functions that a library exports.
pub fn exported() -> impl Iterator<Item = &'static str> {
    v2::sys::signatures().into_iter().chain(v3::sys::signatures()).map(|(name, _)| name)
}

/// Exports the functions of FMI 2.0 and FMI 3.0 for a [`Model`](crate::Model): all that a `cdylib` needs.
///
/// A table of variables that no master could use does not compile, see [`crate::table::check`].
///
/// A WebAssembly module exports none of them: its interface is that of a component.
#[macro_export]
macro_rules! export {
    ($model:ty) => {
        const _: () = $crate::table::check::<$model>();

        #[cfg(not(target_family = "wasm"))]
        #[allow(unsafe_code, non_snake_case, unused_imports)]
        const _: () = {
            use core::ffi::c_char;
            use $crate::v2::sys::*;
    $crate::__fmi2_functions!(__fmi2_export $model);
        };

        #[cfg(not(target_family = "wasm"))]
        #[allow(unsafe_code, non_snake_case, unused_imports)]
        const _: () = {
            use core::ffi::c_char;
            use $crate::v3::sys::*;
    $crate::__fmi3_functions!(__fmi3_export $model);
        };
    };
}
