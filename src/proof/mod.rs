//! Is it true?
//!
//! | file | question |
//! |---|---|
//! | [`known_hits`], [`validation`] | are known answers reproduced |
//! | [`published`] | are published figures reproduced |
//! | [`promise`], [`hit_promise`] | do stated errors hold, of modes and of hits |
//! | [`extremes`] | does what no bat is stay right |

pub mod known_hits;
pub mod validation;
pub mod published;
pub mod promise;
pub mod hit_promise;
pub mod extremes;
