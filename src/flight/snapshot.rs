//! What has to be remembered of a flight.

use super::in_flight::Flight;
use super::inputs::{INPUT_ORDER, INPUTS, Inputs};
use crate::solve::Integrator;
use crate::vehicle::{STATES, State};

/// All that a flight remembers besides its vehicle: plain numbers, enough to continue it bit for bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snapshot {
    /// Inputs.
    pub inputs: Inputs,
    /// State.
    pub state: State,
    /// Time, s.
    pub time: f64,
    /// Tolerance and step proposal.
    pub integrator: Integrator,
}

impl Flight {
    /// All that has to be remembered.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            inputs: self.inputs,
            state: self.state,
            time: self.time,
            integrator: self.integrator,
        }
    }

    /// Continues from a snapshot of a flight with the same parameters, bit for bit.
    pub fn rewind(&mut self, snapshot: &Snapshot) {
        self.inputs = snapshot.inputs;
        self.state = snapshot.state;
        self.time = snapshot.time;
        self.legs = None;
        self.integrator = snapshot.integrator;
        self.slope = None;
        self.sample = None;
    }
}

impl Snapshot {
    /// Time, tolerance, step proposal, whether the inputs' derivatives are for the next step; states;
    /// inputs; their derivatives by order.
    pub const NUMBERS: usize = 4 + STATES + INPUTS * (1 + INPUT_ORDER);

    /// The numbers.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let Self { inputs, state, time, integrator } = *self;
        let ahead = if inputs.ahead { 1.0 } else { 0.0 };
        [time, integrator.tolerance, integrator.proposal, ahead]
            .into_iter()
            .chain(state)
            .chain(inputs.values)
            .chain(inputs.derivatives.into_iter().flatten())
    }

    /// The snapshot with these numbers, as many as there have to be.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let ([time, tolerance, proposal, ahead], rest) = numbers.split_first_chunk()?;
        let (state, rest) = rest.split_first_chunk()?;
        let (values, rest) = rest.split_first_chunk()?;
        let (derivatives, []) = rest.as_chunks() else { return None };
        let ahead = match *ahead {
            0.0 => false,
            1.0 => true,
            _ => return None,
        };
        Some(Self {
            inputs: Inputs { values: *values, derivatives: derivatives.try_into().ok()?, ahead },
            state: *state,
            time: *time,
            integrator: Integrator { tolerance: *tolerance, proposal: *proposal },
        })
    }
}
