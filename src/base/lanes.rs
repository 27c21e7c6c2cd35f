//! How do several bats or modes go through the same arithmetic at once?
//!
//! [`Lanes`] holds as many numbers as a vector of the machine. It uses plain loops over arrays, which the compiler
//! turns into vector instructions. pulp chooses the widest vectors that the machine has. The choice does not change the
//! bits of an answer.

use std::sync::atomic::{AtomicBool, Ordering};

use pulp::{Arch, WithSimd};

use crate::base::real::{Over, Real};

/// Number of bats or modes side by side: two vectors of AVX2, or four of the oldest machines.
pub const WIDTH: usize = 8;

/// Whether to use only the vectors that every machine has.
static PLAIN: AtomicBool = AtomicBool::new(false);

/// Restricts the whole process, from now on, to the vectors that every machine has: for a test that answers have equal
/// bits on all machines.
pub fn leave_wide_vectors_unused() {
    PLAIN.store(true, Ordering::Relaxed);
}

/// Does the work with the widest vectors that this machine has.
///
/// The work is compiled once for each kind of vectors, not again in every function that calls it.
#[inline(never)]
pub(crate) fn widest<W: WithSimd>(work: W) -> W::Output {
    let arch = if PLAIN.load(Ordering::Relaxed) { Arch::Scalar } else { Arch::new() };
    arch.dispatch(work)
}

/// A closure that consumes this can be called only once, so the compiler inlines its call. Any other closure is called
/// through a function that is not always inlined, and code that is not inlined does not use the wide vectors.
pub(crate) struct Once;

impl Once {
    #[inline(always)]
    pub(crate) fn use_up(self) {}
}

/// Evaluates an expression with the widest vectors that this machine has. Functions that it calls are inlined into the
/// surrounding closure, and the closure into the code for each kind of vectors.
macro_rules! vectorized {
    ($work:expr) => {{
        let once = $crate::base::lanes::Once;
        $crate::base::lanes::widest(
            #[inline(always)]
            || {
                once.use_up();
                $work
            },
        )
    }};
}

pub(crate) use vectorized;

/// One number for each of several bats or modes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(align(64))]
pub struct Lanes([f64; WIDTH]);

/// The value of the expression in every one of several lanes. A plain loop: closures are compiled again for every use
/// and are not always inlined.
macro_rules! in_every_lane {
    ($width:ident, $k:ident => $value:expr) => {{
        let mut lanes = [0.0; $width];
        let mut $k = 0;
        while $k < $width {
            lanes[$k] = $value;
            $k += 1;
        }
        lanes
    }};
}
pub(crate) use in_every_lane;

/// The arithmetic of a type that holds several lanes: of two numbers in every lane, and of one with the same number in
/// every lane.
macro_rules! arithmetic {
    ([$($generic:tt)*] $lanes:ty, $make:path, $width:ident) => {
        $crate::base::lanes::arithmetic! {
            [$($generic)*] $lanes, $make, $width: Add add +, Sub sub -, Mul mul *, Div div /
        }

        impl<$($generic)*> ::std::ops::Neg for $lanes {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                $make($crate::base::lanes::in_every_lane!($width, k => -self.0[k]))
            }
        }

        impl<$($generic)*> ::std::ops::AddAssign for $lanes {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<$($generic)*> ::std::ops::SubAssign for $lanes {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
    };
    ($generic:tt $lanes:ty, $make:path, $width:ident: $($name:ident $function:ident $sign:tt),*) => {
        $($crate::base::lanes::arithmetic! { $generic $lanes, $make, $width, $name $function $sign })*
    };
    ([$($generic:tt)*] $lanes:ty, $make:path, $width:ident, $name:ident $function:ident $sign:tt) => {
        impl<$($generic)*> ::std::ops::$name for $lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                $make($crate::base::lanes::in_every_lane!($width, k => self.0[k] $sign other.0[k]))
            }
        }

        impl<$($generic)*> ::std::ops::$name<f64> for $lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                $make($crate::base::lanes::in_every_lane!($width, k => self.0[k] $sign other))
            }
        }
    };
}
pub(crate) use arithmetic;

arithmetic! { [] Lanes, Lanes, WIDTH }

macro_rules! lanes {
    ($k:ident => $value:expr) => {
        Lanes(in_every_lane!(WIDTH, $k => $value))
    };
}

impl Lanes {
    /// The sum over the lanes, halves first.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }
}

impl Over<f64> for Lanes {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::splat(value)
    }
}

impl Real for Lanes {
    const LANES: usize = WIDTH;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; WIDTH])
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        lanes!(k => self.0[k].sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        lanes!(k => self.0[k].abs())
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        lanes!(k => if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] })
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        lanes!(k => self.0[k].copysign(sign.0[k]))
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        lanes!(k => if self.0[k] == 0.0 { then.0[k] } else { otherwise.0[k] })
    }

    #[inline(always)]
    fn within(self, other: Self) -> bool {
        let mut all = true;
        let mut k = 0;
        while k < WIDTH {
            all &= self.0[k] <= other.0[k];
            k += 1;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;

    use super::*;

    #[test]
    fn every_lane_counts_as_a_number_of_its_own() {
        let numbers: [f64; WIDTH] = from_fn(|k| k as f64 - 3.0);
        let a = Lanes(numbers);
        let b = Lanes::splat(2.0);
        for k in 0..WIDTH {
            let x = numbers[k];
            assert_eq!((a * b - a / b + -b).lane(k), x * 2.0 - x / 2.0 + -2.0);
            assert_eq!(a.abs().sqrt().lane(k), x.abs().sqrt());
            assert_eq!(a.max(b).lane(k), x.max(2.0));
            assert_eq!(b.copysign(a).lane(k), 2.0_f64.copysign(x));
            assert_eq!(a.if_zero(b, a).lane(k), if x == 0.0 { 2.0 } else { x });
        }
        // Every lane counts once.
        assert_eq!(Lanes(from_fn(|k| f64::from(1_u32 << k))).sum(), 255.0);
        assert!(a.within(Lanes::splat(4.0)) && !a.within(Lanes::splat(3.9)));
    }
}
