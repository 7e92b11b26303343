//! An FMU whose steps do nothing: what the interface alone costs, and the least that a model needs.
//!
//! `cargo run --release --package idle` writes `idle.fmu` beside the program.

use fmi_model::{About, Dependencies, Model, Simulation, Unit, Variable};
use std::convert::Infallible;

/// It has no parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Idle;

/// Time and inputs.
#[derive(Debug)]
pub struct Idling {
    time_s: f64,
    inputs: [f64; 2],
}

const fn output(name: &'static str) -> Variable<Idle> {
    Variable::output(name, Unit::ONE, "Stays zero", Dependencies::NONE, |()| 0.0)
}

impl Model for Idle {
    type Simulation = Idling;
    type Error = Infallible;

    const ABOUT: About =
        About { description: "Does nothing", ..About::new("idle", env!("CARGO_PKG_VERSION")) };
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u1", Unit::ONE, "Ignored"),
        Variable::input(1, "u2", Unit::ONE, "Ignored"),
        output("y1"),
        output("y2"),
        output("y3"),
        output("y4"),
        output("y5"),
    ];

    fn new() -> Result<Self, Infallible> {
        Ok(Self)
    }

    fn start(&self, time_s: f64, _tolerance: f64) -> Result<Idling, Infallible> {
        Ok(Idling { time_s, inputs: [0.0; 2] })
    }
}

impl Simulation for Idling {
    type Sample = ();
    type Error = Infallible;

    fn time(&self) -> f64 {
        self.time_s
    }
    fn inputs(&self) -> &[f64] {
        &self.inputs
    }
    fn set_input(&mut self, number: usize, value: f64) {
        self.inputs[number] = value;
    }
    fn evaluate(&mut self) -> Result<&(), Infallible> {
        Ok(&())
    }
    fn advance(&mut self, end_s: f64) -> Result<(), Infallible> {
        self.time_s = end_s;
        Ok(())
    }
}

fmi_model::export!(Idle);
