//! How does a hollow barrel's own wall give way under a ball?
//!
//! Every hoop mode of the wall ([`crate::modes::hoop`]) is one more mode of the contact. What a harmonic has beyond its
//! kept modes follows the force at once. A ball presses on a patch, so that the sum over the harmonics ends:
//!
//! ```text
//! y″ + 2ζωy′ + ω²y = −c F       c = (g_n Ū)²/M of every mode (n, m), ζ = η/2
//! C_n = Σ c/ω²,  D_n = Σ c/ω⁴   over all modes of a harmonic, by statics
//! g_n = P(n a_t/r)/P(a_t/r)     P(k) = 3 (sin k − k cos k)/k³
//! ```
//!
//! A motion that goes as `cos nθ`, n ≠ 1, has neither momentum nor angular momentum: rigid motion and
//! bending stay as they are.

use std::f64::consts::TAU;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::base::error::Result;
use crate::bat::body::Bat;
use crate::collision::ball::Ball;
use crate::collision::contact::touch::DrivingPoint;
use crate::modes::compliance::taken;
use crate::modes::hoop::response::{Fineness, Response};
use crate::modes::hoop::{Patch, Share, rings};
use crate::motion::sound::WallTone;

/// Energy of all hoop modes of a harmonic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HarmonicEnergy {
    /// Number of waves around the barrel.
    pub harmonic: usize,
    /// Energy (J).
    pub energy_j: f64,
}

/// A hole that begins so near to the tip (m) is a cup in it, and the barrel is solid.
pub const CUP: f64 = 0.04;

/// The wall of a hollow barrel as balls of one size feel it.
#[derive(Debug, Clone)]
pub struct HoopWall {
    /// The bat whose wall it is.
    bat: Bat,
    ball_radius: f64,
    fineness: Fineness,
    response: Response,
    /// Harmonic, ω (rad/s) and damping ratio of every mode.
    modes: Vec<(usize, [f64; 2])>,
}

/// Modes and flexibility of a wall at one place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WallSeries {
    /// `c` of every hoop mode (1/kg).
    pub gains: Vec<f64>,
    /// Flexibility that is left (m/N).
    pub rest: f64,
}

/// The wall as a ball feels it at one place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WallFelt {
    /// All modes.
    pub full: WallSeries,
    /// `C_n` (m/N) of every harmonic.
    pub flexibility: Vec<(usize, f64)>,
    /// `Σ C_n` (m/N): deflection under the ball per force.
    pub soft: f64,
    /// `Σ D_n` (m s²/N).
    pub slow: f64,
    /// What of that the modes leave out (m s²/N).
    pub late: f64,
    /// Flexibility (m/N) that may be missing: of harmonics left out, by the modes' own errors, and by the
    /// elements close to the patch.
    pub unsure: f64,
}

impl WallSeries {
    /// The bat with these modes before its own, and this flexibility.
    pub fn before(&self, mut felt: DrivingPoint) -> DrivingPoint {
        felt.gains.splice(0..0, self.gains.iter().copied());
        felt.rest += self.rest;
        felt
    }
}

impl HoopWall {
    /// The wall of that bat for balls of that radius (m), for exit speeds within that share of the closing speed.
    ///
    /// # Errors
    ///
    /// As [`Response::of`].
    pub fn of(bat: &Bat, ball_radius: f64, tolerance: f64) -> Result<Arc<Self>> {
        Self::solved(bat, ball_radius, Fineness::for_exit_speed(tolerance))
    }

    fn solved(bat: &Bat, ball_radius: f64, fineness: Fineness) -> Result<Arc<Self>> {
        let response = Response::of(bat, fineness)?;
        let (bat, modes) = (bat.clone(), response.modes());
        Ok(Arc::new(Self { bat, ball_radius, fineness, response, modes }))
    }

