//! An actuator: second-order or first-order dynamics with rate limit, position stops and delay.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

use fmi_model::{About, Dependencies, Kind, Model, Simulation, Unit, Variable};
use std::convert::Infallible;

/// The parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Actuator {
    bandwidth: f64,
}

/// A running simulation.
#[derive(Debug)]
pub struct Running {
    time: f64,
    u: [f64; 1],
    y: f64,
    bandwidth: f64,
}

impl Model for Actuator {
    type Simulation = Running;
    type Error = Infallible;

    const ABOUT: About = About {
        description: "Actuator with limits and delay",
        author: "ahv",
        license: env!("CARGO_PKG_LICENSE"),
        ..About::new("ahv_actuator", env!("CARGO_PKG_VERSION"))
    };
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::NONE, "Command"),
        Variable::output("y", Unit::NONE, "Position", Dependencies::NONE, |y: &f64| *y),
        Variable::parameter(
            "bandwidth",
            Kind::Real(Unit::NONE),
            "Bandwidth",
            |m: &Self| m.bandwidth,
            |m, v| m.bandwidth = v,
        ),
    ];

    fn new() -> Result<Self, Infallible> {
        Ok(Self { bandwidth: 50.0 })
    }
    fn start(&self, time: f64, _tolerance: f64) -> Result<Running, Infallible> {
        Ok(Running { time, u: [0.0], y: 0.0, bandwidth: self.bandwidth })
    }
}

impl Simulation for Running {
    type Sample = f64;
    type Error = Infallible;

    fn time(&self) -> f64 {
        self.time
    }
    fn inputs(&self) -> &[f64] {
        &self.u
    }
    fn set_input(&mut self, number: usize, value: f64) {
        self.u[number] = value;
    }
    fn evaluate(&mut self) -> Result<&f64, Infallible> {
        Ok(&self.y)
    }
    fn advance(&mut self, end: f64) -> Result<(), Infallible> {
        self.y -= libm::expm1(-self.bandwidth * (end - self.time)) * (self.u[0] - self.y);
        self.time = end;
        Ok(())
    }
}

fmi_model::export!(Actuator);
