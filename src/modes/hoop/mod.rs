//! How does the wall of a hollow bat ring if its sections do not stay round?
//!
//! [`Hoop::of`](solve::Hoop::of) solves the wall as a solid of revolution, one harmonic `cos nθ` after the other, to a
//! tolerance. [`Response::of`](response::Response::of) gives the data for a hit: the compliance of the wall under a
//! ball.
//!
//! | file | question |
//! |---|---|
//! | [`request`] | what is asked |
//! | [`patch`] | where does a ball press |
//! | [`system`], [`spectrum`] | stiffness and mass of one harmonic; its lowest modes on one mesh |
//! | [`surface`] | how does a ball load the outer surface, and how far does it give way |
//! | `climb` | how fine must the elements be for a tolerance |
//! | [`response`] | the data for a hit, and which walls share them |
//! | [`solve`] | the modes to a tolerance, with an error for each |

pub mod request;
pub mod patch;
#[doc(hidden)]
pub mod system;
#[doc(hidden)]
pub mod spectrum;
pub mod surface;
pub(crate) mod climb;
pub mod response;
pub mod solve;

pub use crate::beam::wall::extent::rings;
pub use patch::{Patch, Share};
pub use request::{HoopRequest, KnobSide};
pub use solve::{Hoop, HoopMode, Note, Outline};
