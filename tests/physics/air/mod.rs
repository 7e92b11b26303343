//! Atmosphere, engine, and what the air answers to bending.

mod aeroelastic;
mod atmosphere;
mod choking;
mod made_up;
mod strip_theory;
