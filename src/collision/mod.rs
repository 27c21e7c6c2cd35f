//! What ball and bat do when they meet.

pub mod ball;
pub mod force_law;
pub mod collocation;
pub mod touch;
pub mod step;
pub mod events;
pub mod contact;
pub mod struck;
pub mod rigid;
pub mod energy_loss;
pub mod pulse;
pub mod aftermath;
pub mod history;
pub mod hit;
pub mod hitter;
pub mod sweet_spot;
pub mod figures;
pub mod sweep;
