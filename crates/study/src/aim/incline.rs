//! How steep may the surface become where it is changed?
//!
//! A tool follows a slope `|r′|` (mm of radius per mm along the bat) only so far. Where the bat is steeper
//! already, as at its knob, it becomes no steeper. The slope of the changed bat is linear in the change:
//!
//! ```text
//! −s ≤ r′ + ½ d′ ≤ s,   s = max(limit, |r′|)
//! ```
//!
//! Stations that are rounded make a curve whose slope is off by about what a station is rounded by, over the
//! distance to the next ([`Steepness::ripple`]): the search keeps so far inside.

use crate::aim::wish::Grid;
use sweetspot::bat::body::Bat;
use sweetspot::bat::profile::Piece;

/// Distance of the places where the slope is asked (m).
const EVERY: f64 = 5e-3;
/// Places on every piece between stations at which the slope of the new bat is looked at.
const LOOKS: usize = 16;
/// Where the bat is as steep already there is so much room, as a share of the ripple.
const STEEP_ALREADY: f64 = 0.1;
/// Half a difference by which a slope is found, as a share of the piece.
const BESIDE: f64 = 1e-4;

/// A limit of the slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steepness {
    /// Greatest |r′|.
    pub most: f64,
    /// How far rounded stations may put the slope off.
    pub ripple: f64,
}

/// What the slope of the change of the diameter may be at a place (m per m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incline {
    /// The place (m).
    pub x: f64,
    /// Least slope.
    pub low: f64,
    /// Greatest slope.
    pub high: f64,
}

impl Steepness {
    /// That limit, with stations on that grid.
    pub fn new(most: f64, grid: Grid) -> Self {
        Self { most, ripple: 0.75 * grid.round / grid.every }
    }

    /// What the slope of a change may be, at the places of the bat where it changes.
    pub fn inclines(&self, bat: &Bat, changes: &dyn Fn(f64) -> bool) -> Vec<Incline> {
        let mut all = vec![];
        for piece in &bat.profile().pieces {
            let count = (piece.length / EVERY).ceil().max(1.0) as usize;
            for k in 0..=count {
                let s = k as f64 / count as f64;
                let x = piece.start + s * piece.length;
                if changes(x) {
                    let now = slope(piece, s);
                    let room = STEEP_ALREADY * self.ripple;
                    let most = (self.most - self.ripple).max(now.abs() + room);
                    all.push(Incline { x, low: -2.0 * (most + now), high: 2.0 * (most - now) });
                }
            }
        }
        all
    }

    /// How much steeper the new bat is anywhere than it may be; 0 where it is not.
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

    /// The greatest slope of a bat where it was not as steep before.
    pub fn found(&self, old: &Bat, new: &Bat) -> f64 {
        self.most + self.broken_by(old, new)
    }
}

/// dr/dx at `s` in [0, 1] along a piece.
fn slope(piece: &Piece, s: f64) -> f64 {
    let [a, b] = [(s - BESIDE).max(0.0), (s + BESIDE).min(1.0)];
    (piece.at(b).outer - piece.at(a).outer) / ((b - a) * piece.length)
}
