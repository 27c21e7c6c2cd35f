//! How is the bat held: by supports, springs to the ground, and the bed of the hands?
//!
//! A contact restrains the deflection or the rotation of one place, `b(y) = w(x)` or `θ(x)`: to 0, or by a spring with
//! the energy `½ k b(y)²`. A bed restrains the deflection of a stretch with the energy `½ ∫k w² dx`.

use crate::enclosure::radii::NUMBER;
use sweetspot::base::Interval;
use sweetspot::bat::{Bat, Held};

/// A restraint of a deflection or a rotation.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// It is at the border before the piece, cell or stretch of this number.
    pub border: usize,
    /// Whether it restrains the rotation instead of the deflection.
    pub turning: bool,
    /// Stiffness of its spring (N/m or N m/rad); None of a support.
    pub stiffness: Option<Interval>,
}

/// The hands as an elastic bed.
#[derive(Debug, Clone, Copy)]
pub struct Bed {
    /// The borders at which it begins and ends, each before the piece, cell or stretch of this number.
    pub borders: [usize; 2],
    /// Force per deflection and per length (N/m²).
    pub stiffness: Interval,
}

/// The bed under a bat, if any, with the piece of the profile that begins at a place.
pub fn bed(bat: &Bat, piece_at: impl Fn(f64) -> usize) -> Option<Bed> {
    let grip = bat.fixtures().grip.filter(|grip| grip.stiffness > 0.0)?;
    let borders = [grip.from, grip.to].map(piece_at);
    Some(Bed { borders, stiffness: Interval::around(grip.stiffness, NUMBER) })
}

/// The contacts of a bat in the order of the solver, with the piece of the profile that begins at a place.
pub fn contacts(bat: &Bat, piece_at: impl Fn(f64) -> usize) -> Vec<Contact> {
    let fixtures = bat.fixtures();
    let supports = fixtures.supports.iter().flat_map(|support| {
        let kinds: &[bool] = if support.kind == Held::Clamped { &[false, true] } else { &[false] };
        kinds.iter().map(|turning| (support.x, *turning, None))
    });
    let springs = fixtures.attachments.iter().flat_map(|a| {
        let both = [(false, a.stiffness), (true, a.rotational_stiffness)];
        let some = both.into_iter().filter(|(_, stiffness)| *stiffness > 0.0);
        some.map(|(turning, stiffness)| (a.x, turning, Some(Interval::around(stiffness, NUMBER))))
    });
    let contact = |(x, turning, stiffness)| Contact { border: piece_at(x), turning, stiffness };
    supports.chain(springs).map(contact).collect()
}

/// The two contacts whose reactions follow from equilibrium. Any two that restrain both rigid motions are sufficient;
/// stiff ones that are far apart give narrow intervals. The first restrains a deflection.
///
/// `arm` gives the position of a contact (m). Below the stiffness `scale` of the bat (N/m), contacts count as equally
/// soft.
pub fn base(
    contacts: &[Contact],
    arm: impl Fn(&Contact) -> f64,
    length: f64,
    scale: f64,
) -> Option<[usize; 2]> {
    let soft = |contact: &Contact| {
        let over = contact.stiffness.map_or(0.0, |stiffness| 1.0 / stiffness.middle());
        if contact.turning { over * length * length } else { over }
    };
    let mut best: Option<([usize; 2], f64)> = None;
    for (i, a) in contacts.iter().enumerate().filter(|(_, a)| !a.turning) {
        for (j, b) in contacts.iter().enumerate().filter(|(j, _)| *j != i) {
            let apart = if b.turning { 1.0 } else { (arm(a) - arm(b)) / length };
            let cost = (soft(a) + soft(b) + 1.0 / scale) / (apart * apart);
            if cost.is_finite() && best.is_none_or(|(_, least)| cost < least) {
                best = Some(([i, j], cost));
            }
        }
    }
    best.map(|(pair, _)| pair)
}
