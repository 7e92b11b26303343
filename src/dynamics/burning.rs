//! Eq. (3) while fuel burns.

use super::loads::Airflow;
use crate::solve::Scalar;
use crate::vehicle::{Airframe, Control, FUEL, FuelTable, Gust, PHI, State, Vehicle, eta, eta_dot};

impl Vehicle {
    /// Applies `f` to the airframe, the airflow and the state derivatives [in modal coordinates, sensed].
    ///
    /// Fuel leaves with the local velocity of the beam, so M u'' + K u = F holds for its displacement u
    /// at any fuel mass f. With the modal expansion u = Phi(f) eta,
    ///
    /// ```text
    /// eta'' + 2 f' B eta' + D eta' + K eta = N,   B = mu^-1 Phi^T M dPhi/df
    /// ```
    ///
    /// neglecting `(f'^2 mu^-1 Phi^T M d^2Phi/df^2 + f'' B) eta`, of second order in f' (errata, 22). The
    /// acceleration of a point is Phi (eta'' + 2 f' B eta'), so an accelerometer senses the modal
    /// acceleration without the term in B.
    #[inline(never)]
    pub(super) fn with_fuel_burn<S: Scalar, T>(
        &self,
        fuel_table: &FuelTable,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
        f: impl FnOnce(&Airframe<S>, Airflow<S>, [State<S>; 2]) -> T,
    ) -> T {
        let airframe = fuel_table.airframe(x[FUEL]);
        let airflow = self.airflow(&airframe, x, u, gust);
        let mut rates = self.rates(&airframe, &airflow, x);

        // Density times speed.
        let mass_flux = airflow.loads.qbar * 2.0 * airflow.per_speed;
        let fuel_rate = -self.intake.fuel_flow(
            mass_flux,
            airflow.loads.mach,
            airflow.coefficients.inflow,
            u[PHI],
        );
        rates[FUEL] = fuel_rate;
        let mut sensed = rates;
        for i in 0..self.modes {
            let (mut stiffness, mut turning) = (S::constant(0.0), S::constant(0.0));
            for k in 0..self.modes {
                if k != i {
                    stiffness = stiffness + x[eta(k)] * airframe.stiffness[i][k];
                }
                turning = turning + fuel_rate * 2.0 * x[eta_dot(k)] * airframe.turning[i][k];
            }
            sensed[eta_dot(i)] = sensed[eta_dot(i)] - stiffness;
            rates[eta_dot(i)] = sensed[eta_dot(i)] - turning;
        }
        f(&airframe, airflow, [rates, sensed])
    }
}
