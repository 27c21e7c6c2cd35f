//! Hits at several places of one bat, computed side by side by the equations of
//! [`crate::collision::contact::encounter`].
//!
//! The lengths of the steps follow from their accuracy and the ball's exponent alone. All places therefore share the
//! tables of the steps, and a place has the same bits whatever the other lanes contain. The following are computed
//! alone: a place that needs shorter steps, a bat with damping or without modes, a ball whose law is not a power or
//! ends too steeply or not smoothly enough, and accuracies better than 2e-8.
//!
//! | file | question |
//! |---|---|
//! | [`schedule`] | how long are the steps |
//! | [`places`] | the state of ball and bat at every place; how hard does each ball push back |
//! | [`solve`] | which forces act in a step, and which motions do they cause |
//! | [`turn`] | where is the compression largest |
//! | [`energy`] | how is the energy put right |
//! | [`press`] | step after step to the largest compression and back; the release of the last force |
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
