//! The bat as a beam: elements, the compliance by statics, and the assembled matrices.

pub mod mesh;
pub mod element;
pub mod statics;
pub mod assembly;
