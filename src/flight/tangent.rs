//! Derivatives of everything that a flight shows, exact by dual numbers.

use super::inputs::{INPUTS, Inputs};
use super::{Flight, Sample};
use crate::error::Error;
use crate::solve::Dual;
use crate::vehicle::{Gust, State};

impl Flight {
    /// The change of everything that is shown, for a change of the state and of the inputs: a flight
    /// whose numbers are derivatives, exact by dual numbers. Parameters and what is computed from
    /// them alone do not change and are not to be read from it.
    ///
    /// An input beyond its limit changes nothing.
    ///
    /// # Errors
    /// Those of [`Flight::evaluate`].
    pub fn tangent(&mut self, change: &State, input_change: &[f64; INPUTS]) -> Result<Self, Error> {
        self.initialise()?;
        self.check_numbers()?;
        let sample = self.ready.as_ref().map(|ready| {
            let vehicle = &ready.vehicle;
            let (base, (control, gust)) = (ready.base, self.control(ready));
            let (moved, blown) = Inputs::split(input_change);
            let (wanted, wind) = Inputs::split(&self.inputs.values);
            let control_change = std::array::from_fn(|i| {
                let [min, max] = vehicle.ranges()[i];
                if (min..=max).contains(&(base[i] + wanted[i])) { moved[i] } else { 0.0 }
            });
            let gust_change: Gust =
                std::array::from_fn(|i| if gust[i] == wind[i] { blown[i] } else { 0.0 });
            let x = std::array::from_fn(|i| Dual { re: self.state[i], eps: [change[i]] });
            let u = std::array::from_fn(|i| Dual { re: control[i], eps: [control_change[i]] });
            let w = std::array::from_fn(|i| Dual { re: gust[i], eps: [gust_change[i]] });
            let along = |dual: Dual<1>| dual.eps[0];
            let (derivatives, outputs) = vehicle.both(&x, &u, w);
            Sample {
                outputs: outputs.map(along),
                derivatives: derivatives.map(along),
                control: control_change,
            }
        });
        Ok(Self {
            data: self.data.clone(),
            parameters: self.parameters,
            inputs: Inputs { values: *input_change, ..self.inputs },
            time: self.time,
            integrator: self.integrator,
            state: *change,
            ready: None,
            slope: None,
            sample,
        })
    }

    /// The change of everything that is shown per second, at the inputs' present rates.
    ///
    /// # Errors
    /// Those of [`Flight::initialise`], if the flight is not initialised yet.
    pub fn rates(&mut self) -> Result<Self, Error> {
        self.evaluate()?;
        let state = self.sample.map_or([0.0; _], |sample| sample.derivatives);
        let inputs = self.inputs.derivatives[0];
        self.tangent(&state, &inputs)
    }
}
