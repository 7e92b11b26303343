//! The modes of a uniform beam against Euler and Bernoulli.

use super::reference::uniform;
use ahv::structure::{FLEXIBLE, Modes};

/// Relative error of a frequency but for that of the elements.
const FREQUENCY: f64 = 1e-12;

/// Positive roots of `cos z cosh z = 1` by bisection; they lie near `(i + 1/2) pi`.
fn free_free_root(i: usize) -> f64 {
    let f = |z: f64| z.cos() - 1.0 / z.cosh();
    let middle = (i as f64 + 0.5) * std::f64::consts::PI;
    let (mut low, mut high) = (middle - 0.1, middle + 0.1);
    let rising = f(high) > 0.0;
    for _ in 0..60 {
        let centre = 0.5 * (low + high);
        if (f(centre) > 0.0) == rising { high = centre } else { low = centre }
    }
    0.5 * (low + high)
}

/// Relative errors of the frequencies of a uniform beam against Euler and Bernoulli.
fn uniform_errors(elements: usize) -> [f64; FLEXIBLE] {
    let (length, ei, density) = (20.0, 3e8, 400.0_f64);
    let modes = Modes::solve(&uniform(elements, length, ei, density), &[]).unwrap();
    std::array::from_fn(|i| {
        let beta = free_free_root(i + 1) / length;
        modes.omega_rad_per_s[i] / (beta * beta * (ei / density).sqrt()) - 1.0
    })
}

#[test]
fn verif_uniform_beam_has_the_frequencies_of_theory() {
    let known = [4.730_040_744_862_704, 7.853_204_624_095_838, 10.995_607_838_001_671];
    for (i, known) in known.into_iter().enumerate() {
        assert!((free_free_root(i + 1) - known).abs() < 1e-13);
    }
    for (i, error) in uniform_errors(500).into_iter().enumerate() {
        // The leading error of cubic elements is (beta h)^4 / 1440 in omega.
        let truth = (free_free_root(i + 1) / 500.0).powi(4) / 1440.0;
        assert!((error - truth).abs() <= 1e-3 * truth + FREQUENCY, "{error:e}, not {truth:e}");
    }
}

#[test]
fn verif_frequencies_converge_with_order_four() {
    let mut coarse = uniform_errors(16);
    for elements in [32, 64, 128] {
        let fine = uniform_errors(elements);
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            let order = (coarse / fine).log2();
            assert!((order - 4.0).abs() < 0.05, "order {order} at {elements} elements");
        }
        coarse = fine;
    }
}
