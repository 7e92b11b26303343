//! The modes against theory, and against the same matrices in double-double arithmetic.

use super::reference::{Dd, Reference, displacement, dot, exact, tanked, uniform, vehicle};
use ahv::error::Error;
use ahv::structure::{Beam, FLEXIBLE, MODES, Modes, Oscillator};
use proptest::prelude::*;

/// Heave and pitch, which the reference counts among the eigenvalues.
const RIGID: usize = 2;
/// Relative error of a frequency. Promised are 1e-9; rounding is 1e-15.
const FREQUENCY: f64 = 1e-12;
/// Error of a shape over its largest entry, times the relative gap to the next frequency: rounding
/// turns neighbours into each other by its size over their gap.
const SHAPE: f64 = 1e-13;
/// Products of shapes with 1000 entries.
const ORTHOGONAL: f64 = 1e-12;
/// Where the promise itself is put to the test: double frequencies, wild beams.
const PROMISE: f64 = 1e-9;

fn solve(beam: &Beam, oscillators: &[Oscillator]) -> Modes {
    Modes::solve(beam, oscillators).unwrap()
}

/// Every configuration of the vehicle that must work: fillings and sloshing frequencies, rad/s, 0
/// for the tank's own; 25.3 falls on the first flexible mode.
pub(super) fn configurations() -> Vec<(Beam, Vec<Oscillator>)> {
    let mut all =
        vec![(Beam::even(&vehicle(), 1.0), vec![]), (Beam::even(&vehicle(), 0.0), vec![])];
    for fuel in [0.0, 0.5, 1.0] {
        for frequency in [0.0, 0.2, 5.0, 25.3, 100.0] {
            let (beam, oscillators) = tanked(fuel, frequency);
            all.push((beam, oscillators.to_vec()));
        }
    }
    let (beam, mut oscillators) = tanked(1.0, 3.0);
    for oscillator in &mut oscillators {
        oscillator.mass *= 1e-3;
        oscillator.stiffness *= 1e-3;
    }
    all.push((beam, oscillators.to_vec()));
    all
}

/// Sylvester's law of inertia: exactly `RIGID + i` eigenvalues lie below the i-th frequency. That
/// proves both its value and that no mode before it was missed.
fn misplaced(beam: &Beam, oscillators: &[Oscillator], modes: &Modes, tolerance: f64) -> Vec<f64> {
    let reference = Reference { beam, oscillators };
    let mut sorted = modes.omega_rad_per_s[..modes.count].to_vec();
    sorted.sort_by(f64::total_cmp);
    let wrong = |&(i, omega): &(usize, f64)| {
        let below = |factor: f64| {
            let edge = exact(omega) * factor;
            reference.count_below(edge * edge)
        };
        below(1.0 - tolerance) > RIGID + i || below(1.0 + tolerance) < RIGID + i + 1
    };
    sorted.into_iter().enumerate().filter(wrong).map(|(_, omega)| omega).collect()
}

#[test]
fn verif_frequencies_are_right_and_none_is_missed() {
    for (beam, oscillators) in configurations() {
        let modes = solve(&beam, &oscillators);
        assert_eq!(modes.count, FLEXIBLE + oscillators.len());
        let wrong = misplaced(&beam, &oscillators, &modes, FREQUENCY);
        assert!(wrong.is_empty(), "{wrong:?} of {:?}", modes.omega_rad_per_s);
    }
}

#[test]
fn verif_shapes_are_those_of_inverse_iteration_in_double_double() {
    for (beam, oscillators) in configurations() {
        let modes = solve(&beam, &oscillators);
        let reference = Reference { beam: &beam, oscillators: &oscillators };
        for i in 0..modes.count {
            let u = displacement(&modes, &oscillators, i);
            let (_, truth) = reference.refine(modes.omega_rad_per_s[i].powi(2), &u);
            let (_, momenta) = reference.products(&truth);
            let lifted: Vec<Dd> = u.iter().map(|u| exact(*u)).collect();
            let scale = dot(&lifted, &momenta) / dot(&truth, &momenta);
            let largest = u.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
            let error = u
                .iter()
                .zip(&truth)
                .fold(0.0, |m: f64, (u, t)| m.max(f64::from(*t * scale - *u).abs()));
            let distance =
                |k: usize| (modes.omega_rad_per_s[k] / modes.omega_rad_per_s[i] - 1.0).abs();
            let gap = (0..modes.count).filter(|k| *k != i).map(distance).fold(1.0, f64::min);
            assert!(
                error * gap <= SHAPE * largest,
                "{:e} in mode {i}, gap {gap:e}",
                error / largest
            );
        }
    }
}

