//! What does the bat as a beam store, and how does it give way?
//!
//! [`mesh`] says where the elements are, [`element`] what one of them stores, [`statics`] what a
//! load does to the whole bat, [`motion`] how far a motion is from a mode and [`count`] how many
//! modes are slower than one. [`assembly::Pencil::of`] gives K and M as sparse matrices; it is what
//! to call from outside, for [`crate::solve()`] does the rest.

pub mod mesh;
pub mod rule;
pub mod sections;
pub mod element;
pub mod hermite;
pub mod degree;
pub mod walk;
pub mod sweep;
pub(crate) mod footing;
pub(crate) mod bed;
pub mod holds;
pub mod attached;
pub mod placed;
pub mod fixed;
pub mod statics;
pub mod start;
pub mod view;
pub mod count;
pub mod motion;
pub mod defect;
pub mod changes;

pub mod assembly;
pub mod dowel;
