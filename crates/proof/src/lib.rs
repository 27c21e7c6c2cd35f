//! Is it true?
//!
//! | file | question |
//! |---|---|
//! | [`gauss`], [`series`] | Gauss's rule and power series in intervals |
//! | [`enclosure`] | between which numbers do frequencies lie, proven |
//! | [`bundled`], [`known_hits`], [`case`](mod@case) | what is known, of which bats and hits |
//! | [`validation`] | is it reproduced |
//! | [`published`] | are published figures reproduced |
//! | [`promise`], [`hit_promise`], [`hoop_promise`] | do stated errors hold, of modes, of hits and of hoop modes |
//! | [`proven_promise`] | do they hold where every frequency is proven |
//! | [`extremes`] | does what no bat is stay right |

#![forbid(unsafe_code)]
#![allow(clippy::needless_range_loop)]

pub mod gauss;
pub mod series;
pub mod enclosure;
pub mod bundled;
pub mod known_hits;
pub mod case;
pub mod validation;
pub mod published;
pub mod promise;
pub mod hit_promise;
pub mod hoop_promise;
pub mod proven_promise;
pub mod extremes;
