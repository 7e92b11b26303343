//! Normally distributed numbers, each a function of seed and sample number alone.
//!
//! Philox4x32-10: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2, 3,
//! SC11 (2011). A number needs none before it, so neither the step size nor a restored state changes the noise.

use libm::{cos, log};
use std::f64::consts::TAU;

const ROUNDS: usize = 10;
const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const KEY_INCREMENTS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

/// Four random words of a counter and a key.
pub fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..ROUNDS {
        let product = |i: usize| u64::from(MULTIPLIERS[i]) * u64::from(counter[2 * i]);
        let [high, low] = [|x: u64| (x >> 32) as u32, |x: u64| x as u32];
        let (first, second) = (product(0), product(1));
        counter = [
            high(second) ^ counter[1] ^ key[0],
            low(second),
            high(first) ^ counter[3] ^ key[1],
            low(first),
        ];
        key = [0, 1].map(|i| key[i].wrapping_add(KEY_INCREMENTS[i]));
    }
    counter
}

/// A normally distributed number of mean 0 and standard deviation 1, by Box and Muller.
pub fn normal(seed: i32, sample: u64) -> f64 {
    let words = philox([sample as u32, (sample >> 32) as u32, 0, 0], [seed as u32, 0]);
    // 53 bits, a whole number of units in the last place below 1.
    let bits = |i: usize| ((u64::from(words[i + 1]) << 32 | u64::from(words[i])) >> 11) as f64;
    let unit = 0.5 * f64::EPSILON;
    // The first is in (0, 1]: its logarithm is finite.
    let (first, second) = ((bits(0) + 1.0) * unit, bits(2) * unit);
    (-2.0 * log(first)).sqrt() * cos(TAU * second)
}
