//! Are the results true?
//!
//! | file | question |
//! |---|---|
//! | [`gauss`], [`series`] | Gauss's rule and power series in intervals |
//! | [`enclosure`] | between which numbers do frequencies provably lie |
//! | [`bundled`], [`known_hits`], [`case`](mod@case) | what is known about which bats and hits |
//! | [`validation`] | are the known values reproduced |
//! | [`published`] | are published figures reproduced |
//! | [`promise`], [`hit_promise`], [`hoop_promise`] | are the stated errors of modes, hits and hoop modes correct |
//! | [`proven_promise`] | are they correct where every frequency is proven |
//! | [`extremes`] | are bats beyond any real one solved correctly |

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
