//! How far does a hollow barrel's wall deflect under a ball?
//!
//! Every hoop mode of the wall ([`crate::modes::hoop`]) is an additional mode of the contact. The part of a harmonic
//! beyond its kept modes follows the force at once. A ball presses on a patch, so the sum over the harmonics converges:
//!
//! ```text
//! y″ + 2ζωy′ + ω²y = −c F       c = (g_n Ū)²/M of every mode (n, m), ζ = η/2
//! C_n = Σ c/ω²,  D_n = Σ c/ω⁴   over all modes of a harmonic, by statics
//! g_n = P(n a_t/r)/P(a_t/r)     P(k) = 3 (sin k − k cos k)/k³
//! ```
//!
//! A motion as `cos nθ`, n ≠ 1, has neither momentum nor angular momentum: rigid motion and bending are unaffected.

use std::f64::consts::TAU;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::base::Result;
use crate::bat::Bat;
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

/// A hole that begins this close to the tip (m) is a cup, and the barrel is solid.
const CUP: f64 = 0.04;

/// The wall of a hollow barrel under balls of one size.
#[derive(Debug, Clone)]
pub struct HoopWall {
    /// The bat with this wall.
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
    /// The remaining flexibility (m/N).
    pub rest: f64,
}

/// The wall under a ball at one place.
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
    /// The part of that beyond the modes (m s²/N).
    pub late: f64,
    /// Flexibility (m/N) that may be missing beyond the modes: that of omitted harmonics, and that due to the error of
    /// the elements close to the patch.
    pub unsure: f64,
}

impl WallSeries {
    /// The driving point with these modes before its own, and with this flexibility.
    pub fn before(&self, mut felt: DrivingPoint) -> DrivingPoint {
        felt.gains.splice(0..0, self.gains.iter().copied());
        felt.rest += self.rest;
        felt
    }
}

impl HoopWall {
    /// The wall of that bat for balls of that radius (m), for exit speeds to that share of the closing speed.
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

    /// The wall of another bat to the same accuracy; this one if the other bat has the same wall.
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

    /// The harmonics that are modelled.
    pub fn harmonics(&self) -> Vec<usize> {
        self.response.harmonics()
    }

    /// Possible relative error of a frequency.
    pub fn off(&self) -> f64 {
        self.response.off()
    }

    /// Beginning and end of the modelled stretch (m).
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

    /// The patch of a ball compressed by that much (m) at `x` (m).
    pub fn patch(&self, x: f64, compression: f64) -> Patch {
        Patch::under(x, self.ball_radius, self.bat.profile().at(x).outer, compression)
    }

    /// The modes under a ball at `x` (m) compressed by that much (m).
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

    /// The compliance of each harmonic at `x` (m) under a ball compressed by that much (m); `None` outside the modelled
    /// stretch.
    pub fn shares(&self, x: f64, compression: f64) -> Option<Vec<Share>> {
        let patch = self.patch(x, compression);
        self.response.covers(&patch).then(|| self.response.under(&patch))
    }

    /// The wall at `x` (m) under a ball compressed by that much (m). Outside the modelled stretch it is rigid.
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
            felt.unsure += self.fineness.missed * local;
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

    /// `Σ C_n` (m/N) and `Σ D_n` (m s²/N) under a ball compressed by that much (m) at `x` (m), or at the nearest place
    /// of the modelled stretch.
    pub fn somewhere(&self, x: f64, compression: f64) -> [f64; 2] {
        let [from, to] = self.ends();
        let from = from + self.patch(x, compression).half_length;
        let felt = self.under(x.max(from).min(to), compression);
        [felt.soft, felt.slow]
    }
}

/// Possible error of the flexibility of harmonics beyond the last, as a share of it.
const BEYOND: f64 = 0.3;

impl PartialEq for HoopWall {
    /// Walls of one bat, for one ball, to one accuracy: their results are equal.
    fn eq(&self, other: &Self) -> bool {
        (&self.bat, self.ball_radius, self.fineness)
            == (&other.bat, other.ball_radius, other.fineness)
    }
}

/// Flexibility (m/N) of the harmonics beyond the last one modelled. Apart from the patch's share `g_n²` in a harmonic,
/// it continues to fall with the power of n of the last two.
fn beyond(flexibility: &[(usize, f64)], patch: &Patch, radius: f64) -> f64 {
    const FAR: usize = 60;
    let share = |n: usize| patch.share(n, radius).powi(2);
    let [.., (n, before), (last, soft)] = flexibility else { return 0.0 };
    // A patch may not excite a harmonic at all, as where a ring bends.
    let own = |n: usize, soft: f64| soft / share(n).max(1e-2);
    let (before, soft) = (own(*n, *before), own(*last, *soft));
    let fall = (before / soft).ln() / (*last as f64 / *n as f64).ln();
    let fall = if fall.is_finite() { fall.clamp(2.0, 4.0) } else { 4.0 };
    (last + 1..last + FAR).map(|n| soft * share(n) * (*last as f64 / n as f64).powf(fall)).sum()
}

