//! Flight dynamics: eq. (3) of the paper with its errata applied; x' = f(x, u), y = g(x, u).
//!
//! The functions are pure and generic over the number type, so dual numbers give exact
//! derivatives. The generalised slosh force Q_i of eq. (3) does not appear: the sloshing masses
//! are unknowns of the eigenproblem, so their force is inside the modes already.

mod airframe;
mod burning;
mod limits;
mod modal;
mod outputs;
mod sensors;
mod stream;

pub use airframe::{Airframe, COEFFICIENTS};
pub use limits::{STATE_NAMES, is_finite, numberless};
pub use outputs::{Loads, Outputs};
pub use sensors::{Imu, Stations};

use crate::aero::Aero;
use crate::atmosphere::Atmosphere;
use crate::burn::Burn;
use crate::choking::Choking;
use crate::intake::Intake;
use crate::modes::{FLEXIBLE, MODES};
use crate::scalar::{Over, Scalar};
use modal::Coefficients;
use std::sync::Arc;
use stream::Stream;

/// V, h, gamma, alpha, q.
pub const RIGID: usize = 5;
/// Number of the fuel among the states; before it, behind the rigid states, (eta, eta-dot) of the
/// flexible modes, then of the slosh modes.
pub const FUEL: usize = RIGID + 2 * MODES;
/// All states.
pub const STATES: usize = FUEL + 1;
/// delta_e, phi.
pub const CONTROLS: usize = 2;
/// Typical size of each state (m/s, m, rad, rad, rad/s, then m and m/s, kg/m): scales the tolerance.
pub const NOMINAL: [f64; STATES] =
    [1e3, 1e4, 0.01, 0.01, 0.01, 1e-3, 0.01, 1e-3, 0.01, 1e-4, 0.005, 0.01, 0.05, 0.01, 0.05, 1e3];

/// All states; those of modes that a configuration does not have stay zero.
pub type State<S = f64> = [S; STATES];
/// Effective elevator deflection (rad) and fuel equivalence ratio.
pub type Control<S = f64> = [S; CONTROLS];
/// Velocity of the air, m/s: vertical, up positive, and horizontal, along the flight direction.
pub type Gust<S = f64> = [S; GUSTS];
/// Components of a gust.
pub const GUSTS: usize = 2;
/// Fastest gust, m/s: a faster one has no effect beyond this.
pub const FASTEST_GUST: f64 = 200.0;

/// The vehicle in one configuration, ready to fly. Per metre of width.
#[derive(Debug, Clone)]
pub struct Vehicle {
    /// Air and gravity.
    pub atmosphere: Atmosphere,
    /// Curve fits of the rigid body.
    pub aero: Aero,
    /// Number of modes in use: 0, 3 or 5.
    pub modes: usize,
    /// Fuel at the start, kg/m.
    pub fuel: f64,
    /// Frequencies at the start, rad/s.
    pub omega: [f64; MODES],
    /// What the fuel level decides, at the start.
    pub airframe: Airframe,
    /// The same at every level below, if fuel burns.
    pub burn: Option<Arc<Burn>>,
    /// What the engine swallows.
    pub intake: Intake,
    /// When its burner chokes.
    pub choking: Choking,
    /// Where the sensors sit.
    pub stations: Stations,
    /// Largest elevator deflection (rad) and fuel equivalence ratio.
    pub limits: Control,
}

/// What the air makes of a state.
struct Met<S> {
    stream: Stream<S>,
    /// One over the speed through the air, s/m.
    per_speed: S,
    /// Dynamic pressure by the reference area, N/m.
    force: S,
    coefficients: Coefficients<S>,
    loads: Loads<S>,
}

impl Vehicle {
    /// Number of states in motion at one fuel level: 5, 11 or 15.
    pub fn states(&self) -> usize {
        RIGID + 2 * self.modes
    }

    /// Eq. (4), in still air.
    pub fn loads<S: Scalar>(&self, x: &State<S>, u: &Control<S>) -> Loads<S> {
        let still = [S::constant(0.0); GUSTS];
        match &self.burn {
            None => self.met(&self.airframe, x, u, still).loads,
            Some(burn) => self.met(&burn.airframe(x[FUEL]), x, u, still).loads,
        }
    }

