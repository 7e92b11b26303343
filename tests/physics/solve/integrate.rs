//! The integrator on problems with known answers.

use ahv::solve::{Attempt, DOP853, Integrator, Method, Outcome, System, Trial};
use proptest::prelude::*;
use std::cell::Cell;

/// x' = v, v' = -omega^2 x; x(0) = 1: a mode of the vehicle alone.
struct Oscillator {
    omega: f64,
    floor: f64,
    calls: Cell<usize>,
}

impl System<2> for Oscillator {
    fn derivatives(&self, _: f64, x: &[f64; 2]) -> [f64; 2] {
        self.calls.set(self.calls.get() + 1);
        [x[1], -self.omega * self.omega * x[0]]
    }
    fn holds(&self, _: f64, x: &[f64; 2]) -> bool {
        x[0] >= self.floor
    }
    fn nominal(&self) -> &[f64; 2] {
        &[1.0, 1.0]
    }
    fn is_autonomous(&self) -> bool {
        true
    }
}

fn oscillator(omega: f64, floor: f64) -> Oscillator {
    Oscillator { omega, floor, calls: Cell::new(0) }
}

/// x' = cos t: does the method look at the time?
struct Clock;

impl System<1> for Clock {
    fn derivatives(&self, t: f64, _: &[f64; 1]) -> [f64; 1] {
        [t.cos()]
    }
    fn holds(&self, _: f64, _: &[f64; 1]) -> bool {
        true
    }
    fn nominal(&self) -> &[f64; 1] {
        &[1.0]
    }
}

fn swing(system: &Oscillator, tolerance: f64, ends: &[f64]) -> [f64; 2] {
    let (mut integrator, mut x, mut t) = (Integrator::new(tolerance, 1e-3), [1.0, 0.0], 0.0);
    for &end in ends {
        let outcome = integrator.advance(&mut &DOP853, system, &mut x, [t, end], &mut None);
        assert_eq!(outcome, Outcome::Complete);
        t = end;
    }
    x
}

#[test]
fn verif_the_tableau_meets_the_order_conditions_of_quadrature() {
    // sum b c^k = 1/(k+1) up to order 8, row sums of a are c, error weights sum to zero.
    for k in 0..8 {
        let sum: f64 = (0..12).map(|i| DOP853.b[i] * DOP853.c[i].powi(k)).sum();
        assert!((sum - 1.0 / f64::from(k + 1)).abs() < 1e-14, "order {}", k + 1);
    }
    for i in 0..12 {
        let sum: f64 = DOP853.a[i].iter().sum();
        assert!((sum - DOP853.c[i]).abs() < 1e-13, "row {i}");
        assert!(DOP853.a[i][i..].iter().all(|&a| a == 0.0), "row {i} is not explicit");
    }
    for weights in [DOP853.error, DOP853.error_low] {
        assert!(weights.iter().sum::<f64>().abs() < 1e-14);
    }
}

#[test]
fn verif_the_method_converges_with_order_eight() {
    // Steps forced by the interval: a huge tolerance accepts all of them.
    let error = |steps: usize| {
        let ends: Vec<f64> = (1..=steps).map(|i| i as f64 / steps as f64).collect();
        let system = oscillator(6.0, f64::NEG_INFINITY);
        let (mut integrator, mut x, mut t) = (Integrator::new(1e9, 1.0), [1.0, 0.0], 0.0);
        for end in ends {
            integrator.advance(&mut &DOP853, &system, &mut x, [t, end], &mut None);
            t = end;
        }
        (x[0] - 6.0_f64.cos()).abs()
    };
    let order = (error(8) / error(16)).log2();
    assert!((7.5..9.0).contains(&order), "order {order}");
}

#[test]
fn verif_the_error_follows_the_tolerance() {
    for omega in [1.0, 20.0, 110.0] {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let x = swing(&oscillator(omega, f64::NEG_INFINITY), tolerance, &[1.0]);
            // Error per step times some hundred steps and the size of v = omega x.
            assert!(
                (x[0] - omega.cos()).abs() < 200.0 * tolerance,
                "omega {omega}, tolerance {tolerance}: {}",
                x[0] - omega.cos()
            );
        }
    }
}

#[test]
fn verif_time_reaches_the_right_hand_side() {
    let (mut integrator, mut x) = (Integrator::new(1e-12, 0.1), [0.0]);
    integrator.advance(&mut &DOP853, &Clock, &mut x, [0.5, 2.0], &mut None);
    assert!((x[0] - (2.0_f64.sin() - 0.5_f64.sin())).abs() < 1e-11);
}

#[test]
fn verif_known_slopes_are_not_computed_again() {
    let system = oscillator(1.0, f64::NEG_INFINITY);
    let (mut integrator, mut x, mut slope) = (Integrator::new(1e-6, 1.0), [1.0, 0.0], None);
    integrator.advance(&mut &DOP853, &system, &mut x, [0.0, 0.01], &mut slope);
    assert_eq!(system.calls.get(), 12);
    integrator.advance(&mut &DOP853, &system, &mut x, [0.01, 0.02], &mut slope);
    assert_eq!(system.calls.get(), 24);
    slope = Some(system.derivatives(0.02, &x));
    integrator.advance(&mut &DOP853, &system, &mut x, [0.02, 0.03], &mut slope);
    assert_eq!(system.calls.get(), 25 + 11);
}

/// DOP853 in steps of a second at most.
struct Short;

impl<const N: usize> Method<N> for Short {
    fn max_step(&self) -> f64 {
        1.0
    }
    fn trial<S: System<N>>(&mut self, attempt: &Attempt<S, N>) -> Trial<N> {
        (&DOP853).trial(attempt)
    }
}

