//! Which profile meets a wish?
//!
//! | file | question |
//! |---|---|
//! | [`rules`], [`wish`] | the rules of a game; the wish of a person |
//! | [`spline`] | which smooth curves may the change of the diameter have |
//! | [`incline`], [`limits`] | how steep may the surface become; how much may the diameter change at a place |
//! | [`program`] | the least change under linear wishes and limits |
//! | [`bench`](mod@bench) | the changed bat, and its goals |
//! | [`search`], [`conflict`] | the least change that meets the goals; which goals conflict |
//! | [`laying`], [`stations`] | where are the stations of the changed bat; what are their diameters |
//! | [`rounding`] | which rounding keeps the goals met |
//! | [`aimed`], [`outcome`] | the result of a wish; the bat that meets it, or comes nearest |
//! | [`cuts`] | the list for the lathe |

pub mod rules;
pub mod wish;
pub mod spline;
pub mod incline;
pub mod limits;
pub mod program;
pub mod bench;
pub mod search;
pub mod conflict;
pub mod laying;
pub mod stations;
pub mod rounding;
pub mod aimed;
pub mod outcome;
pub mod cuts;
