//! What is the effect of a thinner or a thicker wall?

use serde::Serialize;

use crate::engine::{Bat, DiameterChange, Result};
use crate::trampoline::barrel::{Barrel, BarrelStruck};

/// Thicknesses that are tried, over that of the bat.
pub const FACTORS: [f64; 9] = [0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.7, 2.0];

/// The bat with another wall.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct WallTried {
    /// Thickness of the barrel's wall relative to the present one.
    pub factor: f64,
    /// Thickness of the wall under the ball (m).
    pub thickness_m: f64,
    /// Mass of the bat (kg).
    pub mass_kg: f64,
    /// First frequency of harmonic 2 (Hz).
    pub frequency_hz: f64,
    /// Stiffness of the wall under the ball (N/m).
    pub stiffness_n_m: f64,
    /// BBCOR with a rigid wall.
    pub stiff: f64,
    /// BBCOR with the wall.
    pub wall: f64,
    /// BBCOR with the patch of a ball compressed twice and half as much, the lesser first.
    pub range: [f64; 2],
    /// How deep the wall is dented (m).
    pub dent_m: f64,
}

/// The bat with walls of other thicknesses, by rising thickness: those that can be made and are hit. `tell` receives
/// the progress.
pub fn wall_sweep(bat: &Bat, known: &Barrel, tell: &dyn Fn(f64)) -> Vec<WallTried> {
    let struck = |bat: &Bat, factor: f64| match factor {
        1.0 => Some(known.struck.clone()),
        _ => BarrelStruck::of(bat, &known.test, None).ok(),
    };
    let tried = |(k, factor): (usize, f64)| {
        tell(k as f64 / FACTORS.len() as f64);
        let other = with_wall(bat, known, factor).ok()?;
        let BarrelStruck { first_hz: first, wall, rebound } = struck(&other, factor)?;
        let (wall, rebound) = (wall?, rebound?);
        Some(WallTried {
            factor,
            thickness_m: wall.thickness_m,
            mass_kg: other.inertia().mass,
            frequency_hz: first?,
            stiffness_n_m: wall.stiffness_n_m,
            stiff: rebound.stiff,
            wall: rebound.wall,
            range: rebound.range,
            dent_m: rebound.dent_m,
        })
    };
    FACTORS.into_iter().enumerate().filter_map(tried).collect()
}

/// The bat with a barrel wall this many times as thick under the ball, and an unchanged surface: the same thickness is
/// added or removed all over the barrel, and less and less of it down the taper.
///
/// # Errors
///
/// As [`Bat::bored`].
pub fn with_wall(bat: &Bat, known: &Barrel, factor: f64) -> Result<Bat> {
    let (from, to) = (known.hoop().from(), bat.length());
    let section = bat.profile().at(known.test.at);
    let full = full_barrel(bat, [from, known.test.at]);
    // A thicker wall reduces the bore's diameter on both sides.
    let by = -2.0 * (factor - 1.0) * (section.outer - section.inner);
    let barrel = DiameterChange::band([full, to], by);
    if full - from <= 1e-9 * to {
        return bat.bored(&barrel);
    }
    let taper = DiameterChange::through(&[from, full], |x| by * (x - from) / (full - from));
    bat.bored(&DiameterChange::sum(&[(1.0, &taper), (1.0, &barrel)]))
}

/// End of the taper (m): from there to `at` the bat is as thick as at `at`, to a thousandth.
fn full_barrel(bat: &Bat, [from, at]: [f64; 2]) -> f64 {
    const AS_THICK: f64 = 0.999;
    let profile = bat.profile();
    let least = AS_THICK * profile.at(at).outer;
    // A border between pieces is where a drawing has the end of the taper.
    let mut borders = profile.borders();
    borders.retain(|x| *x > from && *x < at);
    let thick = |x: &&f64| profile.at(**x).outer >= least;
    borders.iter().find(thick).copied().unwrap_or(at)
}
