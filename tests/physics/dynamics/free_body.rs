//! The body without air: what rings on its springs keeps momentum, angular momentum and energy, summed over
//! the nodes of a finite-element model of its own (`explicit`), with the mass centre and the inertia that
//! the coefficient set asks for.

use crate::explicit::air::speed_and_gravity;
use crate::explicit::beam::Beam;
use crate::explicit::books::Books;
use crate::explicit::extrapolation::extrapolated;
use crate::model::{AERO_SETS, assert_close, data, options};
use ahv::data::Data;
use ahv::structure::MODES;
use ahv::vehicle::{
    ALPHA, Body, Configuration, Factors, GAMMA, GUSTS, H, Q, STATES, State, V, Vehicle,
    VehicleDefinition, VehicleOptions, eta, eta_dot,
};
use nalgebra::{DMatrix, DVector};

const FUEL_FRACTIONS: [f64; 4] = [0.05, 0.25, 0.5, 1.0];
/// Aft, m.
const SHIFTS: [f64; 2] = [0.0, 0.5];
/// Of momenta and energies: sums over 500 elements, and the integrator's 1e-12 a second.
const KEPT: f64 = 1e-9;
/// Of the books.
const ROUNDING: f64 = 1e-12;
/// Of mass, mass centre and inertia between the levels at which the modes are solved.
const INTERPOLATED: f64 = 1e-8;
const DURATION_S: f64 = 1.0;
/// The fastest mode turns by one radian or less.
const STEP_S: f64 = 4e-3;
/// m and m/s, rad/s.
const ETA: [f64; MODES] = [0.3, -0.1, 0.05, 0.2, -0.15];
const ETA_DOT: [f64; MODES] = [1.0, 2.0, -3.0, 0.5, 0.4];
const PITCH_RATE: f64 = 0.03;
/// Levels to check, and the filling of the last over what cannot be drained.
const LEVELS: usize = 33;
const LAST: f64 = 0.5;

/// The library's body with the test's own.
struct Case {
    vehicle: Vehicle,
    beam: Beam,
    books: Books,
    shapes: Vec<DVector<f64>>,
    gravity: f64,
}

fn columns(body: &Body) -> Vec<DVector<f64>> {
    body.displacements().into_iter().map(DVector::from_vec).collect()
}

fn own(data: &Data, options: &VehicleOptions) -> (Books, Beam, f64) {
    let [_, gravity] = speed_and_gravity(&data.earth, &options.condition);
    let books = Books::new(&data.vehicle, data.aero(options.aero), &options.into(), gravity);
    let elements = data.vehicle.beam.elements.value as usize;
    (books, Beam::new(&data.vehicle, &books, elements, 1.0), gravity)
}

impl Case {
    /// Without air, and so without thrust.
    fn new(data: &Data, options: &VehicleOptions) -> Self {
        let mut vehicle = Vehicle::new(data, options).unwrap();
        vehicle.aero.area = 0.0;
        let (books, beam, gravity) = own(data, options);
        let shapes = columns(&Body::new(&VehicleDefinition::new(data, options)).unwrap());
        Self { vehicle, beam, books, shapes, gravity }
    }

    /// Displacement by the modal coordinates, or by their rates.
    fn sum(&self, x: &State, component: fn(usize) -> usize) -> DVector<f64> {
        let start = DVector::zeros(self.beam.unknowns());
        let shapes = self.shapes.iter().enumerate();
        shapes.fold(start, |sum, (i, shape)| sum + shape * x[component(i)])
    }

    /// Momentum across the body and angular momentum against the mass centre, nose down, kg m/s and
    /// kg m^2/s, and energy, J, all per metre of width; then what the numbers are small against.
    fn kept(&self, x: &State) -> [[f64; 2]; 3] {
        let (beam, total) = (&self.beam, self.books.total);
        let u = self.sum(x, eta);
        let v = self.sum(x, eta_dot) + beam.rigid(0.0, -x[Q], total.centre);
        let momenta = beam.mass_times(&v);
        let kinetic = 0.5 * v.dot(&momenta);
        let [up, turn] = [[1.0, 0.0], [0.0, 1.0]]
            .map(|[w, slope]| beam.rigid(w, slope, total.centre).dot(&momenta));
        // The floors push the liquid up with its weight.
        let weights = [0, 1]
            .map(|tank| beam.liquids[tank].sloshing * self.gravity * beam.stretch(tank).dot(&u));
        let energy = kinetic + beam.strain_energy(&u) - weights[0] - weights[1];
        [
            [up, (2.0 * energy * total.mass).sqrt()],
            [turn, (2.0 * energy * total.inertia).sqrt()],
            [energy, energy],
        ]
    }

