//! The modes of fuel levels between which is interpolated.

use super::modes::configurations;
use ahv::structure::Modes;

/// Relative error of a frequency: of second order in the residual, so rounding is all.
const FREQUENCY: f64 = 1e-12;
/// Error of a shape over its largest entry, times the relative gap to the next frequency.
const SHAPE: f64 = 1e-9;

#[test]
fn verif_nearly_the_modes_are_the_modes_to_nine_digits() {
    for (beam, oscillators) in configurations() {
        let [nearly, modes] =
            [Modes::nearly(&beam, &oscillators), Modes::solve(&beam, &oscillators)]
                .map(Result::unwrap);
        let omegas = &modes.omega_rad_per_s[..modes.count];
        for (i, omega) in omegas.iter().enumerate() {
            let error = (nearly.omega_rad_per_s[i] / omega - 1.0).abs();
            assert!(error < FREQUENCY, "{omega} rad/s: {error:.1e}");
            let others = omegas.iter().enumerate().filter(|(k, _)| *k != i);
            let gap = others.map(|(_, other)| (other / omega - 1.0).abs()).fold(1.0, f64::min);
            let largest = modes.shape[i].w.iter().fold(0.0, |a: f64, w| a.max(w.abs()));
            let pairs = nearly.shape[i].w.iter().zip(&modes.shape[i].w);
            let error = pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
            assert!(error * gap < SHAPE * largest, "{omega} rad/s: {:.1e}", error / largest);
        }
    }
}
