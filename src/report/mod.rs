//! Everything a user asked for, ready to print or to write.

pub mod json;
pub mod text;
pub mod curve;
pub mod file;
