//! Between which numbers do the frequencies of the exact beam provably lie?
//!
//! [`guarantee`](guarantee::guarantee) gives intervals that contain the frequencies of the continuous beam, rounding
//! errors included, and proves that no mode is missing between them. The proof makes no assumption about the solver,
//! whose modes serve as trials; bad ones give wide intervals or none. `docs/proof.md` has the whole theorem.
//!
//! | file | question |
//! |---|---|
//! | [`radii`], [`sections`] | the radii from the file; the properties of sections along a cell |
//! | [`contacts`], [`gives`] | how the bat is held; its compliant parts |
//! | [`beam`] | the bat cell by cell, and the refused features |
//! | [`moved`], [`reactions`] | the motion of a trial, and the reactions in equilibrium with it |
//! | [`energies`] | Rayleigh quotient and residual of a trial |
//! | [`stretches`], [`holding`], [`norms`] | upper bounds of trace and norm of the compliance |
//! | [`conclude`](mod@conclude) | the eigenvalues that follow, without gaps |
//! | [`nodes`] | proven positions of nodes |
//! | [`trials`](mod@trials), [`guarantee`](mod@guarantee) | the trials; refinement to the requested width |
//! | [`within`] | every bat within given tolerances of this one |

#[doc(hidden)]
pub mod radii;
#[doc(hidden)]
pub mod sections;
#[doc(hidden)]
pub mod contacts;
#[doc(hidden)]
pub mod gives;
#[doc(hidden)]
pub mod beam;
#[doc(hidden)]
pub mod moved;
#[doc(hidden)]
pub mod reactions;
#[doc(hidden)]
pub mod energies;
#[doc(hidden)]
pub mod stretches;
#[doc(hidden)]
pub mod holding;
#[doc(hidden)]
pub mod norms;
#[doc(hidden)]
pub mod conclude;
#[doc(hidden)]
pub mod nodes;
#[doc(hidden)]
pub mod trials;
pub mod guarantee;
pub mod within;
