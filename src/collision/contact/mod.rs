//! What happens while ball and bat touch?
//!
//! | file | question |
//! |---|---|
//! | [`each`] | one number for each of several places; their powers, sines and cosines |
//! | [`force_law`] | what does a contact need from a ball's law |
//! | [`collocation`] | the points of a step and the modes' exact response to a force through them |
//! | [`touch`] | the bat's response at the impact point; the state of ball and bat |
//! | [`table`], [`step`], [`energy`] | the effect of a step on the modes; one step; the correction of its energy |
//! | [`events`] | where the force turns, ends or begins again |
//! | [`tangent`] | the first-order change by another bat |
//! | [`encounter`] | the equations; the result of an encounter |
//! | [`pressing`], [`flight`] | one touch; when do they touch again |
//! | [`collider`] | the whole encounter, until the ball is gone for good |
//! | [`abreast`] | the same for places side by side |
//! | [`power_law`] | the law of a baseball: how hard it pushes back |

pub mod each;
pub mod force_law;
pub mod collocation;
pub mod touch;
pub mod table;
pub mod step;
pub mod energy;
pub mod events;
pub mod tangent;
pub mod encounter;
pub mod pressing;
pub mod flight;
pub mod collider;
pub mod power_law;
pub mod abreast;