    /// The wall of another bat to the same accuracy; of a bat with the same wall this one.
    ///
    /// # Errors
    ///
    /// As [`Response::of`].
    pub fn on(self: &Arc<Self>, bat: &Bat) -> Result<Arc<Self>> {
        let same = self.bat.profile() == bat.profile() && self.bat.layups() == bat.layups();
        if same { Ok(Arc::clone(self)) } else { Self::solved(bat, self.ball_radius, self.fineness) }
    }

    /// ω (rad/s) and damping ratio of every mode.
    pub fn modes(&self) -> Vec<[f64; 2]> {
        self.modes.iter().map(|(_, mode)| *mode).collect()
    }

    /// The lowest frequency of harmonic 2 (Hz).
    pub fn first_hz(&self) -> Option<f64> {
        let first = self.modes.iter().find(|(harmonic, _)| *harmonic == 2);
        first.map(|(_, [omega, _])| omega / TAU)
    }

    /// The harmonics that are counted.
    pub fn harmonics(&self) -> Vec<usize> {
        self.response.harmonics()
    }

    /// How far a frequency may be off, relative.
    pub fn off(&self) -> f64 {
        self.response.off()
    }

    /// From where to where the wall is modelled (m).
    pub fn ends(&self) -> [f64; 2] {
        self.response.ends()
    }

    /// The energies (J) of all modes, summed by harmonic.
    pub fn by_harmonic(&self, energies: &[f64]) -> Vec<HarmonicEnergy> {
        let mut all: Vec<HarmonicEnergy> = vec![];
        for ((harmonic, _), energy) in self.modes.iter().zip(energies) {
            match all.last_mut().filter(|known| known.harmonic == *harmonic) {
                Some(known) => known.energy_j += energy,
                None => all.push(HarmonicEnergy { harmonic: *harmonic, energy_j: *energy }),
            }
        }
        all
    }

    /// Where a ball that is compressed by that much (m) presses at `x` (m).
    pub fn patch(&self, x: f64, compression: f64) -> Patch {
        Patch::under(x, self.ball_radius, self.bat.profile().at(x).outer, compression)
    }

    /// The modes under a ball that presses at `x` (m), compressed by that much (m).
    pub fn tones(&self, x: f64, compression: f64) -> Vec<WallTone> {
        let shares = self.shares(x, compression).unwrap_or_default();
        let gains = shares.into_iter().flat_map(|share| share.gains);
        let tone = |((_, [omega, damping_ratio]), gain): (&(usize, [f64; 2]), f64)| WallTone {
            omega: *omega,
            damping_ratio: *damping_ratio,
            gain,
        };
        self.modes.iter().zip(gains).map(tone).collect()
    }

    /// How each harmonic gives way at `x` (m) under a ball that is compressed by that much (m); None where the
    /// modelled stretch ends.
    pub fn shares(&self, x: f64, compression: f64) -> Option<Vec<Share>> {
        let patch = self.patch(x, compression);
        self.response.covers(&patch).then(|| self.response.under(&patch))
    }

    /// The wall at `x` (m) under a ball that is compressed by that much (m). Where the modelled stretch
    /// ends it does not give way.
    pub fn under(&self, x: f64, compression: f64) -> WallFelt {
        let mut felt = WallFelt::default();
        let Some(shares) = self.shares(x, compression) else {
            let none = WallSeries { gains: vec![0.0; self.modes.len()], rest: 0.0 };
            return WallFelt { full: none, ..felt };
        };
        let mut from = 0;
        for share in shares {
            let own = &self.modes[from..from + share.gains.len()];
            from += share.gains.len();
            let [of_modes, of_slow] = taken(&share.gains, |k| own[k].1[0].powi(2));
            let local = (share.flexibility - of_modes).max(0.0);
            felt.full.gains.extend(share.gains);
            felt.full.rest += local;
            felt.late += (share.slowness - of_slow).max(0.0);
            // ω is off by a relative error, 1/ω² by twice that.
            felt.unsure += 2.0 * self.off() * of_modes + self.fineness.missed * local;
            felt.flexibility.push((share.harmonic, share.flexibility));
            felt.soft += share.flexibility;
            felt.slow += share.slowness;
        }
        let patch = self.patch(x, compression);
        let beyond = beyond(&felt.flexibility, &patch, self.response.radius(x));
        felt.full.rest += beyond;
        felt.soft += beyond;
        felt.unsure += BEYOND * beyond;
        felt
    }

