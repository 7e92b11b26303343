//! Eq. (3) at one fuel level:
//!
//! ```text
//! V'     = (T cos alpha - D)/m - g sin gamma              h' = V sin gamma
//! gamma' = (L + T sin alpha)/(m V) - (g/V - V/r) cos gamma
//! alpha' = q - gamma'                                     q' = M/I_yy
//! ```
//!
//! with lift L normal to and drag D along the flight path, and r the distance from the earth's centre.

use super::loads::Airflow;
use super::modal;
use crate::solve::{Over, Scalar};
use crate::structure::{FLEXIBLE, MODES};
use crate::vehicle::{ALPHA, Airframe, GAMMA, H, Q, STATES, State, V, Vehicle, eta, eta_dot};

impl Vehicle {
    /// Eq. (3) for a given airflow.
    #[inline(always)]
    pub(super) fn rates<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        airflow: &Airflow<S>,
        x: &State<S>,
    ) -> State<S> {
        let Airflow { wind, loads, .. } = airflow;
        let [speed, altitude, gamma, _, q, ..] = *x;
        let (sin_alpha, cos_alpha) = wind.alpha_sin_cos;
        let (sin_gust_angle, cos_gust_angle) = wind.gust_angle_sin_cos;
        let (gravity, distance) = self.atmosphere.gravity(altitude);
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        let per_speed = S::constant(1.0) / speed;
        let per_mass = C::constant(1.0) / airframe.mass;

        let lift = loads.lift * cos_gust_angle + loads.drag * sin_gust_angle;
        let drag = loads.drag * cos_gust_angle - loads.lift * sin_gust_angle;
        let gamma_dot = (lift + loads.thrust * sin_alpha) * per_speed * per_mass
            - (gravity * per_speed - speed / distance) * cos_gamma;

        let mut rates = [S::constant(0.0); STATES];
        rates[V] = (loads.thrust * cos_alpha - drag) * per_mass - gravity * sin_gamma;
        rates[H] = speed * sin_gamma;
        rates[GAMMA] = gamma_dot;
        rates[ALPHA] = q - gamma_dot;
        rates[Q] = loads.moment * (C::constant(1.0) / airframe.inertia);

        if self.modes == 0 {
            return rates;
        }
        let modal = modal::accelerations(airframe, airflow, x);
        for (i, acceleration) in modal.into_iter().enumerate() {
            rates[eta(i)] = x[eta_dot(i)];
            rates[eta_dot(i)] = acceleration;
        }
        // States of modes that the configuration lacks remain constant.
        if self.modes <= FLEXIBLE {
            rates[eta(FLEXIBLE)..eta(MODES)].fill(S::constant(0.0));
        }
        rates
    }
}
