//! How stiff is a bat whose first frequency was tapped?
//!
//! [`tuned`] finds the one factor on all its moduli.

use crate::base::{Error, Result};
use crate::bat::{Bat, Theory};
use crate::modes::mode::Mode;
use crate::modes::refine::refine;
use crate::modes::request::Request;
use crate::modes::theory_choice;

/// The bat with one factor on every E and G, so that its first bending mode has the tapped frequency. A bat without a
/// tap, or already fitted, is returned unchanged.
///
/// The frequencies of a free bat are proportional to the square root of the factor, so one step finds it; springs,
/// joints and hands do not grow with it. The exponent of a frequency is the share of the bat's own strain energy in the
/// mode's, which two solutions give. The first bending mode is the first one with a share of at least a half, not a
/// mode in which the bat moves rigidly on its springs.
///
/// # Errors
///
/// [`Error::Value`] if no factor gives that frequency; those of [`crate::modes::solve::solve`]; [`Error::Value`] for a
/// bat that was changed by [`Bat::with`] after its edits, since the tap belongs to the bat before them: tune first,
/// then change.
pub fn tuned(mut bat: Bat, theory: Theory, tolerance: f64) -> Result<Bat> {
    const MOST_STEPS: usize = 60;
    const STIFFER: f64 = 1.01;
    let Some(tapped) = bat.tap() else { return Ok(bat) };
    if !bat.edits().is_empty() {
        return edited(&bat, theory, tolerance);
    }
    let theory = theory_choice::of(&bat, &Request { tolerance, theory, ..Request::default() })?;
    let tolerance = (0.01 * tolerance).clamp(1e-12, 1e-6);
    // Hands and springs leave at most two slow rigid modes; each absorber adds one more.
    let held = bat.fixtures().holding() || !bat.fixtures().absorbers.is_empty();
    let modes = if held { 3 + bat.fixtures().absorbers.len() } else { 1 };
    let request = Request { modes, tolerance, theory, ..Request::default() };
    let (mut low, mut high) = (0.0_f64, f64::INFINITY);
    let mut nearest = 0.0_f64;
    for _ in 0..MOST_STEPS {
        let here = refine(&bat, &request)?;
        let mut stiffer = bat.clone();
        stiffer.scale(1.0, STIFFER);
        let there = refine(&stiffer, &request)?;
        let share = |(a, b): (&Mode, &Mode)| 2.0 * (b.omega / a.omega).ln() / STIFFER.ln();
        let shares: Vec<f64> = here.modes.iter().zip(&there.modes).map(share).collect();
        let bending = first_bending(&shares);
        let found = here.modes[bending].frequency();
        let ratio = tapped / found;
        if nearest == 0.0 || ratio.ln().abs() < (tapped / nearest).ln().abs() {
            nearest = found;
        }
        // As close as the round-off of the frequency, or half of --tol.
        let known = here.modes[bending].error.total().min(50.0 * tolerance);
        if (ratio - 1.0).abs() <= known.max(2.0 * tolerance) {
            bat.heard();
            return Ok(bat);
        }
        // Newton's step in logarithms, within the bounds already known to be too soft or too stiff.
        let now = bat.factors()[1];
        if ratio > 1.0 {
            low = low.max(now)
        } else {
            high = high.min(now)
        }
        let step = ratio.powf(2.0 / shares[bending].max(0.02)).clamp(1e-4, 1e4);
        let mut next = now * step;
        if !(next > low && next < high) && low > 0.0 && high.is_finite() {
            next = (low * high).sqrt();
        }
        if !(1e-9..1e9).contains(&next) || next == now {
            break;
        }
        bat.scale(1.0, next / now);
    }
    let found = format!("{tapped} Hz; the nearest one that was reached is {nearest:.6} Hz");
    let expected = match bat.fixtures().absorbers.is_empty() {
        true if bat.fixtures().holding() => "that of the bat in firm hands, below a loose tap's",
        true => "a first bending frequency that a stiffer or softer bat of that kind can have",
        false => "a first bending frequency with the absorber, which takes one near its own away",
    };
    Err(Error::value("weighed.first_bending_hz", found, expected))
}

/// The first mode in which the bat's own strain energy has a share of at least a half; otherwise the mode with the
/// largest share.
fn first_bending(shares: &[f64]) -> usize {
    shares.iter().position(|share| *share >= 0.5).unwrap_or_else(|| {
        let larger = |a: &usize, b: &usize| shares[*a].total_cmp(&shares[*b]);
        (0..shares.len()).max_by(larger).unwrap_or(0)
    })
}

/// The edited bat, with the moduli that the bat before its edits has after the tap.
fn edited(bat: &Bat, theory: Theory, tolerance: f64) -> Result<Bat> {
    let named = |other: Bat| other.with(|parts| bat.name().clone_into(&mut parts.name));
    let again = bat.unedited().edited(bat.edits())?;
    let figures = |bat: &Bat| {
        let (inertia, modulus) = (bat.inertia(), bat.material().youngs_modulus);
        [inertia.mass, inertia.balance_point, inertia.about_balance, modulus, bat.length()]
    };
    let same = |(a, b): (f64, f64)| (a - b).abs() <= 1e-9 * b.abs();
    if !figures(&again).into_iter().zip(figures(bat)).all(same) {
        let found = "a tap of the bat before its edits, and a change after them";
        let expected = "a bat that is tuned first (modes::prepared::prepare) and then changed";
        return Err(Error::value("weighed.first_bending_hz", found, expected));
    }
    named(tuned(bat.unedited().clone(), theory, tolerance)?.edited(bat.edits())?)
}
