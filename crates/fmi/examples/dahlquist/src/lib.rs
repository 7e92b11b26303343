//! Dahlquist's test equation with an input, x' = k (u - x), as an FMU with every capability. A step is
//! exact for a constant input.
//!
//! `cargo run --release --package dahlquist` writes `dahlquist.fmu` beside the program.

use fmi_model::{
    About, Dependencies, Exchange, Kind, Model, Saving, Simulation, Tangent, Unit, Variable,
};
use std::convert::Infallible;

/// The parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Dahlquist {
    k_per_s: f64,
    x0: f64,
}

/// A running simulation.
#[derive(Debug)]
pub struct Decay {
    k_per_s: f64,
    time_s: f64,
    u: [f64; 1],
    x: [f64; 1],
    der_x: [f64; 1],
}

const PER_SECOND: &Unit = &Unit::new("1/s", None, [0, 0, -1, 0]);
const ON_STATE_AND_INPUT: u64 = 0b11;

impl Model for Dahlquist {
    type Simulation = Decay;
    type Error = Infallible;

    const ABOUT: About = About {
        description: "Dahlquist's test equation with an input",
        ..About::new("dahlquist", env!("CARGO_PKG_VERSION"))
    };
    const VARIABLES: &'static [Variable<Self>] = &[
        Variable::input(0, "u", Unit::ONE, "What x goes to"),
        Variable::output_state(0, "x", Unit::ONE, "State"),
        Variable::derivative(0, "der(x)", PER_SECOND, Dependencies::fixed(ON_STATE_AND_INPUT)),
        Variable::parameter(
            "k",
            Kind::Real(PER_SECOND),
            "Rate",
            |m: &Self| m.k_per_s,
            |m, v| m.k_per_s = v,
        )
        .within([0.0, 1e3]),
        Variable::parameter(
            "x0",
            Kind::Real(Unit::ONE),
            "Initial x",
            |m: &Self| m.x0,
            |m, v| m.x0 = v,
        ),
    ];

    fn new() -> Result<Self, Infallible> {
        Ok(Self { k_per_s: 1.0, x0: 1.0 })
    }

    fn start(&self, time_s: f64, _tolerance: f64) -> Result<Decay, Infallible> {
        let Self { k_per_s, x0 } = *self;
        Ok(Decay { k_per_s, time_s, u: [0.0], x: [x0], der_x: [0.0] })
    }
}

impl Simulation for Decay {
    type Sample = [f64; 1];
    type Error = Infallible;

    const EXCHANGE: Option<Exchange<Self>> = Some(Exchange {
        set_time: |decay, time_s| decay.time_s = time_s,
        set_states: |decay, states| decay.x.copy_from_slice(states),
        completed_step: |_| Ok(()),
    });
    const TANGENT: Option<Tangent<Self>> =
        Some(|decay, states, inputs| Ok([decay.k_per_s * (inputs[0] - states[0])]));
    const SAVING: Option<Saving<Self>> = Some(Saving {
        count: 3,
        save: |decay, numbers| numbers.extend([decay.time_s, decay.u[0], decay.x[0]]),
        check: |numbers| numbers.iter().all(|number| number.is_finite()),
        load: |decay, numbers| {
            [decay.time_s, decay.u[0], decay.x[0]] = [numbers[0], numbers[1], numbers[2]]
        },
    });

    fn time(&self) -> f64 {
        self.time_s
    }
    fn inputs(&self) -> &[f64] {
        &self.u
    }
    fn set_input(&mut self, number: usize, value: f64) {
        self.u[number] = value;
    }
    fn states(&self) -> &[f64] {
        &self.x
    }
    fn evaluate(&mut self) -> Result<&[f64; 1], Infallible> {
        self.der_x = [self.k_per_s * (self.u[0] - self.x[0])];
        Ok(&self.der_x)
    }
    fn derivatives(sample: &[f64; 1]) -> &[f64] {
        sample
    }
    fn advance(&mut self, end_s: f64) -> Result<(), Infallible> {
        let decay = (-self.k_per_s * (end_s - self.time_s)).exp();
        self.x[0] = self.u[0] + (self.x[0] - self.u[0]) * decay;
        self.time_s = end_s;
        Ok(())
    }
}

fmi_model::export!(Dahlquist);
