//! Derivatives of everything that a flight has, exact by dual numbers.

use super::in_flight::{Flight, Sample};
use super::inputs::{INPUTS, Inputs};
use crate::error::Error;
use crate::solve::Dual;
use crate::vehicle::{Gust, State};

impl Flight {
    /// The change of a sample for a change of the state and of the inputs.
    ///
    /// An input beyond its limit changes nothing.
    ///
    /// # Errors
    /// Those of [`Flight::evaluate`].
    pub fn tangent(
        &mut self,
        change: &State,
        input_change: &[f64; INPUTS],
    ) -> Result<Sample, Error> {
        self.check_numbers()?;
        let vehicle = &self.vehicle;
        let (base, (control, gust)) = (self.base, self.control());
        let (moved, blown) = Inputs::split(input_change);
        let (wanted, wind) = Inputs::split(&self.inputs.values);
        let control_change = std::array::from_fn(|i| {
            let [min, max] = vehicle.control_ranges()[i];
            if (min..=max).contains(&(base[i] + wanted[i])) { moved[i] } else { 0.0 }
        });
        let gust_change: Gust =
            std::array::from_fn(|i| if gust[i] == wind[i] { blown[i] } else { 0.0 });
        let x = std::array::from_fn(|i| Dual { re: self.state[i], eps: [change[i]] });
        let u = std::array::from_fn(|i| Dual { re: control[i], eps: [control_change[i]] });
        let w = std::array::from_fn(|i| Dual { re: gust[i], eps: [gust_change[i]] });
        let along = |dual: Dual<1>| dual.eps[0];
        let (derivatives, outputs) = vehicle.derivatives_and_outputs(&x, &u, w);
        Ok(Sample {
            outputs: outputs.map(along),
            derivatives: derivatives.map(along),
            control: control_change,
        })
    }
}
