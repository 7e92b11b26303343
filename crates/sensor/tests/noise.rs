//! The noise: published numbers, an independent reference, statistics.

use ahv_sensor::noise::{normal, philox};

/// `kat_vectors` of Random123, philox4x32 with ten rounds.
#[test]
fn verif_philox_gives_the_published_numbers() {
    let pi = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
    for (counter, key, words) in [
        ([0; 4], [0; 2], [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]),
        ([!0; 4], [!0; 2], [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]),
        (pi, [0xa409_3822, 0x299f_31d0], [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]),
    ] {
        assert_eq!(philox(counter, key), words);
    }
}

/// Computed with 60 digits.
#[test]
#[expect(clippy::excessive_precision, reason = "all digits of the reference")]
fn verif_numbers_are_those_of_box_and_muller() {
    for (seed, sample, expected) in [
        (0, 0, -0.397_667_538_444_182_124_33_f64),
        (0, 1, 1.386_844_427_102_837_789_2),
        (1, 0, -0.113_680_197_044_969_302_43),
        (-1, 7, -0.006_002_592_497_638_434_184_5),
        (42, 1_000_000, 2.045_348_915_092_891_497_8),
        (i32::MAX, 1 << 32, -1.401_694_389_135_483_360_7),
        (i32::MIN, 1_000_000_000_000_000, -0.016_968_347_889_879_505_003),
    ] {
        let found = normal(seed, sample);
        // The angle is rounded before its cosine is taken.
        assert!((found - expected).abs() < 1e-15, "{seed} {sample}: {found} for {expected}");
    }
}

const COUNT: u64 = 1_000_000;

/// Standard deviations of an estimate from so many numbers that are left to it: one test in a million would miss them.
const DEVIATIONS: f64 = 5.0;

fn assert_near(name: &str, found: f64, expected: f64, deviation: f64) {
    assert!((found - expected).abs() < DEVIATIONS * deviation, "{name}: {found} for {expected}");
}

#[test]
fn verif_noise_is_white_and_normally_distributed() {
    let n = COUNT as f64;
    for seed in [0, 1, -7] {
        let x: Vec<f64> = (0..COUNT).map(|k| normal(seed, k)).collect();
        let moment = |power: i32| x.iter().map(|x| x.powi(power)).sum::<f64>() / n;
        // Moments of the normal distribution: 1, 3, 15, 105 for even powers.
        assert_near("mean", moment(1), 0.0, (1.0 / n).sqrt());
        assert_near("variance", moment(2), 1.0, (2.0 / n).sqrt());
        assert_near("third moment", moment(3), 0.0, (15.0 / n).sqrt());
        assert_near("fourth moment", moment(4), 3.0, ((105.0 - 9.0) / n).sqrt());
        for lag in [1, 2, 3, 4, 5, 10, 100, 1024, 65536] {
            let pairs = x.iter().zip(&x[lag..]);
            let covariance = pairs.map(|(a, b)| a * b).sum::<f64>() / n;
            assert_near("covariance in time", covariance, 0.0, (1.0 / n).sqrt());
        }
        let other = (0..COUNT).map(|k| normal(seed + 1, k));
        let covariance = x.iter().zip(other).map(|(a, b)| a * b).sum::<f64>() / n;
        assert_near("covariance with the next seed", covariance, 0.0, (1.0 / n).sqrt());
    }
}

/// By Kolmogorov and Smirnov: beyond 2.5 / sqrt(n) with a probability of 2 exp(-2 * 2.5^2), a hundred-thousandth.
#[test]
fn verif_noise_has_the_normal_distribution_function() {
    let mut x: Vec<f64> = (0..COUNT).map(|k| normal(3, k)).collect();
    x.sort_by(f64::total_cmp);
    let n = COUNT as f64;
    let normal = |x: f64| 0.5 * libm::erfc(-x / std::f64::consts::SQRT_2);
    let distance = x.iter().enumerate().map(|(i, &x)| (normal(x) - i as f64 / n).abs());
    let most = distance.fold(0.0, f64::max);
    assert!(most < 2.5 / n.sqrt(), "{most}");
}

/// The same bits on every platform.
#[test]
fn verif_the_bits_of_the_noise_stay_the_same() {
    let hash = (0..10_000).fold(0_u64, |hash, k| {
        (hash ^ normal(9, k).to_bits()).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23)
    });
    assert_eq!(hash, 12_758_593_696_794_723_731);
}
