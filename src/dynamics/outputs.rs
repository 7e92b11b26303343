//! What a flight shows beside its states.

use super::Imu;
use crate::modes::SLOSH;

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
    /// Pitching moment about the mass centre, nose up, with the thrust's share, N.
    pub moment: S,
    /// Aerodynamic force normal to the body axis, N/m.
    pub normal: S,
}

/// What a flight shows beside its states.
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
    /// What the inertial measurement unit shows.
    pub imu: Imu<S>,
    /// Incidence that the vane shows, rad.
    pub alpha_probe: S,
    /// Fuel ratio that can still be added before the burner chokes.
    pub choking_margin: S,
}

impl<S: Copy> Loads<S> {
    /// Each quantity by itself.
    fn map<T>(self, f: impl Fn(S) -> T) -> Loads<T> {
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

impl<S: Copy> Outputs<S> {
    /// Each quantity by itself, for example the derivative out of a dual number.
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
