//! What does the bat store as a beam, and how does it deform?
//!
//! [`assembly::Pencil::of`] gives K and M as sparse matrices, for use from outside; [`crate::solve()`] does everything
//! else.
//!
//! | file | question |
//! |---|---|
//! | [`mesh`], [`rule`], [`sections`] | where are the elements, and their points; what are the sections there |
//! | [`element`], [`hermite`], [`degree`] | what does one element store, in strains and as the textbooks have it |
//! | [`walk`], [`sweep`] | the passes over a bat from stop to stop, and the sums on them |
//! | [`footing`], [`bed`], [`holds`] | what lies beyond a border, two springs; an elastic bed; how contacts hold a bat |
//! | [`attached`], [`placed`], [`fixed`] | a fixture; its place; how the bat then deforms |
//! | [`statics`], [`start`], [`view`] | what a load does to the whole bat; where an iteration starts |
//! | [`count`] | how many modes are slower than a frequency |
//! | [`motion`], [`defect`], [`changes`] | shape and energies of a motion; how far it and its shape are from a mode's |
//! | [`wall`] | what does the wall of a hollow bat store if its sections do not stay round |
//! | [`assembly`], [`dowel`] | sparse matrices; a uniform beam in closed form |

pub mod mesh;
pub mod rule;
pub mod sections;
pub mod element;
pub mod hermite;
pub mod degree;
pub mod walk;
pub mod sweep;
pub mod footing;
pub mod bed;
pub mod holds;
pub mod attached;
pub mod placed;
pub mod fixed;
pub mod statics;
pub mod view;
pub mod start;
pub mod count;
pub mod motion;
pub mod defect;
pub mod changes;
pub mod wall;

pub mod assembly;
pub mod dowel;

pub use dowel::{Dowel, Ends, UniformMode, beta_l};
pub use rule::{DEGREES, MOST_POINTS, Rule};
pub use {changes::Depth, degree::Elements, degree::OfDegree, degree::of_degree, mesh::Mesh};
pub use {motion::Motion, statics::Statics, sweep::Loads, view::View};
