//! A ball as a nonlinear spring that returns less than it took.
//!
//! ```text
//! F = k x^α                          at a compression x that it has not had before
//! F = k x_m^α (x/x_m)^β              below the largest compression so far, x_m
//! β = (1 + α)/e₀² − 1                so that on a rigid wall it returns e₀² of the energy
//! ```
//!
//! Below `x_m` the law is reversible; at `x_m` it is on the first branch again. The stored and the lost energy have
//! closed forms in every state.
//!
//! # Source
//!
//! A. M. Nathan, Am. J. Phys. 68, 979 (2000), "Dynamics of the baseball-bat collision".

use crate::collision::contact::collider::{Law, LawTerms};
use crate::collision::contact::force_law::{ForceLaw, Top};

/// A force as a power of the compression, and as a steeper one on the way back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// `k` (N/m^α).
    pub stiffness: f64,
    /// `α`.
    pub exponent: f64,
    /// `β`.
    pub unloading: f64,
}

/// A ball with a smaller e₀ is computed with this one: its force falls as steeply as floating point can represent, and
/// it returns 1e-10 of the energy.
pub const LEAST_RESTITUTION: f64 = 1e-5;

impl PowerLaw {
    /// `k` (N/m^α), `α` and `e₀`.
    pub fn new(stiffness: f64, exponent: f64, restitution: f64) -> Self {
        let restitution = restitution.max(LEAST_RESTITUTION);
        let unloading = (1.0 + exponent) / (restitution * restitution) - 1.0;
        Self { stiffness, exponent, unloading }
    }
}

/// The law of k, α and e₀, for a [`crate::collision::ball::Ball`].
pub fn law(of: LawTerms) -> Box<dyn Law> {
    Box::new(PowerLaw::new(of.stiffness, of.exponent, of.restitution))
}

impl ForceLaw for PowerLaw {
    #[inline(always)]
    fn force(&self, x: f64, top: Option<Top>) -> [f64; 2] {
        if x <= 0.0 {
            return [0.0; 2];
        }
        let force = match top {
            None => self.stiffness * x.powf(self.exponent),
            Some(top) => top.force * (x / top.compression).powf(self.unloading),
        };
        [force, self.slope(x, force, top)]
    }

    #[inline(always)]
    fn powers(&self) -> Option<[f64; 3]> {
        Some([self.stiffness, self.exponent, self.unloading])
    }

    #[inline(always)]
    fn slope(&self, x: f64, force: f64, top: Option<Top>) -> f64 {
        if force > 0.0 { self.exponent(top) * force / x } else { 0.0 }
    }

    /// `F ∝ x_m^{α − β}`.
    #[inline(always)]
    fn by_top(&self, _x: f64, force: f64, top: Top) -> f64 {
        (self.exponent - self.unloading) * force / top.compression
    }

    #[inline(always)]
    fn exponent(&self, top: Option<Top>) -> f64 {
        top.map_or(self.exponent, |_| self.unloading)
    }

    /// The forces (N) at compressions x > 0 that differ little from those where they are known: `F (1 + δ)^β` by its
    /// binomial series, `δ = by/x`. `None` if one differs too much.
    #[inline(always)]
    fn near<const N: usize>(
        &self,
        x: [f64; N],
        force: [f64; N],
        by: [f64; N],
        top: Option<Top>,
    ) -> Option<[f64; N]> {
        /// The `βδ` up to which the omitted terms are below ε.
        const NEAR: f64 = 0.05;
        const TERMS: [f64; 8] = [8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0];
        let exponent = self.exponent(top);
        let most = NEAR / exponent.max(1.0);
        let (mut share, mut near) = ([0.0; N], true);
        for i in 0..N {
            share[i] = by[i] / x[i];
            near &= share[i].abs() <= most && x[i] > 0.0;
        }
        if !near {
            return None;
        }
        let mut sum = [1.0; N];
        for k in TERMS {
            let factor = (exponent + 1.0 - k) * (1.0 / k);
            for i in 0..N {
                sum[i] = 1.0 + factor * share[i] * sum[i];
            }
        }
        for i in 0..N {
            sum[i] *= force[i];
        }
        Some(sum)
    }

    #[inline(always)]
    fn energy_of(&self, x: f64, force: f64, top: Option<Top>) -> [f64; 2] {
        let (loading, unloading) = (1.0 / (1.0 + self.exponent), 1.0 / (1.0 + self.unloading));
        match top {
            None => [force * x.max(0.0) * loading, 0.0],
            Some(top) => {
                let lost = top.force * top.compression * (loading - unloading);
                [force * x.max(0.0) * unloading, lost]
            }
        }
    }

