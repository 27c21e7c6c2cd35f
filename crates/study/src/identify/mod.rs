//! Which modes do measured responses of a bat share?
//!
//! | file | question |
//! |---|---|
//! | [`set`] | which responses are there, at which points, of which references |
//! | `fitted` | which poles were found, with which residues |
//! | [`masses`] | what are they without the masses of the accelerometers |
//! | [`modes`] | the modes that they share, with their shapes and intervals |
//! | [`simulate`] | what would a test of this bat find |

pub mod set;
mod fitted;
pub mod masses;
pub mod modes;
pub mod simulate;