#[test]
fn verif_modes_are_orthogonal_in_mass_and_stiffness() {
    for (beam, oscillators) in configurations() {
        let modes = solve(&beam, &oscillators);
        let reference = Reference { beam: &beam, oscillators: &oscillators };
        let shapes: Vec<Vec<Dd>> = (0..modes.count)
            .map(|i| displacement(&modes, &oscillators, i).into_iter().map(exact).collect())
            .collect();
        for (i, a) in shapes.iter().enumerate() {
            let (forces, momenta) = reference.products(a);
            let (mass, omega) = (modes.modal_mass[i], modes.omega_rad_per_s[i]);
            assert!((dot(a, &momenta).hi / mass - 1.0).abs() < ORTHOGONAL);
            assert!((dot(a, &forces).hi / (mass * omega * omega) - 1.0).abs() < ORTHOGONAL);
            for (k, b) in shapes[..i].iter().enumerate() {
                let scale = (mass * modes.modal_mass[k]).sqrt();
                assert!(dot(b, &momenta).hi.abs() < ORTHOGONAL * scale);
                // Against the faster of the two: rounding in it is worth that much energy.
                let energy = scale * omega.max(modes.omega_rad_per_s[k]).powi(2);
                assert!(dot(b, &forces).hi.abs() < ORTHOGONAL * energy);
            }
        }
    }
}

/// No mode carries momentum or angular momentum: eq. (3) keeps these to itself.
#[test]
fn verif_modes_have_no_momentum() {
    for (beam, oscillators) in configurations() {
        let modes = solve(&beam, &oscillators);
        let reference = Reference { beam: &beam, oscillators: &oscillators };
        let stations = (0..=beam.elements()).map(|i| beam.station(i));
        let heave =
            stations.clone().flat_map(|_| [1.0, 0.0]).chain(oscillators.iter().map(|_| 1.0));
        let pitch =
            stations.flat_map(|x| [x, 1.0]).chain(oscillators.iter().map(|o| beam.station(o.node)));
        let mass = beam.mass_properties(&oscillators).mass;
        for (rigid, arm) in
            [(heave.collect::<Vec<_>>(), 1.0), (pitch.collect::<Vec<_>>(), beam.length_m())]
        {
            let rigid: Vec<Dd> = rigid.into_iter().map(exact).collect();
            let (_, momenta) = reference.products(&rigid);
            for i in 0..modes.count {
                let u: Vec<Dd> =
                    displacement(&modes, &oscillators, i).into_iter().map(exact).collect();
                let size = arm * (mass * modes.modal_mass[i]).sqrt();
                assert!(dot(&u, &momenta).hi.abs() < ORTHOGONAL * size);
            }
        }
    }
}

#[test]
fn verif_scaling_and_order_are_the_agreed_ones() {
    for (beam, oscillators) in configurations() {
        let modes = solve(&beam, &oscillators);
        let omega = modes.omega_rad_per_s;
        assert!(omega[..FLEXIBLE].is_sorted() && omega[0] > 0.0);
        assert!(omega[FLEXIBLE..modes.count].is_sorted());
        for shape in &modes.shape[..FLEXIBLE] {
            assert!((shape.w[0] - 1.0).abs() < 1e-15);
        }
        for i in FLEXIBLE..modes.count {
            let [fore, aft] = modes.slosh_displacement.map(|row| row[i]);
            assert!((fore.max(aft) - 1.0).abs() < 1e-15 && fore.min(aft) >= -1.0);
        }
        let share = |i: usize| -> f64 {
            let u = displacement(&modes, &oscillators, i);
            let masses = oscillators.iter().zip(&u[beam.unknowns()..]);
            masses.map(|(o, w)| o.mass * w * w).sum::<f64>() / modes.modal_mass[i]
        };
        for (slosh, flexible) in
            (FLEXIBLE..modes.count).flat_map(|s| (0..FLEXIBLE).map(move |f| (s, f)))
        {
            assert!(share(slosh) >= share(flexible));
        }
    }
}

/// A symmetric beam with equal tanks; `tip` is the density of its outer elements.
fn symmetric(tip: f64) -> (Beam, [Oscillator; 2]) {
    let mut beam = uniform(60, 30.0, 2e8, 300.0);
    for outer in [0..10, 50..60] {
        beam.density[outer].fill(tip);
    }
    (beam, [15, 45].map(|node| Oscillator { node, mass: 800.0, stiffness: 2e4, damping: 0.0 }))
}

