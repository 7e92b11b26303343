//! Flight of a rigid body with two sloshing masses, by the principle of virtual power.
//!
//! Everything is of the body: the velocity of its place P at the mass centre of all, its pitch, and the
//! displacements of the sloshing masses against it, which move across its axis. With `e` forward along
//! the axis, `n` up across it, `xi_j` the distance of a mass behind P:
//! `v_j = v_P - xi_j q n + s_j' n - s_j q e`. Modes, mean axes and the
//! momenta of the library appear nowhere.

use super::air::{Air, C, Force, Met, atan, atmosphere, real, speed_and_gravity};
use super::books::{Books, Wanted};
use ahv::data::Data;
use ahv::vehicle::Condition;
use nalgebra::{Complex, DMatrix, SMatrix, SVector, linalg::balancing};

/// Velocity of P (horizontal, up), altitude, pitch, pitch rate, then displacement and rate of each mass.
pub const STATES: usize = 9;
const STEP: f64 = 1e-30;
const NEWTON_STEPS: usize = 30;

pub type State = [C; STATES];
pub type Control = [C; 2];

/// How far the directions of forces are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Directions {
    /// As in eq. (3): the thrust keeps its angle with the mean axes; what moves liquid against the body is
    /// the lift and the thrust across the path, not the force across the body; and liquid that has
    /// moved across the axis has no lever there.
    Equations,
    /// Those of plane motion.
    Plane,
}

/// Loads on the body at its place P, in its axes.
struct Load {
    forward: C,
    up: C,
    nose_up: C,
    /// Force and moment of which liquid feels nothing: they act as if on each mass by its share.
    unfelt: [C; 2],
}

/// Steady flight.
#[derive(Debug, Clone, Copy)]
pub struct Steady {
    pub alpha: f64,
    pub control: [f64; 2],
}

pub struct Explicit<'a> {
    pub books: Books,
    directions: Directions,
    data: &'a Data,
    air: Air<'a>,
    /// Force of a tank's floor on its liquid, over its mass, m/s^2: what steady flight asks for, so that
    /// springs bear what deviates from it.
    floor: f64,
    /// Speed, altitude, path angle.
    condition: [f64; 3],
    pub steady: Steady,
}

/// x' = A x + B u, and y = C x of V with gamma of the mass centre of all, or with gamma of a station.
pub struct LinearModel {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
}

impl<'a> Explicit<'a> {
    pub fn new(
        data: &'a Data,
        set: ahv::data::AeroSet,
        wanted: &Wanted,
        condition: &Condition,
        directions: Directions,
    ) -> Self {
        let (set, vehicle, earth) = (data.aero(set), &data.vehicle, &data.earth);
        let [speed, felt] = speed_and_gravity(earth, condition);
        let books = Books::new(vehicle, set, wanted, felt);
        let air = Air::new(vehicle, set, earth, &books.total, wanted);
        let mut model = Self {
            books,
            directions,
            data,
            air,
            floor: 0.0,
            condition: [speed, condition.altitude, condition.gamma],
            steady: Steady { alpha: 0.0, control: [0.0; 2] },
        };
        model.find_steady();
        model
    }

    fn state(&self, alpha: C) -> State {
        let [speed, altitude, gamma] = self.condition.map(real);
        let mut x = [real(0.0); STATES];
        (x[0], x[1], x[2]) = (speed * gamma.cos(), speed * gamma.sin(), altitude);
        x[3] = alpha + gamma;
        x
    }

    /// Newton's method for no acceleration in any direction; masses at rest in their tanks.
    fn find_steady(&mut self) {
        let mut z = SVector::<f64, 3>::zeros();
        for _ in 0..NEWTON_STEPS {
            let residual = |z: [C; 3]| {
                let state = self.state(z[0]);
                let load = self.load(&state, [z[1], z[2]]);
                let [along, across] = self.field(&state);
                let mass = self.books.total.mass;
                [load.forward + along * mass, load.up + across * mass, load.nose_up]
            };
            let at = z.map(real);
            let value = residual([at[0], at[1], at[2]]);
            let jacobian = SMatrix::<f64, 3, 3>::from_columns(&[0, 1, 2].map(|k| {
                let mut moved = [at[0], at[1], at[2]];
                moved[k].im = STEP;
                SVector::from(residual(moved).map(|r| r.im / STEP))
            }));
            let value = SVector::from(value.map(|r| r.re));
            z -= jacobian.lu().solve(&value).expect("forces answer to incidence and controls");
        }
        self.steady = Steady { alpha: z[0], control: [z[1], z[2]] };
        let load = self.load(&self.state(real(z[0])), self.steady.control.map(real));
        self.floor = (load.up - load.unfelt[0]).re / self.books.total.mass;
    }

