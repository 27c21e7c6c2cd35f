//! What does the bat as a beam store, and how does it give way?
//!
//! [`assembly::Pencil::of`] gives K and M as sparse matrices; it is what to call from outside, for
//! [`crate::solve()`] does the rest.
//!
//! | file | question |
//! |---|---|
//! | [`mesh`], [`rule`], [`sections`] | where are the elements, and their points; what are the sections there |
//! | [`element`], [`hermite`], [`degree`] | what does one element store, in strains and as the textbooks have it |
//! | [`walk`], [`sweep`] | the way over a bat from stop to stop; what is summed up on it |
//! | [`footing`], [`bed`], [`holds`] | what lies beyond a border, two springs; an elastic bed; how contacts hold a bat |
//! | [`attached`], [`placed`], [`fixed`] | one thing on the bat; where it is; how the bat then gives way |
//! | [`statics`], [`start`], [`view`] | what a load does to the whole bat; where an iteration starts |
//! | [`count`] | how many motions are slower than one |
//! | [`motion`], [`defect`], [`changes`] | shape and energies of a motion; how far it and its shape are from a mode's |
//! | [`wall`] | what does the wall of a hollow bat store when its sections do not stay round |
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
