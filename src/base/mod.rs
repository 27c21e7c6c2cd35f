//! What do we count with, and how do we fail?
//!
//! Read [`error`] and [`units`] first: an error names the place of the mistake, and every number that comes in or goes
//! out has its unit named.
//!
//! | file | question |
//! |---|---|
//! | [`marks`] | which characters act on the program that shows them |
//! | [`error`], `mistakes` | what was wrong, where, what was expected; several mistakes at once |
//! | [`telling`], `clock`, [`threads`] | how far is a computation; how long does it take; on how many threads |
//! | [`file`](mod@file) | how is a file written so that nothing is lost |
//! | [`typed`], [`units`] | which numbers and units did a person type; what is a number with a unit in SI |
//! | [`number`] | how is a number written |
//! | [`real`], [`lanes`] | one number or several side by side |
//! | [`linear`], [`golden`] | products of vectors, two equations; the golden section |
//! | `search` | where is a value greatest, where does it become too low |
//! | [`quadrature`], [`interval`] | how is an integral taken; which values can an expression take |
//! | [`xml`] | how is a text written into XML |

#[doc(hidden)]
pub mod marks;
pub mod error;
#[doc(hidden)]
pub mod mistakes;
pub mod telling;
pub(crate) mod clock;
#[doc(hidden)]
pub mod threads;
#[doc(hidden)]
pub mod file;
#[doc(hidden)]
pub mod typed;
pub mod units;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod real;
#[doc(hidden)]
pub mod lanes;
#[doc(hidden)]
pub mod linear;
#[doc(hidden)]
pub mod golden;
pub(crate) mod search;
#[doc(hidden)]
pub mod quadrature;
#[doc(hidden)]
pub mod interval;
#[doc(hidden)]
pub mod xml;

pub use error::{Complaint, Error, Excerpt, FilePosition, Result};
pub use telling::{Tell, nobody};
pub use units::{Quantity, inches, ounces, shown_length};
pub(crate) use {clock::Clock, error::nearest, error::shortened, lanes::vectorized, lanes::widest};
#[doc(hidden)]
pub use {interval::Interval, lanes::Lanes, lanes::WIDTH, linear::dot, mistakes::Mistakes};
#[doc(hidden)]
pub use {number::significant, quadrature::RunningSum, quadrature::gauss, real::Over, real::Real};
