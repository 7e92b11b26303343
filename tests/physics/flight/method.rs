//! The exponential method on the vehicle: its coordinates against the Jacobian, its flights against
//! DOP853.

use crate::model::{AERO_SETS, CONFIGURATIONS, builds, data, distance, flight, flight_with, setup};
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::Trim;
use ahv::flight::method;
use ahv::solve::{
    Attempt, DOP853, Decoupling, Exponential, Integrator, Method, Outcome, System, Trial,
};
use ahv::structure::MODES;
use ahv::vehicle::{
    ALPHA, Configuration, Control, DELTA_E, GAMMA, GUSTS, Gust, NOMINAL, RIGID_STATES, STATES,
    State, Vehicle,
};
use proptest::prelude::*;

/// How well the coordinates go there and back, and L meets the Jacobian, in typical sizes.
const ROUNDING: f64 = 1e-9;

#[test]
fn verif_the_coordinates_decouple_every_vehicle() {
    for options in builds() {
        let flight = flight_with(|parameters| parameters.options = options);
        let (vehicle, trim) = (flight.vehicle(), flight.trim());
        let jacobian = LinearModel::new(vehicle, &trim.state, &trim.control).a;
        let slow = ALPHA;
        let decoupling =
            Decoupling::<STATES, { ALPHA }, { 2 + 2 * MODES }>::new(&jacobian, &NOMINAL);
        for j in slow..vehicle.states() {
            let mut x = [0.0; STATES];
            x[j] = NOMINAL[j];
            let there = decoupling.to_coordinates(&x);
            let mut pair = [0.0; STATES];
            pair[j - slow] = NOMINAL[j];
            assert_ne!(there, pair, "{options:?}: the coordinates are not pairs of states");
            let back = decoupling.to_states(&there);
            let moved = decoupling.to_states(&decoupling.blocks.times(&there));
            for i in 0..vehicle.states() {
                assert!((back[i] - x[i]).abs() < ROUNDING * NOMINAL[i], "{options:?}: {j} to {i}");
                let expected = jacobian[(i, j)] * NOMINAL[j];
                // A rate of 100 rad/s is usual.
                let off = (moved[i] - expected).abs() / (100.0 * NOMINAL[i]);
                assert!(off < ROUNDING, "{options:?}: L[{i}, {j}] is {}, not {expected}", moved[i]);
            }
        }
    }
}

/// A vehicle under controls that are held or move, and the air.
struct Controlled<'a> {
    vehicle: &'a Vehicle,
    control: Control,
    control_per_s: Control,
    gust: Gust,
}

impl Controlled<'_> {
    fn at(&self, t: f64) -> Control {
        std::array::from_fn(|i| self.control[i] + t * self.control_per_s[i])
    }
}

impl System<STATES> for Controlled<'_> {
    fn derivatives(&self, t: f64, x: &State) -> State {
        self.vehicle.derivatives(x, &self.at(t), self.gust)
    }
    fn holds(&self, t: f64, x: &State) -> bool {
        self.vehicle.holds(x, &self.at(t), self.gust)
    }
    fn is_autonomous(&self) -> bool {
        self.control_per_s == [0.0; 2]
    }
    fn nominal(&self) -> &State {
        &NOMINAL
    }
}

/// The state after some equal steps, or where the vehicle leaves its envelope.
fn flown(
    method: &mut impl Method<STATES>,
    system: &Controlled,
    start: &State,
    tolerance: f64,
    steps: u32,
) -> (State, Outcome) {
    let (mut integrator, mut x) = (Integrator::new(tolerance, 1e-3), *start);
    let mut slope = None;
    for step in 0..steps {
        let ends = [step, step + 1].map(|i| FLIGHT_S * f64::from(i) / f64::from(steps));
        let outcome = integrator.advance(method, system, &mut x, ends, &mut slope);
        if outcome != Outcome::Complete {
            return (x, outcome);
        }
    }
    (x, Outcome::Complete)
}

/// The method in the registers that every processor has.
struct Portable<M>(M);

impl<const N: usize, const SLOW: usize, const FAST: usize> Method<N>
    for Portable<Exponential<N, SLOW, FAST>>
{
    fn max_step(&self) -> f64 {
        self.0.max_step()
    }
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        self.0.portable(attempt)
    }
}

