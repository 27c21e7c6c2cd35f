//! Between which numbers do the frequencies of the exact beam lie, proven?

pub mod radii;
pub mod sections;
pub mod beam;
pub mod energies;
pub mod norms;
pub mod conclude;
pub mod trials;
