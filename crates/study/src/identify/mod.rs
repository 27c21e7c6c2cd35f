//! Which modes do the measured responses of a bat share?
//!
//! | file | question |
//! |---|---|
//! | [`set`] | the responses, their points and their references |
//! | `fitted` | the poles and their residues |
//! | [`masses`] | the modes without the masses of the accelerometers |
//! | [`modes`] | the shared modes, with their shapes and intervals |
//! | [`simulate`] | what would a test of this bat find |

pub mod set;
mod fitted;
pub mod masses;
pub mod modes;
pub mod simulate;
