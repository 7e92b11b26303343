//! Numbers of twice the precision, as unevaluated sums of two `f64`, for the reference flights.
//!
//! Sums and products after T. J. Dekker, A floating-point technique for extending the available precision,
//! Numer. Math. 18, 1971, 224-242. [`Scalar::chain`] has no more digits of a function than `f64`: the density of the air is
//! one for the vehicle, its error a few 1e-16 and the same for all methods.

use ahv::solve::{Over, Scalar};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// high + low, |low| at most half a unit in the last place of high.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// Terms of the series of sine and cosine: enough below 1/16 rad.
const TERMS: usize = 12;
/// Doublings of the angle after the series.
const DOUBLINGS: usize = 4;

impl DoubleDouble {
    /// For |high| > |low|.
    fn sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }

    /// Nearest `f64`.
    pub fn rounded(self) -> f64 {
        self.high
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// a + b exactly.
fn exact_sum(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    let b_part = sum - a;
    DoubleDouble { high: sum, low: (a - (sum - b_part)) + (b - b_part) }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let [high, low] = [exact_sum(self.high, other.high), exact_sum(self.low, other.low)];
        let sum = Self::sum(high.high, high.low + low.high);
        Self::sum(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.high * other.high;
        let lost = libm::fma(self.high, other.high, -product);
        Self::sum(product, lost + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        Self::sum(first, second) + rest.high / other.high
    }
}

impl Add<f64> for DoubleDouble {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Self::from(other)
    }
}

impl Sub<f64> for DoubleDouble {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self - Self::from(other)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self * Self::from(other)
    }
}

impl Over<f64> for DoubleDouble {
    fn of(coefficient: f64) -> Self {
        coefficient.into()
    }
}

impl Over<Self> for DoubleDouble {
    fn of(coefficient: Self) -> Self {
        coefficient
    }
}

impl Scalar for DoubleDouble {
    fn constant(value: f64) -> Self {
        value.into()
    }
    fn value(self) -> f64 {
        self.high
    }
    fn chain(self, value: f64, slope: f64) -> Self {
        Self::sum(value, slope * self.low)
    }
    fn sin_cos(self) -> (Self, Self) {
        let one = Self::from(1.0);
        let x = self * 0.5_f64.powi(DOUBLINGS as i32);
        let square = x * x;
        let [mut sin, mut cos] = [Self::default(); 2];
        for k in (0..TERMS).map(|k| 2.0 * k as f64).rev() {
            sin = one - square * sin / Self::from((k + 2.0) * (k + 3.0));
            cos = one - square * cos / Self::from((k + 1.0) * (k + 2.0));
        }
        sin = sin * x;
        for _ in 0..DOUBLINGS {
            (sin, cos) = (sin * cos * 2.0, one - sin * sin * 2.0);
        }
        (sin, cos)
    }
    fn sqrt(self) -> Self {
        let root = libm::sqrt(self.high);
        Self::sum(root, (self - Self::from(root) * root).high / (2.0 * root))
    }
    fn atan(self) -> Self {
        let angle = Self::from(libm::atan(self.high));
        let (sin, cos) = angle.sin_cos();
        angle + (self * cos - sin) / (cos + self * sin)
    }
    fn is_zero(self) -> bool {
        self.high == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verif_functions_have_thirty_digits() {
        let small = |x: DoubleDouble| assert!(x.high.abs() < 1e-30, "{x:?}");
        for value in [0.1, 0.7, -0.3] {
            let x = DoubleDouble::from(value) / DoubleDouble::from(3.0);
            let (sin, cos) = x.sin_cos();
            small(sin * sin + cos * cos - 1.0);
            small((sin / cos).atan() - x);
            small((x * x).sqrt() * value.signum() - x);
            small(x * 3.0 - value);
            let (twice, _) = (x * 2.0).sin_cos();
            small(twice - sin * cos * 2.0);
        }
    }
}
