//! Places of one bat that are hit side by side, by the equations of [`crate::collision::contact::encounter`].
//!
//! The lengths of the steps follow from their accuracy and the ball's exponent alone, so that all places share the
//! tables of the steps, and a place has the same bits whatever is in the other lanes. These are met alone: a place whose
//! steps would have to be shorter, a bat with damping or without modes, a ball whose law is no power or ends too steeply
//! or not smoothly enough, and accuracies better than 2e-8.
//!
//! | file | question |
//! |---|---|
//! | [`schedule`] | how long are the steps |
//! | [`places`] | what is known of the places, and how hard does each ball push back |
//! | [`solve`] | which forces act in a step, and what do they do to the motions |
//! | [`turn`] | where is the compression largest |
//! | [`energy`] | how is the energy put right |
//! | [`press`] | step after step there and back; what is left when the force has gone |
//! | [`gradient`] | how does the impulse change with the bat |
//! | [`meet`] | the whole encounter, place by place |

pub mod schedule;
pub mod places;
pub mod solve;
pub mod turn;
pub mod energy;
pub mod press;
pub mod gradient;
pub mod meet;
