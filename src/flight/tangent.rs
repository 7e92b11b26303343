//! Derivatives of everything that a flight shows, exact by dual numbers.

use super::{Flight, INPUTS, Inputs, Sample};
use crate::dynamics::State;
use crate::error::Error;
use crate::scalar::Dual;

impl Flight {
    /// The change of everything that is shown, for a change of the state and of the inputs: a flight
    /// whose numbers are derivatives, exact by dual numbers. Parameters and what is computed from
    /// them alone do not change and are not to be read from it.
    ///
    /// A control beyond its limit answers nothing.
    ///
    /// # Errors
    /// Those of [`Flight::initialise`], if the flight is not initialised yet.
    pub fn tangent(&mut self, change: &State, input_change: &[f64; INPUTS]) -> Result<Self, Error> {
        self.initialise()?;
        let mut tangent = self.clone();
        tangent.state = *change;
        tangent.inputs.values = *input_change;
        tangent.slope = None;
        tangent.sample = self.ready.as_ref().map(|ready| {
            let vehicle = &ready.vehicle;
            let (base, (control, gust)) = (ready.base, self.control(ready));
            let (moved, gust_change) = Inputs::split(input_change);
            let control_change = std::array::from_fn(|i| {
                let [min, max] = vehicle.ranges()[i];
                let wanted = base[i] + self.inputs.values[i];
                if (min..=max).contains(&wanted) { moved[i] } else { 0.0 }
            });
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
        Ok(tangent)
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
