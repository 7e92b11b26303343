//! A sensor: lag, bias, scale, noise, sampling, quantisation and failures.

#![deny(unsafe_code)]
#![warn(clippy::disallowed_macros, clippy::disallowed_methods, clippy::disallowed_types)]

use fmi_model::{About, Dependencies, Kind, Model, Simulation, Unit, Variable};
use std::convert::Infallible;

/// The parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    lag: f64,
}

/// A running simulation.
#[derive(Debug)]
pub struct Running {
    time: f64,
    u: [f64; 1],
    y: f64,
    lag: f64,
}

impl Model for Sensor {
    type Simulation = Running;
    type Error = Infallible;

    const ABOUT: About = About {
        description: "Sensor with lag, noise, sampling and failures",
        author: "ahv",
        license: env!("CARGO_PKG_LICENSE"),
        ..About::new("ahv_sensor", env!("CARGO_PKG_VERSION"))
    };
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::NONE, "Measured quantity"),
        Variable::output("y", Unit::NONE, "Measurement", Dependencies::NONE, |y: &f64| *y),
        Variable::parameter(
            "lag",
            Kind::Real(Unit::NONE),
            "Time constant",
            |m: &Self| m.lag,
            |m, v| m.lag = v,
        ),
    ];

    fn new() -> Result<Self, Infallible> {
        Ok(Self { lag: 0.1 })
    }
    fn start(&self, time: f64, _tolerance: f64) -> Result<Running, Infallible> {
        Ok(Running { time, u: [0.0], y: 0.0, lag: self.lag })
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
        self.y -= libm::expm1(-1.0 / self.lag * (end - self.time)) * (self.u[0] - self.y);
        self.time = end;
        Ok(())
    }
}

fmi_model::export!(Sensor);
