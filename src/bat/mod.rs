//! What bat is this?
//!
//! A [`profile`] of radii along the length, of one [`material`] or several, with what is fixed to it and
//! what holds it, becomes a [`Bat`](body::Bat): its mass, balance point and swing weight.
//!
//! | file | question |
//! |---|---|
//! | [`material`], [`theory`] | how stiff and heavy is the wood; which beam theory |
//! | `pchip`, [`formula`], `formula_range` | how does the radius go between stations; as a formula of x |
//! | [`profile`], `formula_bounds`, `formula_profile`, `tip` | the radii along the length; features of a formula; pointed ends |
//! | [`layup`] | what is the section worth: stiffness and mass per length |
//! | [`fixtures`], `part`, `fixtures_check` | masses, springs, supports, grips, joints; their numbers; are they possible |
//! | [`body`] | the whole bat |

pub mod material;
pub mod theory;
pub(crate) mod pchip;
pub mod formula;
pub(crate) mod formula_range;
pub(crate) mod tip;
pub mod profile;
pub(crate) mod formula_bounds;
pub(crate) mod formula_profile;
pub mod layup;
pub mod fixtures;
pub(crate) mod part;
pub(crate) mod fixtures_check;
pub mod body;
