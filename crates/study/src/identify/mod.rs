//! Which modes do measured responses of a bat share?
//!
//! | file | question |
//! |---|---|
//! | [`set`] | which responses are there, at which points, of which references |
//! | [`modes`] | the modes that they share, with their shapes and intervals |
//! | [`masses`] | what are they without the masses of the accelerometers |
//! | [`simulate`] | what would a test of this bat find |

pub mod set;
pub mod modes;
pub mod masses;
pub mod simulate;
