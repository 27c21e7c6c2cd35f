//! Which profile meets a wish?
//!
//! | file | question |
//! |---|---|
//! | [`rules`], [`wish`] | what do the rules of a game ask; what does somebody want |
//! | [`spline`] | which smooth curves may the change of the diameter be |
//! | [`limits`] | how much may the diameter change at a place |
//! | [`program`] | the least change under linear wishes and limits |

pub mod rules;
pub mod wish;
pub mod spline;
pub mod limits;
pub mod program;
