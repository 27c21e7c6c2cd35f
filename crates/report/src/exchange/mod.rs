//! Results in the files of other programs: universal files (UFF), VTK, NumPy, CSV, sound (WAV); and reading the JSON of
//! this program.
//!
//! In all of them the bat lies along the global x axis with the knob at 0. It deflects along y, and its sections rotate
//! about z, right-handed, so that without shear a rotation is dw/dx. Lengths are in m, masses in kg, frequencies in Hz.
//! The largest deflection of a shape is 1, and modal masses belong to that scale.

pub mod modes_file;
pub mod modes_uff;
pub mod frf_uff;
pub mod shared_uff;
pub mod csv;
#[cfg(not(target_arch = "wasm32"))]
pub mod npz;
pub mod solid;
pub mod vtu;
pub mod barrel;
pub mod hoop_files;
pub mod wav;
