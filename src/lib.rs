//! Longitudinal flight of an air-breathing hypersonic vehicle with a flexible fuselage and
//! sloshing propellant, as a Rust library and as an FMI 2.0 FMU for co-simulation and model exchange.
//!
//! | module | what it holds | where it comes from |
//! |---|---|---|
//! | [`params`] | the numbers, with unit, source and status | Tables 1-3 and the literature |
//! | [`atmosphere`] | air and gravity | US Standard Atmosphere 1976 |
//! | [`slosh`] | liquid in the tanks | Fig. 4 |
//! | [`beam`], [`hermite`] | elements, mass, statics; shapes between the nodes | eqs (1)-(2) |
//! | [`rigid_body`] | the one inertia of pitch, bending and slosh | |
//! | [`modes`] | K phi = omega^2 M phi | Table 1, Fig. 5 |
//! | [`aero`], [`envelope`] | curve fits at run time, and where they hold | eq. (4) |
//! | [`aeroelastic`] | where the elastic terms come from | eq. (4) |
//! | [`dynamics`] | x' = f(x, u), y = g(x, u) | eq. (3) |
//! | [`burn`], [`intake`] | the vehicle while fuel burns, and how fast it does | |
//! | [`choking`] | how much fuel the burner can still take | NACA Report 1135 |
//! | [`factors`] | what may be uncertain | |
//! | [`trim`], [`linear`] | trim; A, B, C, poles, zeros | Tables 2-3 |
//! | [`integrate`], [`dop853`] | one interval, landing exactly | knows no aircraft |
//! | [`exponential`], [`decoupling`], [`blocks`] | the oscillators exactly, the rest as a polynomial | knows no aircraft |
//! | [`assembly`], [`vehicle`], [`parameters`], [`flight`] | data to vehicle; parameters and inputs to outputs | |
//! | [`variables`] | the one table of what a master sees | |
//! | [`errata`] | where the paper is wrong or silent, with derivations | |
//! | [`fmi`] | the FMU's C interface | FMI 2.0.5 |
//!
//! The paper: Xu, Huang, Cai, "Flight dynamic analysis of hypersonic vehicle considering
//! liquid-solid coupling", Trans. Nanjing Univ. Aero. Astro. 32(1), 2015, 81-88.

#![deny(unsafe_code)]

pub mod aero;
pub mod aeroelastic;
pub mod assembly;
pub mod atmosphere;
pub mod beam;
pub mod blocks;
pub mod burn;
pub mod choking;
pub mod decoupling;
pub mod dop853;
pub mod dynamics;
pub mod envelope;
#[doc = include_str!("data/errata.md")]
pub mod errata {}
pub mod error;
pub mod exponential;
pub mod factors;
pub mod flight;
mod fmu;
pub mod hermite;
pub mod intake;
pub mod integrate;
pub mod linear;
pub mod modes;
pub mod params;
pub mod rigid_body;
pub mod scalar;
pub mod short;
pub mod slosh;
pub mod trim;
pub mod variables;
pub mod vehicle;
