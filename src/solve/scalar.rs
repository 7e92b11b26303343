//! The number type of the equations: `f64` for simulation, [`Dual`] for exact derivatives.
//!
//! Elementary functions come from the `libm` crate, so that every platform computes the same bits. The
//! well-known crates for dual numbers call the platform's functions instead.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that can be multiplied by coefficients of type `C`: `f64`, or its own type.
pub trait Over<C>: Mul<C, Output = Self> {
    /// Converts a coefficient.
    fn of(coefficient: C) -> Self;
}

/// The operations that the equations use.
pub trait Scalar:
    Copy
    + Default
    + Over<f64>
    + Over<Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The value without derivatives.
    fn value(self) -> f64;
    /// g(self), from the value and the derivative of g at self (chain rule).
    fn chain(self, value: f64, slope: f64) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Square root.
    fn sqrt(self) -> Self;
    /// Arc tangent.
    fn atan(self) -> Self;
    /// Whether value and derivatives are zero.
    fn is_zero(self) -> bool;
}

impl Over<f64> for f64 {
    #[inline]
    fn of(coefficient: f64) -> Self {
        coefficient
    }
}

impl Scalar for f64 {
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
    #[inline]
    fn chain(self, value: f64, _: f64) -> Self {
        value
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
    #[inline]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    #[inline]
    fn atan(self) -> Self {
        libm::atan(self)
    }
    #[inline]
    fn is_zero(self) -> bool {
        self == 0.0
    }
}

/// A value with its partial derivatives in `N` directions (forward mode).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    /// Value.
    pub re: f64,
    /// Partial derivatives.
    pub eps: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The independent variable number `direction`.
    pub fn variable(value: f64, direction: usize) -> Self {
        let mut eps = [0.0; N];
        eps[direction] = 1.0;
        Self { re: value, eps }
    }

    #[inline]
    fn combine(self, other: Self, re: f64, left: f64, right: f64) -> Self {
        Self { re, eps: std::array::from_fn(|i| left * self.eps[i] + right * other.eps[i]) }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.re + other.re, 1.0, 1.0)
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.re - other.re, 1.0, -1.0)
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.re * other.re, other.re, self.re)
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.re / other.re;
        self.combine(other, quotient, 1.0 / other.re, -quotient / other.re)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.re, -1.0)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self.chain(self.re + other, 1.0)
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self.chain(self.re - other, 1.0)
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self.chain(self.re * other, other)
    }
}

impl<const N: usize> Default for Dual<N> {
    fn default() -> Self {
        Self { re: 0.0, eps: [0.0; N] }
    }
}

impl<const N: usize> Over<f64> for Dual<N> {
    fn of(coefficient: f64) -> Self {
        Self::constant(coefficient)
    }
}

impl<const N: usize> Over<Self> for Dual<N> {
    fn of(coefficient: Self) -> Self {
        coefficient
    }
}

impl<const N: usize> Scalar for Dual<N> {
    fn constant(value: f64) -> Self {
        Self { re: value, eps: [0.0; N] }
    }
    fn value(self) -> f64 {
        self.re
    }
    #[inline]
    fn chain(self, re: f64, slope: f64) -> Self {
        Self { re, eps: self.eps.map(|e| slope * e) }
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.re);
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    fn sqrt(self) -> Self {
        let value = libm::sqrt(self.re);
        self.chain(value, 0.5 / value)
    }
    fn atan(self) -> Self {
        self.chain(libm::atan(self.re), 1.0 / (1.0 + self.re * self.re))
    }
    fn is_zero(self) -> bool {
        self.re == 0.0 && self.eps.iter().all(|&slope| slope == 0.0)
    }
}