/// The tones of a hollow barrel's wall under that ball, as a function of the place (m); `None` for a bat without a wall
/// whose hoop modes can be found.
pub fn heard(bat: &Bat, ball: &Ball) -> Option<impl Fn(f64) -> Vec<WallTone> + use<>> {
    let wall = rings(bat).then(|| HoopWall::of(bat, ball.radius_m, 1e-4).ok()).flatten()?;
    let compression = ball.patch_compression();
    Some(move |x: f64| wall.tones(x, compression))
}

/// Stiffness of the barrel's wall under a ball (N/m), before anything is solved: the least of `3 E h^{5/2} r^{−3/2}`
/// over the outer half of the bat; `None` if that half is solid.
///
/// # Source
///
/// A fit to hoop modes of bats with walls from 1.4 to 6 mm and the patch of a ball compressed by 8 mm, accurate to a
/// tenth.
pub fn rough_stiffness(bat: &Bat) -> Option<f64> {
    let stiffness = |[wall, x]: [f64; 2]| {
        let modulus = bat.layup(bat.profile().piece_at(x)).outer.youngs_modulus;
        3.0 * modulus * wall.powf(2.5) * bat.profile().at(x).outer.powf(-1.5)
    };
    barrel_walls(bat).into_iter().map(stiffness).min_by(f64::total_cmp)
}

/// Walls (m) of the outer half of the bat, where balls are hit, and their places (m); empty if that half is solid. A
/// bore with a core in it counts as hollow, a cup in the tip does not.
pub fn barrel_walls(bat: &Bat) -> Vec<[f64; 2]> {
    const STRETCHES: usize = 200;
    let half = 0.5 * bat.length();
    let wall = |k: usize| {
        // Between the stations too, but not at the tip, where a cap is not a wall.
        let x = half + half * (k as f64 + 0.5) / STRETCHES as f64;
        let section = bat.profile().at(x);
        (section.inner > 0.0).then_some([section.outer - section.inner, x])
    };
    let walls: Vec<[f64; 2]> = (0..STRETCHES).filter_map(wall).collect();
    let hollow = walls.iter().any(|[_, x]| *x < bat.length() - CUP);
    if hollow { walls } else { vec![] }
}

/// Restitution of a ball on a wall that deflects, from that on a rigid one: `e = √((e_s² + s)/(1 + s))`, with
/// `s = ½ (1 + α) k_ball/k_wall` the share of the energy that the wall stores and returns. An estimate, within 0.03,
/// for a wall much lighter than the ball.
pub fn restitution_with_wall(stiff: f64, exponent: f64, ball_over_wall: f64) -> f64 {
    let share = 0.5 * (1.0 + exponent) * ball_over_wall;
    ((stiff * stiff + share) / (1.0 + share)).sqrt()
}

/// Whether the wall of a bat deflects in a hit in its own hoop modes.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum HoopInHit {
    /// There is no wall that could deflect, or it was not requested.
    #[default]
    None,
    /// There is one, but it is taken as rigid.
    LeftOut(WhyRigid),
    /// It deflects.
    Counted(Arc<HoopWall>),
}

/// Why a wall that could deflect is taken as rigid.
#[derive(Debug, Clone, PartialEq)]
pub enum WhyRigid {
    /// The user asked for it.
    Asked,
    /// The number of modes is prescribed, and nothing else may contribute.
    ModesTold,
    /// Its estimated effect on the restitution is at most 0.15 of the tolerance.
    Small {
        /// Estimated change.
        gain: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// Many similar bats are compared, and each wall would have to be solved.
    ManyBats,
    /// Its hoop modes could not be found, for this reason.
    Unsolved(String),
}

impl HoopInHit {
    /// The choice for comparisons of many bats: a wall that would deflect is taken as rigid.
    pub fn left_out(&self) -> Self {
        match self {
            Self::Counted(_) => Self::LeftOut(WhyRigid::ManyBats),
            other => other.clone(),
        }
    }

    /// Possible error of an exit speed, relative to the closing speed, due to a wall that was omitted because its
    /// effect is small.
    pub fn error(&self) -> f64 {
        /// Factor on the estimated change: at an open tip the wall deflects more than twice as far as within the
        /// barrel, and within the barrel the estimate is about twice too large.
        const AT_THE_TIP: f64 = 2.0;
        match self {
            Self::LeftOut(WhyRigid::Small { gain, .. }) => AT_THE_TIP * gain,
            _ => 0.0,
        }
    }

    /// The wall, if it deflects.
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

    /// Two limits: a rigid wall changes nothing, and one that stores all energy returns all.
    #[test]
    fn a_wall_returns_what_it_stores() {
        assert!((restitution_with_wall(0.5, 1.84, 0.0) - 0.5).abs() < 1e-15);
        assert!((restitution_with_wall(0.5, 1.84, 1e12) - 1.0).abs() < 1e-9);
    }

    /// If the harmonics fall as the estimate assumes, it gives the omitted ones within a few per cent.
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