    /// Angular momentum about the earth's centre and energy of the flight, per mass.
    fn orbit(&self, data: &Data, x: &State) -> [f64; 2] {
        let earth = &data.earth.earth;
        let distance = earth.radius_m.value + x[H];
        let potential = -earth.gravity_m_per_s2.value * earth.radius_m.value.powi(2) / distance;
        [distance * x[V] * x[GAMMA].cos(), 0.5 * x[V] * x[V] + potential]
    }

    fn start(&self, options: &VehicleOptions) -> State {
        let mut x = options.condition.start(&self.vehicle.atmosphere);
        (x[GAMMA], x[ALPHA], x[Q]) = (0.01, 0.02, PITCH_RATE);
        x[STATES - 1] = self.vehicle.fuel;
        for i in 0..MODES {
            (x[eta(i)], x[eta_dot(i)]) = (ETA[i], ETA_DOT[i]);
        }
        x
    }

    /// What the dampers of the tanks take, W/m.
    fn taken(&self, relative: &[[f64; MODES]; 2], x: &State) -> f64 {
        let tanks = relative.iter().zip(&self.beam.liquids);
        let power = tanks.map(|(relative, liquid)| {
            let rate: f64 = (0..MODES).map(|i| relative[i] * x[eta_dot(i)]).sum();
            liquid.damper * rate * rate
        });
        power.sum()
    }

    /// Flies for a while and gives the state and the work of the dampers at the end of each step.
    fn fly(&self, start: State) -> Vec<(State, f64)> {
        let relative = [0, 1].map(|tank| {
            let stretch = self.beam.stretch(tank);
            std::array::from_fn(|i| stretch.dot(&self.shapes[i]))
        });
        let rates = |x: &[f64; STATES + 1]| {
            let state: State = std::array::from_fn(|i| x[i]);
            let rates = self.vehicle.derivatives(&state, &[0.0; 2], [0.0; GUSTS]);
            std::array::from_fn(
                |i| if i < STATES { rates[i] } else { self.taken(&relative, &state) },
            )
        };
        let mut x: [f64; STATES + 1] =
            std::array::from_fn(|i| if i < STATES { start[i] } else { 0.0 });
        let steps = (DURATION_S / STEP_S).round() as usize;
        let flight = (0..steps).map(|_| {
            x = extrapolated(&x, STEP_S, rates);
            (std::array::from_fn(|i| x[i]), x[STATES])
        });
        flight.collect()
    }
}

fn builds(slosh_damping: f64) -> Vec<VehicleOptions> {
    let mut builds = Vec::new();
    for aero in AERO_SETS {
        for fuel_fraction in FUEL_FRACTIONS {
            for mass_centre_shift_m in SHIFTS {
                let none = Factors { structural_damping: 0.0, ..Factors::default() };
                let factors = Factors { mass_centre_shift_m, ..none };
                let options = options(Configuration::SloshBeam);
                builds.push(VehicleOptions {
                    aero,
                    fuel_fraction,
                    slosh_damping,
                    factors,
                    ..options
                });
            }
        }
    }
    builds
}

/// Momentum and angular momentum of shapes, over what they are at the same energy.
fn assert_no_momentum(beam: &Beam, books: &Books, shapes: &[DVector<f64>], name: &str) {
    for shape in shapes {
        let momenta = beam.mass_times(shape);
        let modal_mass = shape.dot(&momenta);
        let total = &books.total;
        for (field, size) in [([1.0, 0.0], total.mass), ([0.0, 1.0], total.inertia)] {
            let momentum = beam.rigid(field[0], field[1], total.centre).dot(&momenta);
            let part = momentum / (modal_mass * size).sqrt();
            assert!(part.abs() < KEPT, "{name}: {field:?} {part:.1e}");
        }
    }
}

#[test]
fn verif_no_mode_has_a_momentum() {
    let data = data();
    for options in builds(0.05) {
        let Case { vehicle, beam, books, shapes, .. } = Case::new(&data, &options);
        let name = format!("{options:?}");
        assert_no_momentum(&beam, &books, &shapes, &name);
        for (i, shape) in shapes.iter().enumerate() {
            let square = 2.0 * beam.strain_energy(shape) / shape.dot(&beam.mass_times(shape));
            assert_close(&name, square, vehicle.omega[i].powi(2), KEPT);
        }
    }
}

