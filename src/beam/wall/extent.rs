//! Which stretch of a bat is modelled as a wall?

use crate::base::{Error, Result};
use crate::bat::{Bat, Material, Piece, Section};

/// The stretch that is modelled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Where it begins, in the handle (m).
    pub from: f64,
    /// Where it ends, at the tip (m).
    pub to: f64,
    /// Why it begins there and not nearer to the knob.
    pub limit: Limit,
}

/// What limits the stretch on the knob side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// The modes of the barrel have died out in the handle.
    Handle,
    /// The knob end of the bat.
    Knob,
    /// A step at which the walls do not meet.
    Step,
    /// Wood, whose stiffness along the grain has no symmetry of revolution.
    Wood,
}

/// Number of places at which a piece is checked.
const PLACES: usize = 8;
/// The handle ends where the radius has grown by this share of its growth from handle to barrel.
const GROWN: f64 = 0.005;

/// Whether a bat has a wall that can ring: hollow somewhere, and not of wood there.
pub fn rings(bat: &Bat) -> bool {
    bat.profile().pieces.iter().any(|piece| is_wall(bat, piece))
}

/// Whether it has a bore; no wall is thinner than a millionth of the radius.
fn is_hollow(piece: &Piece) -> bool {
    let walled = |at: Section| at.inner > 0.0 && at.outer - at.inner > 1e-6 * at.outer;
    [0.0, 0.5, 1.0].iter().any(|s| walled(piece.at(*s)))
}

/// Whether a material counts as wood and its stiffness in other directions is not given.
pub fn is_wood(material: &Material) -> bool {
    material.scatter().is_some() && material.hoop_modulus.is_none()
}

fn is_wall(bat: &Bat, piece: &Piece) -> bool {
    is_hollow(piece) && !bat.layup(piece).materials().any(is_wood)
}

impl Extent {
    /// The stretch from the handle to the tip; it begins `lead` times the handle's radius before the taper.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a solid bat, or one with a wall of wood.
    pub fn of(bat: &Bat, lead: f64) -> Result<Self> {
        let pieces = &bat.profile().pieces;
        let widest = |piece: &Piece| {
            [0.0, 0.5, 1.0].map(|s| piece.at(s).outer).into_iter().fold(0.0, f64::max)
        };
        let walls = pieces.iter().enumerate().filter(|(_, piece)| is_wall(bat, piece));
        let barrel = walls.max_by(|(_, a), (_, b)| widest(a).total_cmp(&widest(b)));
        let Some((barrel, _)) = barrel else {
            return Err(if pieces.iter().any(is_hollow) {
                let expected = "a wall of metal or of a composite: wood differs with the direction \
                                of its grain, so that its wall is no solid of revolution";
                Error::value("material", "a hollow bat of wood", expected)
            } else {
                Error::value(
                    "profile",
                    "a solid bat, or a wall below a millionth of its radius",
                    "a hollow one: only a wall has hoop modes",
                )
            });
        };
        let (mut first, mut limit) = (0, Limit::Knob);
        for k in (0..barrel).rev() {
            let (left, right) = (pieces[k].ends()[1], pieces[k + 1].ends()[0]);
            let (a, b) =
                (inside(bat, &pieces[k], left.inner), inside(bat, &pieces[k + 1], right.inner));
            let common = left.outer.min(right.outer) - a.max(b);
            let parted = common <= 1e-3 * (left.outer - a).min(right.outer - b);
            let wood = bat.layup(&pieces[k]).materials().any(is_wood);
            if parted || wood {
                (first, limit) = (k + 1, if wood { Limit::Wood } else { Limit::Step });
                break;
            }
        }
        let start = pieces[first].start;
        let places = pieces[first..=barrel].iter().flat_map(|piece| {
            (0..=PLACES).map(|k| {
                let s = k as f64 / PLACES as f64;
                (piece.start + s * piece.length, piece.at(s).outer)
            })
        });
        // Beyond the widest place a tube may taper too, but that part is not a handle.
        let mut places: Vec<(f64, f64)> = places.collect();
        let widest = (0..places.len()).rev().max_by(|a, b| places[*a].1.total_cmp(&places[*b].1));
        places.truncate(widest.map_or(0, |widest| widest + 1));
        let least = places.iter().map(|place| place.1).fold(f64::INFINITY, f64::min);
        let most = places.iter().map(|place| place.1).fold(0.0, f64::max);
        let to = bat.length();
        if least > 0.9 * most {
            return Ok(Self { from: start, to, limit });
        }
        let thin = places.iter().rfind(|(_, r)| *r <= least + GROWN * (most - least));
        let from = thin.map_or(start, |(x, r)| x - lead * r);
        match from > start {
            true => Ok(Self { from, to, limit: Limit::Handle }),
            false => Ok(Self { from: start, to, limit }),
        }
    }
}

/// Inner radius of a piece's section: 0 if the bore is filled.
fn inside(bat: &Bat, piece: &Piece, inner: f64) -> f64 {
    if bat.layup(piece).core.is_some() { 0.0 } else { inner }
}
