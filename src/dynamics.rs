//! Flight dynamics: eq. (3) of the paper with its errata applied; x' = f(x, u), y = g(x, u).
//!
//! The functions are pure and generic over the number type, so dual numbers give exact
//! derivatives. The generalised slosh force Q_i of eq. (3) does not appear: the sloshing masses
//! are unknowns of the eigenproblem, so their force is inside the modes already.

mod stream;

use crate::aero::{Aero, Elastic, ElasticTerm, PerMode};
use crate::atmosphere::Atmosphere;
use crate::modes::{MODES, SLOSH};
use crate::scalar::Scalar;
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

/// The vehicle in one configuration at one fuel level, ready to fly. Per metre of width.
#[derive(Debug, Clone)]
pub struct Vehicle {
    /// Air and gravity.
    pub atmosphere: Atmosphere,
    /// Curve fits of the rigid body.
    pub aero: Aero,
    /// Elastic terms of the curve fits; modal forces already divided by the modal mass.
    pub elastic: Elastic,
    /// Mass, kg/m.
    pub mass: f64,
    /// Pitch inertia, kg m^2/m.
    pub inertia: f64,
    /// Station of the mass centre, m from the nose.
    pub mass_centre: f64,
    /// Fuel at the start, kg/m.
    pub fuel: f64,
    /// Number of modes in use: 0, 3 or 5.
    pub modes: usize,
    /// Frequencies, rad/s.
    pub omega: [f64; MODES],
    /// Modal damping matrix, 1/s: eta-dd + D eta-d + omega^2 eta = N.
    pub damping: [[f64; MODES]; MODES],
    /// Modal acceleration by which the tanks' floors carry the liquid's weight, m/s^2: the springs
    /// of the sloshing masses bear only what deviates from steady flight.
    pub floor: [f64; MODES],
    /// Sloshing displacement relative to the tank per modal coordinate.
    pub slosh: [[f64; MODES]; SLOSH],
    /// Largest elevator deflection (rad) and fuel equivalence ratio.
    pub limits: Control,
}

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
        }
    }
}

impl Vehicle {
    /// Number of states in motion at one fuel level: 5, 11 or 15.
    pub fn states(&self) -> usize {
        RIGID + 2 * self.modes
    }

    /// Eq. (4), in still air.
    pub fn loads<S: Scalar>(&self, x: &State<S>, u: &Control<S>) -> Loads<S> {
        self.loads_on(x[3].sin_cos(), x, u)
    }

    /// Eq. (4), with the sine and cosine of the incidence.
    #[inline]
    fn loads_on<S: Scalar>(&self, (sin, cos): (S, S), x: &State<S>, u: &Control<S>) -> Loads<S> {
        let (speed, altitude, alpha) = (x[0], x[1], x[3]);
        let (delta_e, phi) = (u[0], u[1]);
        let air = self.atmosphere.air(altitude);
        let qbar = air.density * speed * speed * 0.5;
        let force = qbar * self.aero.area;
        let per_speed = S::constant(1.0) / speed;
        let elastic = |term: &ElasticTerm| self.elastic_sum(term, x, per_speed);

        let c_l = self.aero.lift.at(alpha, delta_e)
            + phi * self.aero.lift_phi.body(alpha)
            + elastic(&self.elastic.lift);
        let c_d = self.aero.drag.at(alpha, delta_e)
            + phi * self.aero.drag_phi.body(alpha)
            + elastic(&self.elastic.drag);
        let c_m = self.aero.moment.at(alpha, delta_e)
            + phi * self.aero.moment_phi.body(alpha)
            + elastic(&self.elastic.moment);
        let inflow = alpha + elastic(&self.elastic.inflow);
        let c_t = self.aero.thrust.body(inflow) + phi * self.aero.thrust_phi.body(inflow);

        let c_n = c_l * cos + c_d * sin;
        let shift = self.mass_centre - self.aero.moment_centre;
        let thrust = force * c_t;
        Loads {
            qbar,
            mach: speed / air.sound_speed,
            lift: force * c_l,
            drag: force * c_d,
            thrust,
            moment: thrust * self.aero.thrust_arm + force * (c_m * self.aero.chord + c_n * shift),
            normal: force * c_n,
        }
    }

    /// Sum of an elastic term over the modal coordinates and their rates.
    #[inline]
    fn elastic_sum<S: Scalar>(&self, term: &ElasticTerm, x: &State<S>, per_speed: S) -> S {
        let mut sums = [S::constant(0.0); 2];
        for (i, per) in term.per.iter().enumerate() {
            for part in 0..2 {
                sums[part] = sums[part] + x[RIGID + 2 * i + part] * per[part];
            }
        }
        sums[0] + sums[1] * per_speed
    }

    /// Eq. (3): time derivatives of all states, in air that rises at `gust`, m/s.
    ///
    /// Beyond eq. (3), which knows still air only: lift and drag are those of the speed and the
    /// incidence relative to the air, across and along the stream (Etkin, Dynamics of Atmospheric
    /// Flight, 1972, ch. 13). The gust is the same from nose to tail.
    pub fn derivatives<S: Scalar>(&self, x: &State<S>, u: &Control<S>, gust: S) -> State<S> {
        let stream = Stream::new(x, gust);
        self.rates(&stream, &self.loads_on(stream.axis, &stream.state, u), x, u)
    }