    /// What the air makes of a state, with the loads of eq. (4).
    #[inline(always)]
    fn met<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        x: &State<S>,
        u: &Control<S>,
        gust: Gust<S>,
    ) -> Met<S> {
        let stream = Stream::new(x, gust);
        let (speed, alpha, (sin, cos)) = (stream.speed, stream.incidence, stream.axis);
        let air = self.atmosphere.air(x[1]);
        let qbar = air.density * speed * speed * 0.5;
        let force = qbar * self.aero.area;
        let per_speed = S::constant(1.0) / speed;
        let coefficients =
            modal::coefficients(&self.aero, &airframe.elastic, x, u, [alpha, per_speed]);
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
        Met { stream, per_speed, force, coefficients, loads }
    }

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

    /// Eq. (3) in known air, at one fuel level.
    #[inline(always)]
    fn rates<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        met: &Met<S>,
        x: &State<S>,
    ) -> State<S> {
        let Met { stream, loads, .. } = met;
        let [speed, altitude, gamma, _, q, ..] = *x;
        let (sin_alpha, cos_alpha) = stream.body;
        let (sin_turn, cos_turn) = stream.turn;
        let (gravity, distance) = self.atmosphere.gravity(altitude);
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        let per_speed = S::constant(1.0) / speed;
        let per_mass = C::constant(1.0) / airframe.mass;

        let lift = loads.lift * cos_turn + loads.drag * sin_turn;
        let drag = loads.drag * cos_turn - loads.lift * sin_turn;
        let gamma_dot = (lift + loads.thrust * sin_alpha) * per_speed * per_mass
            - (gravity * per_speed - speed / distance) * cos_gamma;

        let mut rates = [S::constant(0.0); STATES];
        rates[0] = (loads.thrust * cos_alpha - drag) * per_mass - gravity * sin_gamma;
        rates[1] = speed * sin_gamma;
        rates[2] = gamma_dot;
        rates[3] = q - gamma_dot;
        rates[4] = loads.moment * (C::constant(1.0) / airframe.inertia);

        if self.modes == 0 {
            return rates;
        }
        let modal = modal::accelerations(airframe, met, x);
        for (i, acceleration) in modal.into_iter().enumerate() {
            let (eta, eta_dot) = (RIGID + 2 * i, RIGID + 2 * i + 1);
            rates[eta] = x[eta_dot];
            rates[eta_dot] = acceleration;
        }
        // Modes that a configuration does not have stay where they are, whatever their rates say.
        if self.modes <= FLEXIBLE {
            rates[RIGID + 2 * FLEXIBLE..RIGID + 2 * MODES].fill(S::constant(0.0));
        }
        rates
    }

    fn shown<C: Scalar, S: Scalar + Over<C>>(
        &self,
        airframe: &Airframe<C>,
        met: &Met<S>,
        x: &State<S>,
        u: &Control<S>,
        rates: &State<S>,
    ) -> Outputs<S> {
        let gravity = self.atmosphere.sea_level_gravity();
        let Stations { imu, probe } = self.stations;
        Outputs {
            loads: met.loads,
            theta: x[2] + x[3],
            slosh: airframe.sloshing(x),
            n_z: met.loads.normal * (C::constant(1.0) / (airframe.mass * gravity)),
            imu: sensors::imu(airframe, met, x, rates, imu, gravity),
            alpha_probe: sensors::vane(airframe, met, x, rates, probe),
            choking_margin: self.choking_margin(met, u),
        }
    }

    fn choking_margin<S: Scalar>(&self, met: &Met<S>, u: &Control<S>) -> S {
        let inflow = met.coefficients.inflow;
        let sound_speed = met.stream.speed / met.loads.mach;
        self.choking.margin(met.loads.mach, inflow, sound_speed, u[1])
    }

    /// Smallest and largest elevator deflection (rad) and fuel equivalence ratio.
    pub fn ranges(&self) -> Control<[f64; 2]> {
        let [delta_e, phi] = self.limits;
        [[-delta_e, delta_e], [0.0, phi]]
    }

    /// Controls cut to what the actuators can do.
    pub fn saturate(&self, u: Control) -> Control {
        let [[least, largest], [lean, rich]] = self.ranges();
        [u[0].clamp(least, largest), u[1].clamp(lean, rich)]
    }

    /// A gust cut to the fastest.
    pub fn gust(wanted: Gust) -> Gust {
        wanted.map(|speed| speed.clamp(-FASTEST_GUST, FASTEST_GUST))
    }
}
