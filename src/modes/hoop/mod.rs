//! How does the wall of a hollow bat ring when its sections do not stay round?
//!
//! [`Hoop::of`](solve::Hoop::of) solves the wall as a solid of revolution, one harmonic `cos nθ` after the
//! other, to a tolerance, and says how it gives way under a ball.
//!
//! | file | question |
//! |---|---|
//! | [`request`] | what is asked |
//! | [`system`], [`spectrum`] | stiffness and mass of one harmonic; its lowest modes on one mesh |
//! | [`patch`] | how does the wall give way where a ball presses |
//! | `climb` | how fine must the elements be for a tolerance |
//! | [`solve`] | the modes to a tolerance, with an error for each |

pub mod request;
#[doc(hidden)]
pub mod system;
#[doc(hidden)]
pub mod spectrum;
pub mod patch;
pub(crate) mod climb;
pub mod solve;

pub use crate::beam::wall::extent::rings;
pub use patch::{Patch, Share};
pub use request::{HoopRequest, KnobSide};
pub use solve::{Hoop, HoopMode, Note, Outline};
