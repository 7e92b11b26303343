//! What FMI 2.0 alone has.

mod derivatives;
mod logging;
mod refusals;
mod state;
mod values;
