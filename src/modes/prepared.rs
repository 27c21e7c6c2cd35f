//! What is determined about a bat before it is solved?
//!
//! [`prepare`] chooses the theory if the request leaves it open, and fits the moduli to the tapped frequency.

use std::borrow::Cow;

use crate::base::Result;
use crate::bat::{Bat, Theory};
use crate::modes::request::Request;
use crate::modes::theory_choice;
use crate::modes::tuned::tuned;

/// A bat ready to be solved, and its request.
#[derive(Debug, Clone)]
pub struct Prepared<'a> {
    /// The bat with moduli fitted to the tap.
    pub bat: Cow<'a, Bat>,
    /// The request with its theory named.
    pub request: Request,
    /// A warning that shear matters but no shear modulus is known; None otherwise.
    pub warning: Option<String>,
}

/// Prepares a bat as [`crate::modes::solve::solve`] does. A prepared bat is not prepared again, so a caller that solves
/// one bat many times, or variations of a tapped bat, prepares once.
///
/// The theory is that of [`theory_choice::theory`] if the request says [`Theory::Auto`]. The moduli are those for which
/// the first bending mode has the frequency of the tap ([`tuned`]). With a named theory and no tap nothing is computed.
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