    /// Speed, m/s, and dynamic pressure by the reference area, N/m.
    pub fn dynamic_force(&self, set: &ahv::data::AeroData) -> (f64, f64) {
        let earth = &self.data.earth;
        let [speed, altitude, _] = self.condition;
        let (radius, gravity) = (earth.earth.radius_m.value, earth.earth.gravity_m_per_s2.value);
        let [_, density] = atmosphere(&earth.air, radius, gravity, real(altitude));
        (speed, 0.5 * density.re * speed * speed * set.reference.area_m2_per_m.value)
    }

    /// Incidence of the body: its pitch against the path of P.
    fn met(&self, x: &State) -> Met {
        let [u, v, altitude, pitch, q, ..] = *x;
        Met { altitude, speed: (u * u + v * v).sqrt(), alpha: pitch - atan(v / u), q }
    }

    /// Velocity of the mass centre of all, horizontal and up: the momentum over the mass.
    fn velocity(&self, x: &State) -> [C; 2] {
        let [u, v, _, pitch, q, ..] = *x;
        let masses = self.books.liquids.map(|l| l.sloshing / self.books.total.mass);
        let across = x[6] * masses[0] + x[8] * masses[1];
        let along = -(x[5] * masses[0] + x[7] * masses[1]) * q;
        let (sin, cos) = (pitch.sin(), pitch.cos());
        [u + along * cos - across * sin, v + along * sin + across * cos]
    }

    /// Gravity and what a round earth adds in the local horizontal frame, along and across the body,
    /// m/s^2.
    fn field(&self, x: &State) -> [C; 2] {
        let earth = &self.data.earth.earth;
        let [u, v] = self.velocity(x);
        let distance = x[2] + earth.radius_m.value;
        let ratio = real(earth.radius_m.value) / distance;
        let gravity = ratio * ratio * earth.gravity_m_per_s2.value;
        let (horizontal, up) = (-u * v / distance, u * u / distance - gravity);
        let (sin, cos) = (x[3].sin(), x[3].cos());
        [horizontal * cos + up * sin, up * cos - horizontal * sin]
    }

    /// Pitch of the mean axes, in which the masses have no angular momentum, against that of the body.
    fn mean_pitch(&self, x: &State) -> C {
        let Books { total, liquids, .. } = &self.books;
        let momenta = liquids.map(|l| l.sloshing * (l.station - total.centre) / total.inertia);
        -(x[5] * momenta[0] + x[7] * momenta[1])
    }

    fn load(&self, x: &State, control: Control) -> Load {
        let met = self.met(x);
        let Force { lift, drag, thrust, couple } = self.air.force(&met, control);
        let arm = self.air.arm();
        if self.directions == Directions::Plane {
            let (sin, cos) = (met.alpha.sin(), met.alpha.cos());
            let up = lift * cos + drag * sin;
            let forward = thrust + lift * sin - drag * cos;
            return Load { forward, up, nose_up: couple + up * arm, unfelt: [real(0.0); 2] };
        }
        let [u, v] = self.velocity(x);
        let axis = x[3] - atan(v / u);
        let alpha = axis + self.mean_pitch(x);
        let (sin, cos) = (alpha.sin(), alpha.cos());
        let [along, across] = [thrust * cos - drag, lift + thrust * sin];
        let nose_up = couple + (lift * cos + drag * sin) * arm;
        let (sin, cos) = (axis.sin(), axis.cos());
        let up = across * cos - along * sin;
        Load {
            forward: along * cos + across * sin,
            up,
            nose_up,
            unfelt: [up - across, nose_up - couple - lift * arm],
        }
    }

