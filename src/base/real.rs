//! What does the solver compute with: one number at a time, or several side by side?
//!
//! [`Real`] is `f64` or [`crate::base::lanes::Lanes`]; [`Over`] lets several motions of one bat share the bat's
//! numbers.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A real number, or one number for each of several bats on the same mesh or of several modes of a bat.
///
/// A comparison answers for all lanes at once, so that every lane takes the same steps.
pub trait Real:
    Copy
    + Debug
    + Default
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// Number of lanes.
    const LANES: usize;

    /// `value` in every lane.
    fn splat(value: f64) -> Self;
    /// The number in one lane.
    fn lane(&self, lane: usize) -> f64;
    /// Sets the number in one lane.
    fn set_lane(&mut self, lane: usize, value: f64);
    /// Square root of every lane.
    fn sqrt(self) -> Self;
    /// Absolute value of every lane.
    fn abs(self) -> Self;
    /// The greater of both, lane by lane.
    fn max(self, other: Self) -> Self;
    /// The absolute value of this with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// `then` in the lanes where this is zero, `otherwise` in the others.
    fn if_zero(self, then: Self, otherwise: Self) -> Self;
    /// Whether this is at most `other` in every lane.
    fn within(self, other: Self) -> bool;
}

/// Numbers for the motions of bats that are given in numbers `S`: either the same type, lane by lane, or several
/// motions of one bat side by side.
pub trait Over<S>: Real + Mul<S, Output = Self> {
    /// `value` for every motion.
    fn of(value: S) -> Self;
}

impl<R: Real> Over<R> for R {
    #[inline(always)]
    fn of(value: R) -> R {
        value
    }
}

impl Real for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> f64 {
        *self
    }

    #[inline(always)]
    fn set_lane(&mut self, _: usize, value: f64) {
        *self = value;
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        if self == 0.0 { then } else { otherwise }
    }

    #[inline(always)]
    fn within(self, other: Self) -> bool {
        self <= other
    }
}
