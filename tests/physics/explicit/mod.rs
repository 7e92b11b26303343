//! A second model, of its own equations, from the data files: a rigid body with two sloshing masses, and the
//! bending body by finite elements. No function of the library's physics is called.

pub mod air;
pub mod beam;
pub mod books;
pub mod elastic;
pub mod extrapolation;
pub mod flight;
