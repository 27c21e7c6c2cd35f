//! Everything a user asked for, ready to print or to write.

pub mod file;
pub mod svg;
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
pub mod comparison;
pub mod comparison_data;
pub mod measured;
