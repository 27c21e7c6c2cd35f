//! What is to be known of a bat before it is solved?
//!
//! [`prepare`] chooses the theory that a request leaves open, and makes the bat as stiff as it was tapped.

use std::borrow::Cow;

use crate::base::error::Result;
use crate::bat::body::Bat;
use crate::bat::theory::Theory;
use crate::modes::request::Request;
use crate::modes::theory_choice;
use crate::modes::tuned::tuned;

/// A bat to be solved, and how.
#[derive(Debug, Clone)]
pub struct Prepared<'a> {
    /// The bat as stiff as it was tapped.
    pub bat: Cow<'a, Bat>,
    /// The request with its theory named.
    pub request: Request,
    /// A warning that shear matters but no shear modulus is known; None otherwise.
    pub warning: Option<String>,
}

/// Prepares a bat as [`crate::modes::solve::solve`] does. What is prepared is not prepared again: who solves
/// one bat many times, or changes of a tapped bat, does it once.
///
/// The theory is [`theory_choice::theory`]'s where the request says [`Theory::Auto`]; the moduli are those with
/// which the first bending mode has the frequency of the tap ([`tuned`]). With a named theory and no tap
/// nothing is computed.
///
/// # Errors
///
/// Those of [`Request::check`], of [`theory_choice::theory`] and of [`tuned`].
pub fn prepare<'a>(bat: &'a Bat, request: &Request) -> Result<Prepared<'a>> {
    let (mut request, mut warning) = (*request, None);
    if request.theory == Theory::Auto {
        let choice = theory_choice::theory(bat, &request)?;
        (request.theory, warning) = (choice.theory, choice.warning);
    }
    let bat = match bat.tap() {
        None => Cow::Borrowed(bat),
        Some(_) => {
            request.check(1)?;
            Cow::Owned(tuned(bat.clone(), request.theory, request.tolerance)?)
        }
    };
    Ok(Prepared { bat, request, warning })
}
