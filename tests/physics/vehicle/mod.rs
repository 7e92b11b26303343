//! From data and options to a vehicle.

mod body;
mod edited;
mod factors;
mod fuel_levels;
mod fuel_table;