const FLIGHT_S: f64 = 0.4;
/// Error of a flight over its tolerance: of some tens of steps, in an unstable vehicle.
const GROWTH: f64 = 100.0;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn verif_flights_far_from_trim_are_those_of_dop853(
        configuration in 0..3_usize,
        burn in proptest::bool::weighted(0.1),
        fuel in 0.1..1.0_f64,
        disturbance in prop::array::uniform12(-4.0..4.0_f64),
        controls in [-0.1..0.1_f64, 0.0..0.5_f64],
        control_per_s in prop_oneof![Just([0.0; 2]), [-0.5..0.5_f64, -1.0..1.0_f64]],
        gust in prop_oneof![Just([0.0; GUSTS]), [-10.0..10.0_f64, -10.0..10.0_f64]],
        steps in prop_oneof![Just(1_u32), Just(4), Just(40), Just(400)],
        digits in 5..12_i32,
    ) {
        let mut parameters = setup(&[]).parameters;
        parameters.options.configuration = CONFIGURATIONS[configuration];
        parameters.options.fuel_fraction = fuel;
        parameters.options.fuel_burn = burn;
        let vehicle = Vehicle::new(&data(), &parameters.options).unwrap();
        let trim = ahv::dynamics::trim::trim(&vehicle, &parameters.options.condition).unwrap();
        let mut start = trim.state;
        for i in ALPHA..vehicle.states() {
            start[i] += disturbance[i + 2 - RIGID_STATES] * NOMINAL[i];
        }
        let control = [trim.control[DELTA_E] + controls[0], controls[1]];
        prop_assume!(vehicle.holds(&start, &control, gust));
        let system = Controlled { vehicle: &vehicle, control, control_per_s, gust };
        let tolerance = 10.0_f64.powi(-digits);
        let method = method(&vehicle, &trim);
        let ours = flown(&mut method.clone(), &system, &start, tolerance, steps);
        let portable = flown(&mut Portable(method), &system, &start, tolerance, steps);
        prop_assert_eq!(ours.0, portable.0, "wider registers change no bit");
        let exact = flown(&mut &DOP853, &system, &start, 1e-13, steps);
        // Those that leave do so at slightly different instants.
        prop_assume!(ours.1 == Outcome::Complete && exact.1 == Outcome::Complete);
        let off = distance(&ours.0, &exact.0);
        prop_assert!(off < GROWTH * tolerance, "off by {} tolerances", off / tolerance);
    }

    #[test]
    fn verif_a_flight_goes_on_bit_for_bit_in_another_instance(
        lengths in prop::collection::vec(1e-4..0.08_f64, 1..12),
        elevator in -5e-3..5e-3_f64,
    ) {
        // Functions of the step's length are kept between steps: they must not decide anything.
        let mut one = flight(Configuration::SloshBeam);
        one.set_input(DELTA_E, elevator);
        let mut time = 0.0;
        for length in lengths {
            time += length;
            let mut other = flight(Configuration::SloshBeam);
            other.rewind(&one.snapshot());
            let ends = (one.advance(time), other.advance(time));
            prop_assert_eq!(ends.0.is_ok(), ends.1.is_ok());
            prop_assert_eq!(one.snapshot(), other.snapshot());
        }
    }
}

#[test]
fn verif_what_rests_arrives_at_once_however_long_the_step() {
    // So well trimmed that the acceleration left, if any, is below the last digit of the speed.
    let mut resting = 0;
    for altitude in (0..30).map(|i| 25_000.0 + 100.0 * f64::from(i)) {
        for aero in AERO_SETS {
            let mut flight = flight_with(|parameters| {
                parameters.options.configuration = Configuration::Rigid;
                parameters.options.aero = aero;
                parameters.options.condition.altitude = altitude;
            });
            let start = *flight.state();
            resting += usize::from(flight.advance(1e300).is_ok() && *flight.state() == start);
        }
    }
    assert!(resting >= 2, "{resting}");
}

#[test]
fn verif_the_edge_of_an_atmospheric_layer_costs_no_digits() {
    // The lapse rate jumps at 32 km of geopotential altitude, 32.16 km above the ground.
    let mut parameters = setup(&[]).parameters;
    let vehicle = Vehicle::new(&data(), &parameters.options).unwrap();
    parameters.options.condition.altitude = 32_150.0;
    let mut start = parameters.options.condition.start(&vehicle.atmosphere);
    start[GAMMA] = 0.03;
    start[ALPHA] = 0.02;
    let trim = Trim { state: start, control: [0.1, 0.3] };
    let system = Controlled {
        vehicle: &vehicle,
        control: trim.control,
        control_per_s: [0.0; 2],
        gust: [0.0; GUSTS],
    };
    for steps in [1, 40] {
        let ours = flown(&mut method(&vehicle, &trim), &system, &start, 1e-8, steps).0;
        let exact = flown(&mut &DOP853, &system, &start, 1e-13, steps).0;
        assert!(exact[1] > 32_165.0, "the flight crosses the edge: {} m", exact[1]);
        let off = distance(&ours, &exact);
        assert!(off < GROWTH * 1e-8, "off by {off:e}");
    }
}
