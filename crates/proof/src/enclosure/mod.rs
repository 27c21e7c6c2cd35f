//! Between which numbers do the frequencies of the exact beam lie, proven?
//!
//! [`guarantee`](guarantee::guarantee) answers with intervals that hold the frequencies of the continuous beam, rounding
//! included, and says that none is missing between them. Nothing is assumed of the solver: its motions are
//! trials, and bad ones give wide intervals or none. `docs/proof.md` has the theorem in one piece.
//!
//! | file | question |
//! |---|---|
//! | [`radii`], [`sections`] | which radii does the file tell; what are sections worth along a cell |
//! | [`contacts`], [`gives`] | what holds the bat; what on it gives way |
//! | [`beam`] | the bat cell by cell, and what is refused |
//! | [`moved`], [`reactions`] | the motion of a trial, and what holds it in balance |
//! | [`energies`] | Rayleigh quotient and residual of a trial |
//! | [`stretches`], [`holding`], [`norms`] | trace and norm of the compliance, at most |
//! | [`conclude`](mod@conclude) | which eigenvalues follow, none missing |
//! | [`nodes`] | where is a node, proven |
//! | [`trials`](mod@trials), [`guarantee`](mod@guarantee) | which motions are tried; as narrow as asked |
//! | [`within`] | every bat within so much of this one |

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
