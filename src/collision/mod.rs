//! What do ball and bat do when they meet, and where is the sweet spot?
//!
//! Describe swing and pitch in a [`hit::Scene`]. [`sweep::sweep`] then strikes the bat at all places, with as many
//! modes as the accuracy needs. A [`hitter::Hitter`] strikes it anywhere else. [`sweet_spot::SweetSpot::find`] searches
//! for the best places, and [`figures::Figures`] has the other figures of catalogues. [`aftermath`] continues after the
//! ball has left.
//!
//! | module | question |
//! |---|---|
//! | [`contact`] | how hard does a ball push back; what happens while they touch, and when do they touch again |
//! | [`ball`] | what ball |
//! | [`struck`], [`hoop_wall`] | how far does the bat deflect under a ball, anywhere; how far does a barrel's wall |
//! | [`rigid`], [`energy_loss`], [`pulse`] | the simpler models: no bending, an empirical loss, a known pulse |
//! | [`columns`] | which figures of a hit are written, and under which names |
//! | [`wall_choice`], [`setup`] | does the wall deflect in this hit; how is a bat hit, before the bat is known |
//! | [`history`], [`hit`], [`hitter`], [`answer`], [`strike`], [`along`], [`sweep`](mod@sweep) | the force in time; what is a hit; what does each model say of it; at one place; along the barrel |
//! | [`sweet_spot`], [`wall_figures`], [`figures`] | where is the sweet spot, what does the wall do, by which figures are bats compared |
//! | [`stated`] | what is the error of an exit speed |
//! | [`swing`], [`batch`] | all of it in one call; the exit speeds of many bats |
//! | [`bbcor`] | what would a laboratory's test give |
//! | [`aftermath`], [`strength`] | what do the hands and the wood experience, does the bat break |

#[doc(hidden)]
pub mod contact;
pub mod ball;
#[doc(hidden)]
pub mod struck;
pub mod hoop_wall;
pub mod rigid;
pub mod energy_loss;
pub mod pulse;
pub mod aftermath;
pub mod history;
pub mod hit;
#[doc(hidden)]
pub mod columns;
#[doc(hidden)]
pub mod stated;
pub mod hitter;
#[doc(hidden)]
pub mod answer;
#[doc(hidden)]
pub mod strike;
pub mod strength;
pub mod sweet_spot;
pub mod wall_figures;
pub mod figures;
pub mod wall_choice;
pub mod setup;
#[doc(hidden)]
pub mod along;
pub mod sweep;
pub mod batch;
pub mod swing;
pub mod bbcor;

pub use contact::{collider::Law, collider::LawTerms, force_law::ForceLaw, force_law::Top};
pub use hit::{Effort, Impact, Model, Outcome, Scene};
pub use {ball::Ball, ball::LawOf, hitter::Hitter, sweep::Sweep};
pub use {sweet_spot::SweetSpot, swing::Hit, swing::Swing};
