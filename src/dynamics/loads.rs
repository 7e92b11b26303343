//! Aerodynamic loads: eq. (4).

use super::coefficients::{Coefficients, coefficients};
use super::relative_wind::RelativeWind;
use crate::solve::{Over, Scalar};
use crate::vehicle::{Airframe, Control, FUEL, GUSTS, Gust, H, PHI, State, Vehicle};

/// Forces on the vehicle, per metre of width.
#[derive(Debug, Clone, Copy)]
pub struct Loads<S> {
    /// Dynamic pressure, Pa.
    pub qbar: S,
    /// Mach number.
    pub mach: S,
    /// Lift, N/m.
    pub lift: S,
    /// Drag, N/m.
    pub drag: S,
    /// Thrust, N/m.
    pub thrust: S,
    /// Pitching moment about the mass centre, nose up, including thrust, N.
    pub moment: S,
    /// Aerodynamic force normal to the body axis, N/m.
    pub normal: S,
}

impl<S: Copy> Loads<S> {
    /// Applies `f` to each quantity.
    pub(super) fn map<T>(self, f: impl Fn(S) -> T) -> Loads<T> {
        Loads {
            qbar: f(self.qbar),
            mach: f(self.mach),
            lift: f(self.lift),
            drag: f(self.drag),
            thrust: f(self.thrust),
            moment: f(self.moment),
            normal: f(self.normal),
        }
    }
}

/// Relative wind, coefficients and loads at a state.
pub(super) struct Airflow<S> {
    pub wind: RelativeWind<S>,
    /// 1/airspeed, s/m.
    pub per_speed: S,
    /// Dynamic pressure times reference area, N/m.
    pub force: S,
    pub coefficients: Coefficients<S>,
    pub loads: Loads<S>,
}

impl Vehicle {
    /// Eq. (4) in still air.
    pub fn loads<S: Scalar>(&self, x: &State<S>, u: &Control<S>) -> Loads<S> {
        let still = [S::constant(0.0); GUSTS];
        match &self.fuel_table {
            None => self.airflow(&self.airframe, x, u, still).loads,
            Some(fuel_table) => self.airflow(&fuel_table.airframe(x[FUEL]), x, u, still).loads,
        }
    }

    /// Eq. (4) in moving air.
    #[inline(always)]
    pub(super) fn airflow<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
    ) -> Airflow<S> {
        let wind = RelativeWind::new(x, gust);
        let (speed, alpha, (sin, cos)) = (wind.speed, wind.incidence, wind.incidence_sin_cos);
        let air = self.atmosphere.air(x[H]);
        let qbar = air.density * speed * speed * 0.5;
        let force = qbar * self.aero.area;
        let per_speed = S::constant(1.0) / speed;
        let coefficients = coefficients(&self.aero, &airframe.elastic, x, u, [alpha, per_speed]);
        let [c_l, c_d, c_m, c_t] = coefficients.body;

        let c_n = c_l * cos + c_d * sin;
        let shift = airframe.mass_centre - self.aero.moment_centre;
        let thrust = force * c_t;
        let loads = Loads {
            qbar,
            mach: speed / air.sound_speed,
            lift: force * c_l,
            drag: force * c_d,
            thrust,
            moment: thrust * self.aero.thrust_arm + force * (c_m * self.aero.chord + c_n * shift),
            normal: force * c_n,
        };
        Airflow { wind, per_speed, force, coefficients, loads }
    }

    pub(super) fn choking_margin<S: Scalar>(&self, airflow: &Airflow<S>, u: &Control<S>) -> S {
        let inflow = airflow.coefficients.inflow;
        let sound_speed = airflow.wind.speed / airflow.loads.mach;
        self.choking.margin(airflow.loads.mach, inflow, sound_speed, u[PHI])
    }
}
