//! Flight with fuel that burns.

use super::stream::Stream;
use super::{Control, FUEL, Outputs, RIGID, State, Vehicle, elastic_sum};
use crate::burn::Burn;
use crate::scalar::Scalar;

impl Vehicle {
    /// Rates and outputs while fuel burns.
    ///
    /// Fuel leaves its place with the velocity that it has there, so `M u'' + K u = F` holds for the
    /// displacement u of the beam at any fuel f. In modal coordinates, `u = Phi(f) eta`, this becomes
    /// `eta'' + 2 f' B eta' + D eta' + K eta = N` with `B = mu^-1 Phi^T M dPhi/df`. What is left out,
    /// `(f'^2 mu^-1 Phi^T M d^2Phi/df^2 + f'' B) eta`, is of second order in f' (errata, 22).
    #[inline(never)]
    pub(super) fn burning<S: Scalar>(
        &self,
        burn: &Burn,
        x: &State<S>,
        u: &Control<S>,
        gust: S,
    ) -> (State<S>, Outputs<S>) {
        let airframe = burn.airframe(x[FUEL]);
        let stream = Stream::new(x, gust);
        let loads = self.loads_on(&airframe, stream.axis, &stream.state, u);
        let mut rates = self.rates(&airframe, &stream, &loads, x, u);

        let [speed, _, _, incidence, ..] = stream.state;
        let per_speed = S::constant(1.0) / speed;
        let inflow = incidence + elastic_sum(&airframe.elastic.inflow, x, per_speed);
        // Density times speed.
        let mass_flux = loads.qbar * 2.0 * per_speed;
        let fuel_rate = -self.intake.fuel_flow(mass_flux, loads.mach, inflow, u[1]);
        rates[FUEL] = fuel_rate;
        for i in 0..self.modes {
            let mut coupling = S::constant(0.0);
            for k in 0..self.modes {
                let (eta, eta_dot) = (x[RIGID + 2 * k], x[RIGID + 2 * k + 1]);
                if k != i {
                    coupling = coupling + eta * airframe.stiffness[i][k];
                }
                coupling = coupling + fuel_rate * 2.0 * eta_dot * airframe.turning[i][k];
            }
            rates[RIGID + 2 * i + 1] = rates[RIGID + 2 * i + 1] - coupling;
        }
        (rates, self.shown(&airframe, loads, x))
    }

    /// Whether fuel burns and none is left; a mass that is not a number counts as none.
    pub fn out_of_fuel(&self, x: &State) -> bool {
        self.burn.is_some() && (x[FUEL] < 0.0 || x[FUEL].is_nan())
    }
}