    /// Terms of second order in q, and in displacements and rates of the masses, are left out: in steady
    /// flight all of them are 0.
    fn rates(&self, x: &State, control: &Control) -> State {
        let Books { total, liquids, .. } = &self.books;
        let load = self.load(x, *control);
        let lever = match self.directions {
            Directions::Equations => 0.0,
            Directions::Plane => 1.0,
        };
        // Unknown: acceleration of P less the field, along and across the body; q'; s_j''.
        let mut matrix = SMatrix::<C, 5, 5>::zeros();
        let mut right = SVector::<C, 5>::zeros();
        (matrix[(0, 0)], matrix[(1, 1)]) = (real(total.mass), real(total.mass));
        matrix[(2, 2)] = real(total.inertia);
        (right[0], right[1], right[2]) = (load.forward, load.up, load.nose_up);
        let [force, moment] = load.unfelt;
        for (j, liquid) in liquids.iter().enumerate() {
            let (mass, arm) = (liquid.sloshing, liquid.station - total.centre);
            let [s, s_dot] = [x[5 + 2 * j], x[6 + 2 * j]];
            let row = 3 + j;
            for (a, b, entry) in
                [(0, 2, -s * mass * lever), (1, row, real(mass)), (2, row, real(-mass * arm))]
            {
                matrix[(a, b)] += entry;
                matrix[(b, a)] += entry;
            }
            matrix[(row, row)] = real(mass);
            let unfelt = force / total.mass - moment * arm / total.inertia;
            right[row] = (unfelt + self.floor) * mass - s * liquid.spring - s_dot * liquid.damper;
        }
        let solution = matrix.lu().solve(&right).expect("a mass matrix");
        let [along, across] = self.field(x);
        let (along, across) = (solution[0] + along, solution[1] + across);
        let (sin, cos) = (x[3].sin(), x[3].cos());
        let [u, v] = [along * cos - across * sin, along * sin + across * cos];
        [u, v, x[1], x[4], solution[2], x[6], solution[3], x[8], solution[4]]
    }

    /// V of the mass centre of all, and gamma of it or of a station.
    fn seen(&self, x: &State, station: Option<f64>) -> [C; 2] {
        let [u, v] = self.velocity(x);
        let speed = (u * u + v * v).sqrt();
        match station {
            None => [speed, atan(v / u)],
            Some(station) => {
                let turn = x[4] * (station - self.books.total.centre);
                [speed, atan((x[1] - turn * x[3].cos()) / (x[0] + turn * x[3].sin()))]
            }
        }
    }

    pub fn linear(&self, station: Option<f64>) -> LinearModel {
        let state = self.state(real(self.steady.alpha));
        let control = self.steady.control.map(real);
        let mut linear = LinearModel {
            a: DMatrix::zeros(STATES, STATES),
            b: DMatrix::zeros(STATES, 2),
            c: DMatrix::zeros(2, STATES),
        };
        for k in 0..STATES {
            let mut moved = state;
            moved[k].im = STEP;
            for (i, rate) in self.rates(&moved, &control).iter().enumerate() {
                linear.a[(i, k)] = rate.im / STEP;
            }
            for (i, output) in self.seen(&moved, station).iter().enumerate() {
                linear.c[(i, k)] = output.im / STEP;
            }
        }
        for k in 0..2 {
            let mut moved = control;
            moved[k].im = STEP;
            for (i, rate) in self.rates(&state, &moved).iter().enumerate() {
                linear.b[(i, k)] = rate.im / STEP;
            }
        }
        linear
    }
}

impl LinearModel {
    pub fn poles(&self) -> Vec<Complex<f64>> {
        eigenvalues(self.a.clone())
    }

    /// Eigenvalues of the motion with both outputs held, `u = -(C B)^-1 C A x`: the zeros, and two at
    /// the origin, which are the outputs themselves.
    pub fn zeros(&self) -> Vec<Complex<f64>> {
        let (c_a, c_b) = (&self.c * &self.a, &self.c * &self.b);
        let held = c_b.lu().solve(&c_a).expect("the controls reach both outputs");
        eigenvalues(&self.a - &self.b * held)
    }
}

fn eigenvalues(mut matrix: DMatrix<f64>) -> Vec<Complex<f64>> {
    balancing::balance_parlett_reinsch(&mut matrix);
    matrix.complex_eigenvalues().iter().copied().collect()
}
