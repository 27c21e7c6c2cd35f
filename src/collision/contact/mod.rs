//! What happens while ball and bat touch?
//!
//! | file | question |
//! |---|---|
//! | [`each`] | one number for each of some places; powers and angles of them |
//! | [`force_law`] | what does a contact ask of a ball's law |
//! | [`collocation`] | the points of a step and the modes' exact answer to a force through them |
//! | [`touch`] | what is felt at the place; the state of ball and bat |
//! | [`table`], [`step`], [`energy`] | what a step does to the modes; one step; its energy put right |
//! | [`events`] | where the force turns, ends or begins again |
//! | [`tangent`] | what would another bat change, to first order |
//! | [`encounter`] | the equations; what an encounter leaves behind |
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
