//! Everything a user asked for, ready to print or to write.

pub mod file;
pub mod curve;
pub mod resolved;
pub mod damped;
pub mod json;
pub mod text;
pub mod hit_text;
pub mod hit_json;
pub mod aftermath;
pub mod u_curve;
pub mod trade;
pub mod advice;
