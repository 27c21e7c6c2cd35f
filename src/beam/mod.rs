//! The bat as a beam: elements, the compliance by statics, and the assembled matrices.

pub mod mesh;
pub mod rule;
pub mod element;
pub mod sweep;
pub mod holds;
pub mod fixed;
pub mod statics;
pub mod count;
pub mod motion;

pub mod assembly;
