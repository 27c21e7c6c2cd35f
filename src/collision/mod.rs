//! What ball and bat do when they meet.

pub mod ball;
pub mod force_law;
pub mod collocation;
pub mod contact;
pub mod struck;
pub mod rigid;
pub mod energy_loss;
pub mod hit;
pub mod sweet_spot;
pub mod sweep;
