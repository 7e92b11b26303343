//! What has to be remembered of a flight.

use super::Flight;
use super::inputs::Inputs;
use crate::error::Error;
use crate::parameters::Parameters;
use crate::solve::Integrator;
use crate::vehicle::State;

/// All that a flight remembers: plain numbers, enough to restore it elsewhere bit for bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snapshot {
    /// Parameters.
    pub parameters: Parameters,
    /// Inputs as they were set.
    pub inputs: Inputs,
    /// State.
    pub state: State,
    /// Time, s.
    pub time: f64,
    /// Tolerance and step proposal.
    pub integrator: Integrator,
    /// Whether the initial state has been computed.
    pub initialised: bool,
}

impl Flight {
    /// All that has to be remembered.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            parameters: self.parameters,
            inputs: self.inputs,
            state: self.state,
            time: self.time,
            integrator: self.integrator,
            initialised: self.ready.is_some(),
        }
    }

    /// Becomes the flight that a snapshot was taken of, bit for bit. A vehicle with the same
    /// parameters is kept: a master that repeats steps does this often.
    ///
    /// # Errors
    /// Those of [`Flight::initialise`]; the flight is then as it was.
    pub fn rewind(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        let kept = snapshot.initialised && self.parameters == snapshot.parameters;
        if !(kept && self.ready.is_some()) {
            let mut flight = self.clone();
            flight.change(|parameters| *parameters = snapshot.parameters);
            if snapshot.initialised {
                flight.initialise()?;
            }
            *self = flight;
        }
        self.inputs = snapshot.inputs;
        self.state = snapshot.state;
        self.time = snapshot.time;
        self.integrator = snapshot.integrator;
        self.slope = None;
        self.sample = None;
        Ok(())
    }
}