    /// `Σ C_n` (m/N) and `Σ D_n` (m s²/N) at `x` (m), or where the modelled stretch is nearest to it, under a ball
    /// that is compressed by that much (m).
    pub fn somewhere(&self, x: f64, compression: f64) -> [f64; 2] {
        let [from, to] = self.ends();
        let from = from + self.patch(x, compression).half_length;
        let felt = self.under(x.max(from).min(to), compression);
        [felt.soft, felt.slow]
    }
}

/// Share of the flexibility of harmonics beyond the last that may be missing.
const BEYOND: f64 = 0.3;

impl PartialEq for HoopWall {
    /// Walls of one bat, for one ball, to one accuracy: their answers are equal.
    fn eq(&self, other: &Self) -> bool {
        (&self.bat, self.ball_radius, self.fineness)
            == (&other.bat, other.ball_radius, other.fineness)
    }
}

/// Flexibility (m/N) of the harmonics above the last that is counted: beside the share `g_n²` that the patch has in a
/// harmonic it goes on falling by the power of n of the last two.
fn beyond(flexibility: &[(usize, f64)], patch: &Patch, radius: f64) -> f64 {
    const FAR: usize = 60;
    let share = |n: usize| patch.share(n, radius).powi(2);
    let [.., (n, before), (last, soft)] = flexibility else { return 0.0 };
    // A patch may not drive a harmonic at all, as where a ring bends.
    let own = |n: usize, soft: f64| soft / share(n).max(1e-2);
    let (before, soft) = (own(*n, *before), own(*last, *soft));
    let fall = (before / soft).ln() / (*last as f64 / *n as f64).ln();
    let fall = if fall.is_finite() { fall.clamp(2.0, 4.0) } else { 4.0 };
    (last + 1..last + FAR).map(|n| soft * share(n) * (*last as f64 / n as f64).powf(fall)).sum()
}

/// The tones of a hollow barrel's wall under that ball, by place (m); None of a bat without a wall whose hoop modes can be
/// found.
pub fn heard(bat: &Bat, ball: &Ball) -> Option<impl Fn(f64) -> Vec<WallTone> + use<>> {
    let wall = rings(bat).then(|| HoopWall::of(bat, ball.radius_m, 1e-4).ok()).flatten()?;
    let compression = ball.patch_compression();
    Some(move |x: f64| wall.tones(x, compression))
}

/// How stiff the barrel's wall is under a ball (N/m), before anything is solved: the least of `3 E h^{5/2}
/// r^{−3/2}` over the outer half of the bat; None where that is solid.
///
/// # Source
///
/// A fit to hoop modes of bats with walls from 1.4 to 6 mm and a patch of a ball compressed by 8 mm, good to a
/// tenth.
pub fn rough_stiffness(bat: &Bat) -> Option<f64> {
    let stiffness = |[wall, x]: [f64; 2]| {
        let modulus = bat.layup(bat.profile().piece_at(x)).outer.youngs_modulus;
        3.0 * modulus * wall.powf(2.5) * bat.profile().at(x).outer.powf(-1.5)
    };
    barrel_walls(bat).into_iter().map(stiffness).min_by(f64::total_cmp)
}

/// Walls (m) of the outer half of the bat, where a ball is hit, and their places (m); none where that
/// half is solid. A bore with a core in it is hollow too; a cup in the tip is not.
pub fn barrel_walls(bat: &Bat) -> Vec<[f64; 2]> {
    const STRETCHES: usize = 200;
    let half = 0.5 * bat.length();
    let wall = |k: usize| {
        // Between the stations too, and not at the tip, where a cap is not a wall.
        let x = half + half * (k as f64 + 0.5) / STRETCHES as f64;
        let section = bat.profile().at(x);
        (section.inner > 0.0).then_some([section.outer - section.inner, x])
    };
    let walls: Vec<[f64; 2]> = (0..STRETCHES).filter_map(wall).collect();
    let hollow = walls.iter().any(|[_, x]| *x < bat.length() - CUP);
    if hollow { walls } else { vec![] }
}

