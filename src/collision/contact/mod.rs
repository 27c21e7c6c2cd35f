//! What happens while ball and bat touch?
//!
//! | file | question |
//! |---|---|
//! | [`force_law`] | how hard does the ball push back |
//! | [`collocation`] | the points of a step and the modes' exact answer to a force through them |
//! | [`touch`] | what is felt at the place; the state of ball and bat |
//! | [`step`], [`events`] | one step; where the force turns, ends or begins again |
//! | [`flight`] | when do they touch again |
//! | [`encounter`] | the whole encounter, until the ball is gone for good |

pub mod force_law;
pub mod collocation;
pub mod touch;
pub mod step;
pub mod events;
pub mod flight;
pub mod encounter;
