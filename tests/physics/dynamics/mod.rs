//! Equations of motion, sensors and limits.

mod airflow;
mod burning;
mod equations;
mod free_body;
mod limits;
mod one_body;
mod sensors;
mod stations;
