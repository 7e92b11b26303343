//! Longitudinal flight of an air-breathing hypersonic vehicle with a flexible fuselage and
//! sloshing propellant, as a Rust library and as FMUs of FMI 2.0 and 3.0 for co-simulation and model exchange.
//!
//! The rooms, lowest first: each imports only from those before it in this table, and within a room
//! no files import each other in a circle:
//!
//! | room | what it holds | where it comes from |
//! |---|---|---|
//! | [`solve`] | dual numbers, integration | knows no aircraft |
//! | [`data`] | the numbers, with unit, source and status | Tables 1-3 and the literature |
//! | [`structure`] | beam, liquid, modes | eqs (1)-(2), Table 1, Figs. 4-5 |
//! | [`air`] | atmosphere, curve fits and where they hold, strip theory, engine | eq. (4), US Standard Atmosphere 1976, NACA Report 1135 |
//! | [`vehicle`] | data and options to a vehicle | |
//! | [`dynamics`] | x' = f(x, u), y = g(x, u); trim, poles, zeros | eq. (3), Tables 2-3 |
//! | [`flight`] | parameters and inputs to outputs | |
//! | [`variables`] | the one table of what a master sees | |
//! | [`fmu`] | the flight as a model of [`fmi_model`] | FMI 2.0.5, 3.0.2 |
//!
//! Beside them stand [`error`], [`short`] and [`errata`]: where the paper is wrong or silent, with
//! derivations.
//!
//! The paper: Xu, Huang, Cai, "Flight dynamic analysis of hypersonic vehicle considering
//! liquid-solid coupling", Trans. Nanjing Univ. Aero. Astro. 32(1), 2015, 81-88.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

pub mod air;
pub mod data;
pub mod dynamics;
#[doc = include_str!("data/errata.md")]
pub mod errata {}
pub mod error;
pub mod flight;
pub mod fmu;
pub mod short;
pub mod solve;
pub mod structure;
pub mod variables;
pub mod vehicle;
