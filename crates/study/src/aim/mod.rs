//! Which profile meets a wish?
//!
//! | file | question |
//! |---|---|
//! | [`rules`], [`wish`] | what do the rules of a game ask; what does somebody want |
//! | [`spline`] | which smooth curves may the change of the diameter be |
//! | [`incline`], [`limits`] | how steep may the surface become; how much may the diameter change at a place |
//! | [`program`] | the least change under linear wishes and limits |
//! | [`bench`](mod@bench) | what does the bat become, and what are its goals then |
//! | [`search`], [`conflict`] | the least change that meets the goals; which of them cannot be had together |
//! | [`laying`], [`stations`] | where do the stations of the changed bat stand; which diameters is it written with |
//! | [`rounding`] | which rounding leaves the goals where they are to be |
//! | [`aimed`], [`outcome`] | what comes of a wish; the bat that meets it, or comes nearest |
//! | [`cuts`] | what the lathe takes off |

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
