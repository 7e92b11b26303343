//! Eq. (3) with its errata applied; x' = f(x, u), y = g(x, u).

use super::outputs::Outputs;
use crate::solve::Scalar;
use crate::vehicle::{Control, Gust, State, Vehicle};

impl Vehicle {
    /// Eq. (3): time derivatives of all states, in moving air.
    ///
    /// Eq. (3) assumes still air. In a gust, lift and drag follow from airspeed and incidence and act
    /// normal to and along the relative wind (Etkin, Dynamics of Atmospheric Flight, 1972, ch. 13). The
    /// gust is uniform along the vehicle.
    pub fn derivatives<S: Scalar>(&self, x: &State<S>, u: &Control<S>, gust: Gust<S>) -> State<S> {
        match &self.fuel_table {
            None => self.rates(&self.airframe, &self.airflow(&self.airframe, x, u, gust), x),
            Some(fuel_table) => {
                self.with_fuel_burn(fuel_table, x, u, gust, |_, _, [rates, _]| rates)
            }
        }
    }

    /// [`Vehicle::derivatives`] and the outputs.
    pub fn derivatives_and_outputs<S: Scalar>(
        &self,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
    ) -> (State<S>, Outputs<S>) {
        if let Some(fuel_table) = &self.fuel_table {
            return self.with_fuel_burn(
                fuel_table,
                x,
                u,
                gust,
                |airframe, airflow, [rates, sensed]| {
                    (rates, self.outputs_from(airframe, &airflow, x, u, &sensed))
                },
            );
        }
        let airflow = self.airflow(&self.airframe, x, u, gust);
        let rates = self.rates(&self.airframe, &airflow, x);
        (rates, self.outputs_from(&self.airframe, &airflow, x, u, &rates))
    }

    /// Outputs, given the time derivatives of the states.
    pub fn outputs<S: Scalar>(
        &self,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
        rates: &State<S>,
    ) -> Outputs<S> {
        if self.fuel_table.is_some() {
            return self.derivatives_and_outputs(x, u, gust).1;
        }
        self.outputs_from(&self.airframe, &self.airflow(&self.airframe, x, u, gust), x, u, rates)
    }
}