    /// Everything that is shown beside the states, in air that rises at `gust`, m/s.
    pub fn outputs<S: Scalar>(&self, x: &State<S>, u: &Control<S>, gust: S) -> Outputs<S> {
        let stream = Stream::new(x, gust);
        self.shown(self.loads_on(stream.axis, &stream.state, u), x)
    }

    /// [`Vehicle::derivatives`] and [`Vehicle::outputs`] for little more than one of them.
    pub fn both<S: Scalar>(&self, x: &State<S>, u: &Control<S>, gust: S) -> (State<S>, Outputs<S>) {
        let stream = Stream::new(x, gust);
        let loads = self.loads_on(stream.axis, &stream.state, u);
        (self.rates(&stream, &loads, x, u), self.shown(loads, x))
    }

    /// Eq. (3) under known loads.
    fn rates<S: Scalar>(
        &self,
        stream: &Stream<S>,
        loads: &Loads<S>,
        x: &State<S>,
        u: &Control<S>,
    ) -> State<S> {
        let [speed, altitude, gamma, _, q, ..] = *x;
        let (sin_alpha, cos_alpha) = stream.body;
        let (sin_turn, cos_turn) = stream.turn;
        let (gravity, distance) = self.atmosphere.gravity(altitude);
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        let per_speed = S::constant(1.0) / speed;
        let per_mass = 1.0 / self.mass;

        let lift = loads.lift * cos_turn + loads.drag * sin_turn;
        let drag = loads.drag * cos_turn - loads.lift * sin_turn;
        let gamma_dot = (lift + loads.thrust * sin_alpha) * per_speed * per_mass
            - (gravity * per_speed - speed / distance) * cos_gamma;

        let mut rates = [S::constant(0.0); STATES];
        rates[0] = (loads.thrust * cos_alpha - drag) * per_mass - gravity * sin_gamma;
        rates[1] = speed * sin_gamma;
        rates[2] = gamma_dot;
        rates[3] = q - gamma_dot;
        rates[4] = loads.moment * (1.0 / self.inertia);

        if self.modes == 0 {
            return rates;
        }
        let modal = self.modal_accelerations(stream.axis.0, loads, &stream.state, u);
        for (i, acceleration) in modal.into_iter().enumerate().take(self.modes) {
            let (eta, eta_dot) = (RIGID + 2 * i, RIGID + 2 * i + 1);
            rates[eta] = x[eta_dot];
            rates[eta_dot] = acceleration;
        }
        rates
    }

    /// Second derivatives of the modal coordinates, of a state as the air meets it. Term by term
    /// for all modes at once; a function of its own, as compilers make two operations one where
    /// results go to memory side by side.
    #[inline(never)]
    fn modal_accelerations<S: Scalar>(
        &self,
        sin_incidence: S,
        loads: &Loads<S>,
        x: &State<S>,
        u: &Control<S>,
    ) -> [S; MODES] {
        let (alpha, q) = (x[3], x[4]);
        let per_speed = S::constant(1.0) / x[0];
        let n = &self.elastic.force;
        // Over qbar S.
        let mut air = n.alpha[0].map(S::constant);
        add(&mut air, alpha, &n.alpha[1]);
        add(&mut air, alpha * alpha, &n.alpha[2]);
        add(&mut air, self.aero.lift.elevator(u[0]), &n.delta_e);
        add(&mut air, u[1] * self.aero.lift_phi.body(alpha), &n.plume);
        add(&mut air, q * per_speed, &n.pitch_rate);
        for (k, [per_eta, per_rate]) in n.elastic.iter().enumerate() {
            add(&mut air, x[RIGID + 2 * k], per_eta);
            add(&mut air, x[RIGID + 2 * k + 1] * per_speed, per_rate);
        }
        let mut sum = self.floor.map(S::constant);
        add(&mut sum, loads.thrust * sin_incidence, &n.thrust_across);
        add(&mut sum, loads.thrust, &n.thrust_couple);
        let force = loads.qbar * self.aero.area;
        for i in 0..MODES {
            let stiffness = x[RIGID + 2 * i] * (self.omega[i] * self.omega[i]);
            sum[i] = sum[i] + force * air[i] - stiffness;
        }
        for k in 0..MODES {
            let damping = std::array::from_fn(|i| -self.damping[i][k]);
            add(&mut sum, x[RIGID + 2 * k + 1], &damping);
        }
        sum
    }

    fn shown<S: Scalar>(&self, loads: Loads<S>, x: &State<S>) -> Outputs<S> {
        let slosh = std::array::from_fn(|tank| {
            let parts = self.slosh[tank].iter().enumerate();
            parts.fold(S::constant(0.0), |sum, (i, per)| sum + x[RIGID + 2 * i] * *per)
        });
        let weight = self.mass * self.atmosphere.sea_level_gravity();
        Outputs { loads, theta: x[2] + x[3], slosh, n_z: loads.normal * (1.0 / weight) }
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
}

/// Adds a term to a quantity of each mode.
#[inline]
fn add<S: Scalar>(sum: &mut [S; MODES], factor: S, per_mode: &PerMode) {
    for (sum, per) in sum.iter_mut().zip(per_mode) {
        *sum = *sum + factor * *per;
    }
}
