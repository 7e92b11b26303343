//! Inputs before the simulation starts: several masters set them then, though the standard says no.

use crate::model::{Model, Simulation};
use crate::table::inputs;

/// Values and derivatives of inputs for a simulation that has not started yet.
#[derive(Debug, Clone, PartialEq)]
pub struct Pending {
    /// Values, by the inputs' numbers.
    pub values: Vec<f64>,
    /// Derivatives for the first step, order by order; none if they were not given.
    pub derivatives: Option<Vec<f64>>,
}

impl Pending {
    /// Zero, and not moving.
    pub fn new<M: Model>() -> Self {
        Self { values: vec![0.0; inputs::<M>()], derivatives: None }
    }

    /// Sets the derivative of an order from 1 to `highest`.
    pub fn set_derivative(&mut self, number: usize, order: usize, highest: usize, value: f64) {
        let inputs = self.values.len();
        let zero = || vec![0.0; inputs * highest];
        self.derivatives.get_or_insert_with(zero)[(order - 1) * inputs + number] = value;
    }

    /// Sets a simulation's inputs.
    pub fn hand_over<S: Simulation>(&self, simulation: &mut S) {
        for (number, &value) in self.values.iter().enumerate() {
            simulation.set_input(number, value);
        }
        let (Some(moving), Some(derivatives)) = (&S::INPUT_DERIVATIVES, &self.derivatives) else {
            return;
        };
        let inputs = self.values.len();
        for (i, &value) in derivatives.iter().enumerate() {
            (moving.set)(simulation, i % inputs, i / inputs + 1, value);
        }
    }
}
