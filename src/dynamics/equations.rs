//! Eq. (3) with its errata applied; x' = f(x, u), y = g(x, u).

use super::outputs::Outputs;
use crate::solve::Scalar;
use crate::vehicle::{Control, Gust, State, Vehicle};

impl Vehicle {
    /// Eq. (3): time derivatives of all states, in moving air.
    ///
    /// Beyond eq. (3), which knows still air only: lift and drag are those of the speed and the
    /// incidence relative to the air, across and along the stream (Etkin, Dynamics of Atmospheric
    /// Flight, 1972, ch. 13). The gust is the same from nose to tail.
    pub fn derivatives<S: Scalar>(&self, x: &State<S>, u: &Control<S>, gust: Gust<S>) -> State<S> {
        match &self.fuel_table {
            None => self.rates(&self.airframe, &self.airflow(&self.airframe, x, u, gust), x),
            Some(fuel_table) => {
                self.with_fuel_burn(fuel_table, x, u, gust, |_, _, [rates, _]| rates)
            }
        }
    }

    /// [`Vehicle::derivatives`], and everything that is shown beside the states.
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

    /// Everything that is shown beside the states, whose rates are known.
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
