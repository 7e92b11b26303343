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
        match &self.burn {
            None => self.rates(&self.airframe, &self.met(&self.airframe, x, u, gust), x),
            Some(burn) => self.burning(burn, x, u, gust, |_, _, [rates, _]| rates),
        }
    }

    /// [`Vehicle::derivatives`], and everything that is shown beside the states.
    pub fn both<S: Scalar>(
        &self,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
    ) -> (State<S>, Outputs<S>) {
        if let Some(burn) = &self.burn {
            return self.burning(burn, x, u, gust, |airframe, met, [rates, felt]| {
                (rates, self.shown(airframe, &met, x, u, &felt))
            });
        }
        let met = self.met(&self.airframe, x, u, gust);
        let rates = self.rates(&self.airframe, &met, x);
        (rates, self.shown(&self.airframe, &met, x, u, &rates))
    }

    /// Everything that is shown beside the states, whose rates are known.
    pub fn outputs<S: Scalar>(
        &self,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
        rates: &State<S>,
    ) -> Outputs<S> {
        if self.burn.is_some() {
            return self.both(x, u, gust).1;
        }
        self.shown(&self.airframe, &self.met(&self.airframe, x, u, gust), x, u, rates)
    }
}