#[test]
fn verif_what_rests_arrives_at_once_however_long_the_interval() {
    let mut integrator = Integrator::new(1e-8, 1e-3);
    let (mut rest, ends) = ([0.0; 2], [0.0, 1e6]);
    let system = oscillator(3.0, -1.0);
    let outcome = integrator.advance(&mut Short, &system, &mut rest, ends, &mut None);
    assert_eq!((outcome, rest), (Outcome::Complete, [0.0; 2]));
    assert!(system.calls.get() < 100, "{}", system.calls.get());

    /// x' = t - 20 after 20 s: at rest in the beginning only.
    struct Push;
    impl System<1> for Push {
        fn derivatives(&self, t: f64, _: &[f64; 1]) -> [f64; 1] {
            [(t - 20.0).max(0.0)]
        }
        fn holds(&self, _: f64, _: &[f64; 1]) -> bool {
            true
        }
        fn nominal(&self) -> &[f64; 1] {
            &[1.0]
        }
    }
    let mut x = [0.0];
    integrator.advance(&mut Short, &Push, &mut x, [0.0, 22.0], &mut None);
    assert!((x[0] - 2.0).abs() < 1e-7, "{x:?}");
}

#[test]
fn verif_leaving_is_located() {
    // cos t crosses 1/2 at pi/3.
    for proposal in [1e-3, 0.3, 10.0] {
        let system = oscillator(1.0, 0.5);
        let (mut integrator, mut x) = (Integrator::new(1e-10, proposal), [1.0, 0.0]);
        let outcome = integrator.advance(&mut &DOP853, &system, &mut x, [0.0, 5.0], &mut None);
        let Outcome::Invalid(t) = outcome else { panic!("{outcome:?}") };
        assert!((t - std::f64::consts::FRAC_PI_3).abs() < 2e-9, "left at {t}");
        assert!(x[0] >= 0.5);
    }
}

#[test]
fn verif_a_model_that_ceases_to_hold_at_the_very_end_is_left_before_it() {
    /// x' = 1, for less than a second.
    struct Closing;
    impl System<1> for Closing {
        fn derivatives(&self, _: f64, _: &[f64; 1]) -> [f64; 1] {
            [1.0]
        }
        fn holds(&self, t: f64, _: &[f64; 1]) -> bool {
            t < 1.0
        }
        fn nominal(&self) -> &[f64; 1] {
            &[1.0]
        }
    }
    // Steps whose sum is a second without rounding.
    for proposal in [0.25, 1.0, 10.0] {
        let (mut integrator, mut x) = (Integrator::new(1e-8, proposal), [0.0]);
        let outcome = integrator.advance(&mut &DOP853, &Closing, &mut x, [0.0, 1.0], &mut None);
        let Outcome::Invalid(t) = outcome else { panic!("{proposal}: {outcome:?}") };
        assert!(t < 1.0 && 1.0 - t < 2e-9 && (x[0] - t).abs() < 1e-14, "{proposal}: {t}, {x:?}");
    }
}

#[test]
fn verif_an_interval_shorter_than_the_shortest_step_is_one_step() {
    let (mut integrator, mut x) = (Integrator::new(1e-8, 1e-3), [0.0]);
    let outcome = integrator.advance(&mut &DOP853, &Clock, &mut x, [0.0, 1e-14], &mut None);
    assert_eq!(outcome, Outcome::Complete);
    assert!((x[0] - 1e-14).abs() < 1e-28, "{x:?}");
}

#[test]
fn verif_an_infinite_right_hand_side_is_reported() {
    struct Wall;
    impl System<1> for Wall {
        fn derivatives(&self, t: f64, _: &[f64; 1]) -> [f64; 1] {
            [if t > 0.25 { f64::NAN } else { 1.0 }]
        }
        fn holds(&self, _: f64, _: &[f64; 1]) -> bool {
            true
        }
        fn nominal(&self) -> &[f64; 1] {
            &[1.0]
        }
    }
    let (mut integrator, mut x) = (Integrator::new(1e-8, 0.1), [0.0]);
    let outcome = integrator.advance(&mut &DOP853, &Wall, &mut x, [0.0, 1.0], &mut None);
    let Outcome::StepTooSmall(t) = outcome else { panic!("{outcome:?}") };
    assert!((t - 0.25).abs() < 1e-6 && (x[0] - t).abs() < 1e-9);
}

#[test]
fn verif_an_interval_without_end_is_given_back_at_the_instant_reached() {
    /// An oscillator of 1 rad/s, which never rests and never leaves.
    struct Swing;
    impl System<2> for Swing {
        fn derivatives(&self, _: f64, x: &[f64; 2]) -> [f64; 2] {
            [x[1], -x[0]]
        }
        fn holds(&self, _: f64, _: &[f64; 2]) -> bool {
            true
        }
        fn nominal(&self) -> &[f64; 2] {
            &[1.0, 1.0]
        }
    }
    let (mut integrator, mut x) = (Integrator::new(1e-5, 0.1), [1.0, 0.0]);
    let outcome = integrator.advance(&mut &DOP853, &Swing, &mut x, [0.0, 1e300], &mut None);
    let Outcome::TooManySteps(t) = outcome else { panic!("{outcome:?}") };
    // More than a tenth of a radian a step, and still on its circle but for the tolerance.
    assert!(t > 1e5 && x[0].hypot(x[1]) < 1.5, "{t}, {x:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn verif_intervals_end_exactly_and_splits_do_not_matter(
        cuts in prop::collection::vec(1e-6..1.0_f64, 1..30),
    ) {
        let mut ends = cuts;
        ends.push(1.0);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let x = swing(&oscillator(20.0, f64::NEG_INFINITY), 1e-8, &ends);
        prop_assert!((x[0] - 20.0_f64.cos()).abs() < 1e-6);
    }
}