    #[inline(always)]
    fn at(&self, force: f64, top: Option<Top>) -> f64 {
        match top {
            None => (force / self.stiffness).powf(1.0 / self.exponent),
            Some(top) => top.compression * (force / top.force).powf(1.0 / self.unloading),
        }
    }

    fn compression(&self, energy: f64) -> f64 {
        let exponent = 1.0 + self.exponent;
        (exponent * energy / self.stiffness).powf(1.0 / exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: PowerLaw = PowerLaw { stiffness: 2e7, exponent: 1.6, unloading: 8.0 };

    #[test]
    fn the_force_is_what_the_energy_changes_by() {
        let top = Some(Top { compression: 0.01, force: LAW.force(0.01, None)[0] });
        for (x, top) in [(0.004, None), (0.009, top), (0.002, top)] {
            let h = 1e-7;
            let change = LAW.energy(x + h, top)[0] - LAW.energy(x - h, top)[0];
            let [force, slope] = LAW.force(x, top);
            assert!((change / (2.0 * h) / force - 1.0).abs() < 1e-6);
            let change = LAW.force(x + h, top)[0] - LAW.force(x - h, top)[0];
            assert!((change / (2.0 * h) / slope - 1.0).abs() < 1e-6);
        }
    }

    /// A law without derivatives gets them by differences.
    #[test]
    fn the_force_on_the_way_back_moves_with_the_largest_compression() {
        #[derive(Clone, Copy)]
        struct Bare(PowerLaw);
        impl ForceLaw for Bare {
            fn force(&self, x: f64, top: Option<Top>) -> [f64; 2] {
                self.0.force(x, top)
            }
            fn energy_of(&self, x: f64, force: f64, top: Option<Top>) -> [f64; 2] {
                self.0.energy_of(x, force, top)
            }
            fn compression(&self, energy: f64) -> f64 {
                self.0.compression(energy)
            }
            fn exponent(&self, top: Option<Top>) -> f64 {
                ForceLaw::exponent(&self.0, top)
            }
        }
        let top = Top { compression: 0.01, force: LAW.force(0.01, None)[0] };
        for x in [0.002, 0.006, 0.0099] {
            let force = LAW.force(x, Some(top))[0];
            let [own, bare] = [LAW.by_top(x, force, top), Bare(LAW).by_top(x, force, top)];
            assert!((own / bare - 1.0).abs() < 1e-8, "{x} {own} {bare}");
        }
    }

    /// The binomial series is the power, to its end.
    #[test]
    fn near_a_known_force_the_series_is_the_force() {
        let top = Some(Top { compression: 0.01, force: LAW.force(0.01, None)[0] });
        for (x, top) in [(0.004, None), (0.004, top), (1e-6, top)] {
            for share in [-6e-3, -1e-9, 2e-4, 6e-3] {
                let known = LAW.force(x, top)[0];
                let [near] = LAW.near([x], [known], [share * x], top).unwrap();
                assert!((near / LAW.force(x * (1.0 + share), top)[0] - 1.0).abs() < 2e-14);
            }
            assert_eq!(LAW.near([x], [1.0], [0.06 * x], top), None);
            assert_eq!(LAW.near([0.0], [0.0], [x], top), None);
            assert_eq!(LAW.near([x], [1.0], [f64::NAN], top), None);
        }
    }

    #[test]
    fn the_law_returns_its_share() {
        for restitution in [0.3, 0.5, 1.0] {
            let law = PowerLaw::new(2e7, 1.6, restitution);
            let all = law.energy(0.01, None)[0];
            let top = Some(Top { compression: 0.01, force: law.force(0.01, None)[0] });
            let [back, lost] = law.energy(0.01, top);
            assert!((back / all - restitution * restitution).abs() < 1e-14);
            assert!(((back + lost) / all - 1.0).abs() < 1e-14);
            assert!((law.compression(all) / 0.01 - 1.0).abs() < 1e-14);
        }
        let dead = PowerLaw::new(2e7, 1.6, 0.0);
        let top = Some(Top { compression: 0.01, force: 100.0 });
        assert_eq!(dead.force(0.009, top), [0.0; 2]);
        assert_eq!(dead.energy(0.009, top)[0], 0.0);
    }
}
