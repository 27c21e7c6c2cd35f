//! How does the bat ring, as accurately as asked?
//!
//! [`solve()`](solve::solve) plans elements for a tolerance, states every error, and refines until these are within it.
//! Calls go from `solve` to `refine`, `task`, `pairs`, `eigenpairs` and [`Lanczos`](crate::eigen::lanczos).
//!
//! | file | question |
//! |---|---|
//! | [`survey`], [`stations`], [`plan`] | how does the wave number vary along the bat; what is the cost of an element over a station; which elements does a tolerance need |
//! | [`eigenpairs`] | the lowest modes on one mesh, one bat or several side by side |
//! | [`shape`], `landmarks`, `certainty`, [`mode`] | a deflection at a place, its zeros and peaks, and which zeros are certain; frequency, nodes and modal mass of a mode |
//! | [`certificate`], [`referee`] | how far may each be off; what do other solvers say |
//! | [`pairs`] | the lowest modes whatever the degree of the elements |
//! | `memory`, [`request`], [`solution`], [`task`], `refine` | what is asked and how much memory it takes; what is answered; the modes on one mesh; the modes of a prepared bat |
//! | [`shifts`], [`theory_choice`], [`tuned`], [`prepared`] | what do rotary inertia and shear do to the frequencies; which theory does a bat need; how stiff is the wood, by a tap; both at once |
//! | [`solve`](mod@solve), [`up_to`], [`batch`] | solve to a tolerance; up to a frequency; many bats |
//! | [`compliance`] | how far does a force deflect the bat at a place |
//! | [`pole`], [`reduced`], `driven`, `free_motions`, [`shares`], [`damping`] | a few modes with dashpots: their response to a force; where a mode's energy is; their decay |
//! | [`hoop`] | how the wall of a hollow bat rings |

pub mod shape;
pub(crate) mod landmarks;
pub(crate) mod certainty;
pub mod mode;
#[doc(hidden)]
pub mod eigenpairs;
#[doc(hidden)]
pub mod referee;
#[doc(hidden)]
pub mod pairs;
#[doc(hidden)]
pub mod compliance;
#[doc(hidden)]
pub mod pole;
#[doc(hidden)]
pub mod reduced;
pub(crate) mod driven;
pub(crate) mod free_motions;
pub mod shares;
pub mod damping;
#[doc(hidden)]
pub mod certificate;
#[doc(hidden)]
pub mod survey;
#[doc(hidden)]
pub mod stations;
pub mod plan;
pub(crate) mod memory;
pub mod request;
pub mod solution;
#[doc(hidden)]
pub mod task;
pub(crate) mod refine;
pub mod shifts;
pub mod theory_choice;
pub mod tuned;
pub mod prepared;
pub mod solve;
pub mod up_to;
pub mod batch;
pub mod hoop;
