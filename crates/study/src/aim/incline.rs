//! How steep may the changed surface become?
//!
//! A tool can follow a slope `|r′|` (mm of radius per mm along the bat) only up to a limit. Where the bat is steeper
//! already, as at its knob, it must not become steeper. The slope of the changed bat is linear in the change:
//!
//! ```text
//! −s ≤ r′ + ½ d′ ≤ s,   s = max(limit, |r′|)
//! ```
//!
//! The curve through rounded stations is off in slope by about the rounding of a station over the distance to the next
//! ([`Steepness::ripple`]): the search keeps that distance from the limit.

use crate::aim::wish::Grid;
use crate::engine::{Bat, Piece};

/// Distance between the places where the slope is checked (m).
const EVERY: f64 = 5e-3;
/// Number of places on every piece between stations at which the slope of the new bat is checked.
const LOOKS: usize = 16;
/// Room where the bat is that steep already, as a share of the ripple.
const STEEP_ALREADY: f64 = 0.1;
/// Half the difference for a slope, as a share of the piece.
const BESIDE: f64 = 1e-4;

/// A limit of the slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steepness {
    /// Greatest |r′|.
    pub most: f64,
    /// Possible error of the slope due to rounded stations.
    pub ripple: f64,
}

/// The allowed range at a place: of the change of the diameter (m), or of its slope (m per m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// The place (m).
    pub x: f64,
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

/// Places of a bat at most that far apart (m), both ends of every piece among them: the piece, the place on it, from 0
/// to 1, and the place on the bat (m).
pub fn places(bat: &Bat, every: f64) -> impl Iterator<Item = (&Piece, f64, f64)> {
    bat.profile().pieces.iter().flat_map(move |piece| {
        let count = (piece.length / every).ceil().max(1.0) as usize;
        let at = move |k: usize| k as f64 / count as f64;
        (0..=count).map(move |k| (piece, at(k), piece.start + at(k) * piece.length))
    })
}

impl Steepness {
    /// That limit, with stations on that grid.
    pub fn new(most: f64, grid: Grid) -> Self {
        Self { most, ripple: 0.75 * grid.round / grid.every }
    }

    /// Allowed slopes of a change, at the places of the bat where it changes.
    pub fn inclines(&self, bat: &Bat, changes: &dyn Fn(f64) -> bool) -> Vec<Room> {
        let room = |(piece, s, x): (&Piece, f64, f64)| {
            let now = slope(piece, s);
            let most = (self.most - self.ripple).max(now.abs() + STEEP_ALREADY * self.ripple);
            Room { x, low: -2.0 * (most + now), high: 2.0 * (most - now) }
        };
        places(bat, EVERY).filter(|(_, _, x)| changes(*x)).map(room).collect()
    }

    /// Largest excess of the new bat's slope over the allowed one; 0 if there is none.
    pub fn broken_by(&self, old: &Bat, new: &Bat) -> f64 {
        let at = |piece: &Piece, k: usize| {
            let s = (k as f64 + 0.5) / LOOKS as f64;
            let x = piece.start + s * piece.length;
            let before = old.profile().piece_at(x);
            let was = slope(before, (x - before.start) / before.length).abs();
            slope(piece, s).abs() - self.most.max(was + self.ripple)
        };
        let all =
            new.profile().pieces.iter().flat_map(|piece| (0..LOOKS).map(move |k| at(piece, k)));
        all.fold(0.0, f64::max)
    }
}

/// dr/dx at `s` in [0, 1] along a piece.
fn slope(piece: &Piece, s: f64) -> f64 {
    let [a, b] = [(s - BESIDE).max(0.0), (s + BESIDE).min(1.0)];
    (piece.at(b).outer - piece.at(a).outer) / ((b - a) * piece.length)
}
