//! Double-double arithmetic: the unevaluated sum of two doubles, some 31 digits.
//!
//! T. J. Dekker, Numerische Mathematik 18, 1971, 224-242; error bounds in Joldes, Muller and
//! Popescu, ACM Trans. Math. Softw. 44(2), 2017. Written out here because the reference must not
//! rest on a division that is good to one double only.

use std::ops::{Add, AddAssign, Div, Mul, Sub, SubAssign};

/// `hi + lo`, with `|lo| <= ulp(hi) / 2`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dd {
    pub hi: f64,
    lo: f64,
}

pub const fn exact(x: f64) -> Dd {
    Dd { hi: x, lo: 0.0 }
}

fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let part = hi - a;
    Dd { hi, lo: (a - (hi - part)) + (b - part) }
}

fn quick_two_sum(large: f64, small: f64) -> Dd {
    let hi = large + small;
    Dd { hi, lo: small - (hi - large) }
}

impl From<f64> for Dd {
    fn from(x: f64) -> Self {
        exact(x)
    }
}

impl From<Dd> for f64 {
    fn from(x: Dd) -> Self {
        x.hi
    }
}

impl<T: Into<Dd>> Add<T> for Dd {
    type Output = Self;
    fn add(self, other: T) -> Self {
        let other = other.into();
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let sum = quick_two_sum(high.hi, high.lo + low.hi);
        quick_two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl<T: Into<Dd>> Sub<T> for Dd {
    type Output = Self;
    fn sub(self, other: T) -> Self {
        let other = other.into();
        self + Self { hi: -other.hi, lo: -other.lo }
    }
}

impl<T: Into<Dd>> Mul<T> for Dd {
    type Output = Self;
    fn mul(self, other: T) -> Self {
        let other = other.into();
        let hi = self.hi * other.hi;
        let lo = self.hi.mul_add(other.hi, -hi);
        quick_two_sum(hi, lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl<T: Into<Dd>> Div<T> for Dd {
    type Output = Self;
    fn div(self, other: T) -> Self {
        let other = other.into();
        let first = self.hi / other.hi;
        let rest = self - other * first;
        let second = rest.hi / other.hi;
        let third = (rest - other * second).hi / other.hi;
        quick_two_sum(first, second) + third
    }
}

impl<T: Into<Dd>> AddAssign<T> for Dd {
    fn add_assign(&mut self, other: T) {
        *self = *self + other;
    }
}

impl<T: Into<Dd>> SubAssign<T> for Dd {
    fn sub_assign(&mut self, other: T) {
        *self = *self - other;
    }
}
