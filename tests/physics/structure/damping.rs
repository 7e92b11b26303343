//! Where the modes' energy is, and what damping takes of it.

use super::reference::{Dd, Reference, displacement, dot, exact, tanked, uniform, vehicle};
use ahv::structure::{Beam, FLEXIBLE, MODES, Modes, Oscillator};

/// Relative error of a frequency. Promised are 1e-9; rounding is 1e-15.
const FREQUENCY: f64 = 1e-12;
/// Products of shapes with 1000 entries.
const ORTHOGONAL: f64 = 1e-12;

fn solve(beam: &Beam, oscillators: &[Oscillator]) -> Modes {
    Modes::solve(beam, oscillators).unwrap()
}

#[test]
fn verif_energy_share_is_the_bending_energy() {
    let (beam, oscillators) = tanked(1.0, 20.0);
    let modes = solve(&beam, &oscillators);
    let bare = Reference { beam: &beam, oscillators: &[] };
    for i in 0..MODES {
        let u = displacement(&modes, &[], i);
        let lifted: Vec<Dd> = u.into_iter().map(exact).collect();
        let (forces, _) = bare.products(&lifted);
        let total = modes.modal_mass[i] * modes.omega_rad_per_s[i].powi(2);
        let truth = dot(&lifted, &forces).hi / total;
        assert!((modes.beam_energy_share[i] - truth).abs() < ORTHOGONAL);
    }
}

/// Two masses and a spring: `omega^2 = k (1/m + 1/M)`, momentum shared, a rigid beam.
#[test]
fn verif_mass_on_a_rigid_beam_is_a_two_mass_oscillator() {
    let beam = uniform(8, 4.0, 1e16, 25.0);
    let (mass, stiffness, damping) = (10.0, 1e3, 4.0);
    let modes = solve(&beam, &[Oscillator { node: 4, mass, stiffness, damping }]);
    let slosh = FLEXIBLE;
    let reduced = 1.0 / (1.0 / mass + 1.0 / 100.0);
    let omega = (stiffness / reduced).sqrt();
    assert!((modes.omega_rad_per_s[slosh] / omega - 1.0).abs() < FREQUENCY);
    assert!((modes.modal_mass[slosh] / reduced - 1.0).abs() < FREQUENCY);
    assert!((modes.shape[slosh].w[4] / (-reduced / 100.0) - 1.0).abs() < 1e-10);
    let oscillators = [Oscillator { node: 4, mass, stiffness, damping }];
    let rate = modes.damping(&oscillators, &[0.0; FLEXIBLE])[slosh][slosh];
    assert!((rate / (damping / reduced) - 1.0).abs() < FREQUENCY);
}

/// Dampers only take energy: `mu D` is symmetric, positive semidefinite, of rank two.
#[test]
fn verif_dampers_make_a_semidefinite_matrix() {
    for (fuel, frequency) in [(1.0, 0.0), (0.5, 0.2), (0.0, 5.0), (0.5, 25.3), (1.0, 100.0)] {
        let (beam, oscillators) = tanked(fuel, frequency);
        let modes = solve(&beam, &oscillators);
        let damping = modes.damping(&oscillators, &[0.0; FLEXIBLE]);
        let power = nalgebra::SMatrix::<f64, MODES, MODES>::from_fn(|i, k| {
            damping[i][k] * (modes.modal_mass[i] / modes.modal_mass[k]).sqrt()
        });
        assert!((power - power.transpose()).amax() < ORTHOGONAL * power.amax());
        let mut values: Vec<f64> = power.symmetric_eigenvalues().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        assert!(values[..3].iter().all(|value| value.abs() < ORTHOGONAL * values[4]), "{values:?}");
        assert!(values[3] > 0.0);
    }
}

/// The structure damps each mode by its part in it.
#[test]
fn verif_structural_damping_goes_with_the_bending_energy() {
    let modes = solve(&Beam::even(&vehicle(), 1.0), &[]);
    let ratio = [0.01, 0.02, 0.03];
    let damping = modes.damping(&[], &ratio);
    for (i, row) in damping.iter().enumerate() {
        for (k, entry) in row.iter().enumerate() {
            let ratio = if i == k { ratio.get(i).unwrap_or(&0.0) } else { &0.0 };
            let truth = 2.0 * ratio * modes.omega_rad_per_s[i];
            assert!((entry - truth).abs() <= 1e-15 * truth);
        }
    }
}

/// `eta'' = -D eta' - omega^2 eta`, by classical Runge-Kutta; returns the energies.
fn simulate(modes: &Modes, damping: &[[f64; MODES]; MODES], step: f64, steps: usize) -> Vec<f64> {
    type State = [[f64; MODES]; 2];
    let rate = |[eta, speed]: &State| -> State {
        let force = std::array::from_fn(|i| {
            let drag: f64 = damping[i].iter().zip(speed).map(|(d, s)| d * s).sum();
            -drag - modes.omega_rad_per_s[i].powi(2) * eta[i]
        });
        [*speed, force]
    };
    let along = |x: &State, d: &State, h: f64| -> State {
        std::array::from_fn(|a| std::array::from_fn(|i| x[a][i] + h * d[a][i]))
    };
    let energy = |[eta, speed]: &State| -> f64 {
        (0..MODES)
            .map(|i| {
                let strain = (modes.omega_rad_per_s[i] * eta[i]).powi(2);
                0.5 * modes.modal_mass[i] * (speed[i].powi(2) + strain)
            })
            .sum()
    };
    let mut state = [[0.0, 0.0, 0.0, 0.3, -0.2], [0.4, -0.3, 0.5, 0.0, 0.0]];
    let mut energies = vec![energy(&state)];
    for _ in 0..steps {
        let k1 = rate(&state);
        let k2 = rate(&along(&state, &k1, 0.5 * step));
        let k3 = rate(&along(&state, &k2, 0.5 * step));
        let k4 = rate(&along(&state, &k3, step));
        for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = along(&state, &k, step * weight / 6.0);
        }
        energies.push(energy(&state));
    }
    energies
}

#[test]
fn verif_undamped_motion_keeps_its_energy_and_damped_motion_loses_it() {
    let (beam, oscillators) = tanked(0.5, 0.0);
    let modes = solve(&beam, &oscillators);
    // 0.012 rad per step of the fastest mode: Runge-Kutta itself loses (0.012)^6/72 a step.
    let (step, steps) = (1e-4, 20_000);
    let undamped = simulate(&modes, &[[0.0; MODES]; MODES], step, steps);
    assert!((undamped[steps] / undamped[0] - 1.0).abs() < 1e-8);
    let damped = simulate(&modes, &modes.damping(&oscillators, &[0.01; FLEXIBLE]), step, steps);
    assert!(damped.windows(2).all(|pair| pair[1] < pair[0]));
    assert!(damped[steps] < 0.9 * damped[0]);
}
