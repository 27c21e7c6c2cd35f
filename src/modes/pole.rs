//! A free motion that decays, and which of these belong together.

use faer::c64;

use crate::base::{Error, Result};

/// A free motion `e^{st}`.
#[derive(Debug, Clone)]
pub struct Pole {
    /// Complex rate `s` of `e^{st}` (1/s).
    pub s: c64,
    /// Amplitudes of the rigid motions, if they are coupled.
    pub rigid: Vec<c64>,
    /// Amplitudes of the strains.
    pub parts: Vec<c64>,
    /// `vᵀ(2sM + C)v` (J s/m²): a unit impulse at a causes the motion `v v(a) e^{st}/norm`.
    pub norm: c64,
    /// Error of s relative to |s|, due to the small number of strains.
    pub error: f64,
    /// Share of the rigid motions in the kinetic energy.
    pub rigid_share: f64,
    /// Share of the strains in the sum of both energies: a half for an oscillation, more for a slow return to rest,
    /// less for a motion that a dashpot stops.
    pub strain_share: f64,
}

/// The free motions of a damped bat.
#[derive(Debug, Clone)]
pub struct FreeMotions {
    /// Groups of motions by rising |s|.
    pub groups: Vec<Group>,
    /// Motions of the rigid bat that dashpots slow down.
    pub rigid: Vec<Pole>,
    /// All other motions of the reduced bat.
    pub others: Vec<Pole>,
}

/// One motion of the damped bat: a complex pair, its half with `Im s > 0`, or two real ones.
#[derive(Debug, Clone)]
pub struct Group {
    /// One pole, or the two real ones.
    pub poles: Vec<Pole>,
}

impl Group {
    /// `√(s s*)`, or `√(s₁ s₂)` for two real ones (rad/s).
    pub fn natural(&self) -> f64 {
        match &self.poles[..] {
            [a, b] => (a.s.re * b.s.re).abs().sqrt(),
            poles => poles.iter().map(|pole| pole.s.norm()).sum(),
        }
    }

    /// `−Re s/|s|`, or `−½(s₁ + s₂)/√(s₁ s₂)`, which is above 1.
    pub fn ratio(&self) -> f64 {
        let sum: f64 = self.poles.iter().map(|pole| pole.s.re).sum();
        -sum / (self.poles.len() as f64 * self.natural())
    }
}

/// Complex pairs and pairs of real eigenvalues, by rising |s|; those that belong to the `rigid` coupled rigid motions
/// are separate.
pub fn grouped(poles: Vec<Pole>, rigid: usize) -> FreeMotions {
    let (mut real, pairs): (Vec<Pole>, Vec<Pole>) = poles.into_iter().partition(|p| p.s.im == 0.0);
    real.sort_by(|a, b| b.rigid_share.total_cmp(&a.rigid_share));
    let strained = real.split_off(rigid.min(real.len()));
    // Of two real poles that belong together, one is a slow return to rest and the other a motion that is stopped, with
    // nearly equal strains. The slowest chooses its partner first.
    let (mut slow, mut fast): (Vec<Pole>, Vec<Pole>) =
        strained.into_iter().partition(|pole| pole.strain_share > 0.5);
    slow.sort_by(|a, b| b.s.norm().total_cmp(&a.s.norm()));
    let size = |a: &Pole| a.parts.iter().map(|p| p.norm_sqr()).sum::<f64>().sqrt();
    let alike = |a: &Pole, b: &Pole| {
        let both = a.parts.iter().zip(&b.parts).map(|(a, b)| *a * *b).sum::<c64>();
        both.norm() / (size(a) * size(b))
    };
    let mut groups: Vec<Group> =
        pairs.into_iter().map(|pole| Group { poles: vec![pole] }).collect();
    while let Some(one) = slow.pop() {
        let order =
            |i: &usize, j: &usize| alike(&one, &fast[*i]).total_cmp(&alike(&one, &fast[*j]));
        let Some(partner) = (0..fast.len()).max_by(order) else {
            slow.push(one);
            break;
        };
        groups.push(Group { poles: vec![one, fast.remove(partner)] });
    }
    groups.sort_by(|a, b| a.natural().total_cmp(&b.natural()));
    slow.append(&mut fast);
    FreeMotions { groups, rigid: real, others: slow }
}

/// Checks that all of these motions decay, as they must.
pub fn possible<'a>(mut poles: impl Iterator<Item = &'a Pole>) -> Result<()> {
    const ROUND_OFF: f64 = 1e-9;
    let lost = |pole: &&Pole| !(pole.s.re <= ROUND_OFF * pole.s.norm() && pole.s.norm() > 0.0);
    match poles.find(lost) {
        None => Ok(()),
        Some(_) => {
            let found = "dashpots so strong that round-off hides all that they damp";
            let expected = "a damping that lets the bat move, or a support in its place";
            Err(Error::value("damping", found, expected))
        }
    }
}