/// Restitution of a ball on a wall that gives way, from that on a stiff one, `e = √((e_s² + s)/(1 + s))`,
/// `s = ½ (1 + α) k_ball/k_wall` the share of the energy that the wall stores and gives back: an
/// estimate, within 0.03, of a wall much lighter than the ball.
pub fn restitution_with_wall(stiff: f64, exponent: f64, ball_over_wall: f64) -> f64 {
    let share = 0.5 * (1.0 + exponent) * ball_over_wall;
    ((stiff * stiff + share) / (1.0 + share)).sqrt()
}

/// Whether the wall of a bat gives way in a hit by its own hoop modes.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum HoopInHit {
    /// There is no wall that could, or nothing was asked.
    #[default]
    None,
    /// There is one, and it is taken as rigid.
    LeftOut(WhyRigid),
    /// It does.
    Counted(Arc<HoopWall>),
}

/// Why a wall that could give way is taken as rigid.
#[derive(Debug, Clone, PartialEq)]
pub enum WhyRigid {
    /// So it was asked.
    Asked,
    /// The number of modes was told, and nothing else is counted.
    ModesTold,
    /// It would change the restitution by about that much, less than was asked for.
    Small {
        /// Estimated change.
        gain: f64,
        /// Accuracy that was asked for.
        tolerance: f64,
    },
    /// Many bats are compared that differ a little, and the wall of each would have to be solved.
    ManyBats,
    /// Its hoop modes could not be found, for that reason.
    Unsolved(String),
}

impl HoopInHit {
    /// What is done with the wall where many bats are compared: one that is counted is left rigid.
    pub fn left_out(&self) -> Self {
        match self {
            Self::Counted(_) => Self::LeftOut(WhyRigid::ManyBats),
            other => other.clone(),
        }
    }

    /// How far an exit speed may be off, relative to the closing speed, for a wall that was left out because it
    /// changes little.
    pub fn error(&self) -> f64 {
        /// Of the estimated change: at an open tip the wall gives way more than twice as far as within the barrel, for
        /// which the estimate is about twice too large.
        const AT_THE_TIP: f64 = 2.0;
        match self {
            Self::LeftOut(WhyRigid::Small { gain, .. }) => AT_THE_TIP * gain,
            _ => 0.0,
        }
    }

    /// The wall, where it gives way.
    pub fn wall(&self) -> Option<&Arc<HoopWall>> {
        match self {
            Self::Counted(wall) => Some(wall),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A limit: a stiff wall changes nothing, one that stores all gives all back.
    #[test]
    fn a_wall_returns_what_it_stores() {
        assert!((restitution_with_wall(0.5, 1.84, 0.0) - 0.5).abs() < 1e-15);
        assert!((restitution_with_wall(0.5, 1.84, 1e12) - 1.0).abs() < 1e-9);
    }

    /// Of harmonics that fall as the estimate assumes, what is beyond is stated within a few per cent.
    #[test]
    fn harmonics_left_out_are_estimated_from_the_last() {
        let (patch, radius) = (Patch::under(0.7, 0.0366, 0.0333, 0.008), 0.0333);
        let soft = |n: usize| 1e-8 * patch.share(n, radius).powi(2) * (n as f64).powi(-3);
        for last in [6, 8, 11] {
            let counted: Vec<(usize, f64)> = (2..=last).map(|n| (n, soft(n))).collect();
            let true_rest: f64 = (last + 1..400).map(soft).sum();
            let stated = beyond(&counted, &patch, radius);
            assert!((stated / true_rest - 1.0).abs() < 0.05, "{last} {stated:e} {true_rest:e}");
        }
    }
}
