//! What bat is this?
//!
//! A [`profile`] of radii along the length, one [`material`] or several, and fixtures become a [`Bat`] with
//! its mass, balance point and swing weight.
//!
//! | file | question |
//! |---|---|
//! | [`material`], [`theory`] | how stiff and heavy is the wood; which beam theory |
//! | `pchip` | how does the radius run between stations |
//! | `formula_tree`, `formula_text`, [`formula`], `formula_range` | a formula's parts, how it is read, its value and corners, its range |
//! | [`stations`], [`profile`], `formula_bounds`, `formula_profile`, `tip` | where it was measured; the radii along the length; features of a formula; pointed ends |
//! | [`layup`], `slopes` | stiffness and mass per length of a section; their derivatives by the radii |
//! | `rework` | the radii where wood is turned off, drilled out or sawn off |
//! | [`fixtures`], [`weighed`], [`edit`] | masses, springs, supports, grips, joints; what a scale and a tap said; what is changed after that |
//! | `part`, `members`, `fixtures_check` | a member's value; the members of each of these; are they possible |
//! | [`inertia`], [`body`], `doubts` | a rigid body; the whole bat; what is unusual about it |
//! | `edited`, [`turned`] | a bat after its edits; one whose diameter is changed by a curve |

pub mod material;
pub mod theory;
pub(crate) mod pchip;
pub(crate) mod formula_tree;
mod formula_text;
pub mod formula;
pub(crate) mod formula_range;
pub(crate) mod tip;
pub mod stations;
pub mod profile;
pub(crate) mod formula_bounds;
pub(crate) mod formula_profile;
pub(crate) mod rework;
pub mod layup;
pub(crate) mod slopes;
pub mod fixtures;
pub mod weighed;
pub mod edit;
#[doc(hidden)]
pub mod part;
mod members;
pub(crate) mod fixtures_check;
pub mod inertia;
pub mod body;
mod doubts;
mod edited;
pub mod turned;

pub use body::{Bat, STANDARD_PIVOT};
pub use edit::{Bore, Change, Cork, Cup, Cut, Edit, ScaleDiameter, Shorten, Sleeve};
pub use fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Joint, Region, Support, Tape};
pub use layup::{Layer, Layup, Worth};
pub use material::{BUILT_IN, Material, PoissonRatios, Scatter, ShearModuli};
pub use profile::{FormulaPiece, Interpolation, Piece, Profile, Radii, Section, Stations};
pub use {formula::Formula, inertia::Inertia, theory::Theory, weighed::Weighed};
#[doc(hidden)]
pub use {profile::Cubics, profile::SAME_PLACE, turned::DiameterChange};