#[test]
fn verif_equal_tanks_slosh_in_step_and_in_turn() {
    let (beam, oscillators) = symmetric(300.0);
    let modes = solve(&beam, &oscillators);
    assert!(misplaced(&beam, &oscillators, &modes, FREQUENCY).is_empty());
    for i in FLEXIBLE..MODES {
        let [fore, aft] = modes.slosh_displacement.map(|row| row[i].abs());
        assert!((fore - aft).abs() < ORTHOGONAL, "{fore} and {aft}");
    }
}

/// Heavier tips slow the tanks sloshing in turn more than in step: in between both frequencies
/// are one, and two modes must still be found.
#[test]
fn verif_a_double_frequency_keeps_two_modes() {
    let gap = |tip: f64| {
        let (beam, oscillators) = symmetric(tip);
        let modes = solve(&beam, &oscillators);
        let in_turn = |i: usize| {
            let [fore, aft] = modes.slosh_displacement.map(|row| row[i]);
            fore * aft < 0.0
        };
        let [slow, fast] = [modes.omega_rad_per_s[FLEXIBLE], modes.omega_rad_per_s[FLEXIBLE + 1]];
        (fast / slow - 1.0) * if in_turn(FLEXIBLE) { -1.0 } else { 1.0 }
    };
    let (mut light, mut heavy) = (1.0, 3000.0);
    assert!(gap(light) * gap(heavy) < 0.0, "{} {}", gap(light), gap(heavy));
    let sign = gap(light).signum();
    while heavy - light > 1e-13 * heavy {
        let middle = 0.5 * (light + heavy);
        if gap(middle) * sign > 0.0 {
            light = middle
        } else {
            heavy = middle
        }
        if middle == light && middle == heavy || gap(middle).abs() < 1e-14 {
            break;
        }
    }
    let (beam, oscillators) = symmetric(0.5 * (light + heavy));
    assert!(gap(0.5 * (light + heavy)).abs() < 1e-12);
    let modes = solve(&beam, &oscillators);
    assert!(misplaced(&beam, &oscillators, &modes, FREQUENCY).is_empty());
    let [a, b] = [FLEXIBLE, FLEXIBLE + 1]
        .map(|i| displacement(&modes, &oscillators, i).into_iter().map(exact).collect::<Vec<Dd>>());
    let (_, momenta) = Reference { beam: &beam, oscillators: &oscillators }.products(&a);
    assert!(dot(&b, &momenta).hi.abs() < ORTHOGONAL * modes.modal_mass[FLEXIBLE]);
}

#[test]
fn verif_senseless_beams_are_refused() {
    let mut beam = uniform(20, 10.0, 1e6, 10.0);
    beam.density[3] = f64::NAN;
    assert!(matches!(Modes::solve(&beam, &[]), Err(Error::Modes { .. })));
    // Four unknowns, two of them rigid: two modes at most.
    let single = uniform(1, 1.0, 1.0, 1.0);
    assert_eq!(Modes::solve(&single, &[]), Err(Error::Modes { count: 3, found: 2 }));
}

/// Oscillators in a beam of 24 elements: node, log10 of mass and frequency.
fn oscillator() -> impl Strategy<Value = Oscillator> {
    (0..25_usize, -1.0..3.5_f64, -0.7..2.0_f64).prop_map(|(node, mass, frequency)| {
        let (mass, omega) = (10_f64.powf(mass), 10_f64.powf(frequency));
        Oscillator { node, mass, stiffness: mass * omega * omega, damping: 0.0 }
    })
}

proptest! {
    #[test]
    fn verif_any_beam_with_any_tanks_shows_all_its_modes(
        log_stiffness in prop::collection::vec(6.0..9.5_f64, 24),
        density in prop::collection::vec(50.0..1000.0_f64, 24),
        first in oscillator(),
        second in oscillator(),
        equal in prop::bool::ANY,
    ) {
        let mut beam = uniform(24, 30.0, 1.0, 1.0);
        beam.stiffness = log_stiffness.into_iter().map(|log| 10_f64.powf(log)).collect();
        beam.density = density;
        let second = if equal { Oscillator { node: second.node, ..first } } else { second };
        let oscillators = [first, second];
        let modes = solve(&beam, &oscillators);
        prop_assert!(modes.omega_rad_per_s.iter().all(|omega| *omega > 0.0));
        let wrong = misplaced(&beam, &oscillators, &modes, PROMISE);
        prop_assert!(wrong.is_empty(), "{wrong:?} of {:?}", modes.omega_rad_per_s);
    }
}