#[test]
fn verif_a_free_body_rings_and_keeps_momenta_and_energy() {
    let data = data();
    for options in builds(0.0) {
        let case = Case::new(&data, &options);
        let start = case.start(&options);
        let (first, orbit) = (case.kept(&start), case.orbit(&data, &start));
        assert!(first[0][0].abs() < KEPT * first[0][1], "{first:?}");
        assert_close("turn", first[1][0], -case.books.total.inertia * PITCH_RATE, KEPT);
        for (x, _) in case.fly(start).iter().step_by(10) {
            for ([then, size], [now, _]) in first.into_iter().zip(case.kept(x)) {
                let off = (now - then) / size;
                assert!(off.abs() < KEPT, "{options:?}: {then} became {now}, {off:.1e}");
            }
            for (then, now) in orbit.into_iter().zip(case.orbit(&data, x)) {
                assert_close("flight", now, then, KEPT);
            }
        }
    }
}

#[test]
fn verif_energy_falls_by_what_the_dampers_take() {
    let data = data();
    for options in builds(0.05) {
        let case = Case::new(&data, &options);
        let start = case.start(&options);
        let first = case.kept(&start);
        let flight = case.fly(start);
        for (x, work) in flight.iter().step_by(10) {
            let now = case.kept(x);
            let off = (now[2][0] + work - first[2][0]) / first[2][0];
            assert!(off.abs() < KEPT, "{options:?}: {off:.1e}");
            for k in 0..2 {
                let off = (now[k][0] - first[k][0]) / first[k][1];
                assert!(off.abs() < KEPT, "{options:?}: {off:.1e}");
            }
        }
        let work = flight[flight.len() - 1].1;
        assert!(work > 1e-3 * first[2][0], "{options:?}: {work}");
    }
}

#[test]
fn verif_every_level_of_a_burn_is_the_vehicle_of_its_fuel() {
    let data = data();
    let residual = data.vehicle.mass.residual_fraction.value;
    for options in builds(0.05).into_iter().filter(|options| options.fuel_fraction == 1.0) {
        let options = VehicleOptions { fuel_burn: true, ..options };
        let vehicle = Vehicle::new(&data, &options).unwrap();
        let burn = vehicle.fuel_table.as_ref().unwrap();
        let definition = VehicleDefinition::new(&data, &options);
        let full = Body::new(&definition).unwrap();
        for level in 0..LEVELS {
            let part = level as f64 / (LEVELS - 1) as f64;
            let root = 1.0 - part * (1.0 - (LAST * residual).sqrt());
            let fuel_fraction = (root * root - residual) / (1.0 - residual);
            let at = VehicleOptions { fuel_fraction, fuel_burn: false, ..options };
            let name = format!("level {level} of {options:?}");

            let direct = Vehicle::new(&data, &at).unwrap();
            let (books, beam, _) = own(&data, &at);
            let level = definition.at(fuel_fraction);
            let turned = Body::aligned(&level, &full).unwrap();
            assert_no_momentum(&beam, &books, &columns(&turned), &name);
            let airframe = turned.airframe(&level).unwrap();
            let between = burn.airframe(vehicle.fuel * fuel_fraction);
            for (airframe, tolerance) in [(&airframe, ROUNDING), (&between, INTERPOLATED)] {
                assert_close(&name, airframe.mass, books.total.mass, tolerance);
                assert_close(&name, airframe.mass_centre, books.total.centre, tolerance);
                assert_close(&name, airframe.inertia, books.total.inertia, tolerance);
            }
            let stiffness = DMatrix::from_fn(MODES, MODES, |i, k| airframe.stiffness[i][k]);
            let mut squares: Vec<f64> =
                stiffness.complex_eigenvalues().iter().map(|value| value.re).collect();
            let mut expected = direct.omega.map(|omega| omega * omega);
            squares.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (square, expected) in squares.into_iter().zip(expected) {
                assert_close(&name, square, expected, KEPT);
            }
        }
    }
}

#[test]
fn verif_a_beam_without_liquid_keeps_its_modes() {
    let data = data();
    let plain = options(Configuration::EvenMassBeam);
    let modes = Vehicle::new(&data, &plain).unwrap().omega;
    for (mass_centre_shift_m, inertia) in [(0.5, 1.0), (-0.5, 3.0), (0.0, 0.2)] {
        let factors = Factors { mass_centre_shift_m, inertia, ..Factors::default() };
        let vehicle = Vehicle::new(&data, &VehicleOptions { factors, ..plain }).unwrap();
        for (got, expected) in vehicle.omega.into_iter().zip(modes).take(vehicle.modes) {
            assert_close("frequency", got, expected, KEPT);
        }
    }
}
