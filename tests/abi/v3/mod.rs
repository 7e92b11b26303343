//! What FMI 3.0 alone has.

mod arguments;
mod derivatives;
mod instantiation;
mod look;
