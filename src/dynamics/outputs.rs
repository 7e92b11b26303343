//! Outputs.

use super::loads::{Airflow, Loads};
use super::sensors::{self, Imu};
use crate::solve::{Over, Scalar};
use crate::structure::SLOSH;
use crate::vehicle::{ALPHA, Airframe, Control, GAMMA, SensorStations, State, Vehicle};

/// Outputs beyond the states.
#[derive(Debug, Clone, Copy)]
pub struct Outputs<S = f64> {
    /// Forces and flight condition.
    pub loads: Loads<S>,
    /// Pitch attitude, rad.
    pub theta: S,
    /// Displacement of the sloshing masses in the fore and aft tank, m.
    pub slosh: [S; SLOSH],
    /// Normal load factor at the mass centre, g.
    pub n_z: S,
    /// Readings of the inertial measurement unit.
    pub imu: Imu<S>,
    /// Incidence indicated by the vane, rad.
    pub alpha_probe: S,
    /// Equivalence ratio that can be added before the burner chokes.
    pub choking_margin: S,
}

impl<S: Copy> Outputs<S> {
    /// Applies `f` to each quantity, for example to extract the derivative of a dual number.
    pub fn map<T>(self, f: impl Fn(S) -> T) -> Outputs<T> {
        Outputs {
            loads: self.loads.map(&f),
            theta: f(self.theta),
            slosh: self.slosh.map(&f),
            n_z: f(self.n_z),
            imu: Imu {
                theta: f(self.imu.theta),
                q: f(self.imu.q),
                gamma: f(self.imu.gamma),
                n_z: f(self.imu.n_z),
                n_x: f(self.imu.n_x),
            },
            alpha_probe: f(self.alpha_probe),
            choking_margin: f(self.choking_margin),
        }
    }
}

impl Vehicle {
    /// Outputs at one fuel level; `rates` are those sensed by an accelerometer.
    pub(super) fn outputs_from<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        airflow: &Airflow<S>,
        x: &State<S>,
        u: &Control<S>,
        rates: &State<S>,
    ) -> Outputs<S> {
        let gravity = self.atmosphere.sea_level_gravity();
        let SensorStations { imu, probe } = self.stations;
        Outputs {
            loads: airflow.loads,
            theta: x[GAMMA] + x[ALPHA],
            slosh: airframe.sloshing(x),
            n_z: airflow.loads.normal * (C::constant(1.0) / (airframe.mass * gravity)),
            imu: sensors::imu(airframe, airflow, x, rates, imu, gravity),
            alpha_probe: sensors::vane(airframe, airflow, x, rates, probe),
            choking_margin: self.choking_margin(airflow, u),
        }
    }
}
