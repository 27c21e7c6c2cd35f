//! How many resonances do responses share, and which?
//!
//! One pole is added at a time: the one that lowers the weighted sum of squares most. It is sought where the residual
//! is largest and on the flanks of the poles found so far; then all poles are fitted together. The search ends when the
//! next pole would lower the sum by no more than noise does. The results for every number show which are stable.

use crate::fit::Pole;
use crate::resonances::{Damping, Projection, Responses, Shared, shared};

/// Poles that were sought in responses.
#[derive(Debug, Clone, PartialEq)]
pub struct Orders {
    /// How the body is damped, by the smaller sum of squares.
    pub damping: Damping,
    /// The poles with 1, 2, … of them.
    pub orders: Vec<Vec<Pole>>,
    /// The last of them.
    pub fit: Shared,
    /// Decrease of the sum of squares due to every pole, over that due to noise.
    pub weights: Vec<f64>,
}

/// Most poles.
const MOST: usize = 40;
/// Number of places that are tried for the next pole, and number of those that are fitted.
const PLACES: usize = 14;
const TRIES: usize = 12;
/// Loss factors with which they are tried.
const TRIED: [f64; 7] = [0.0003, 0.0015, 0.004, 0.01, 0.02, 0.04, 0.1];
/// Distance of a tried place from an existing pole, over its loss factor.
const FLANK: f64 = 0.4;
/// Least decrease of the sum of squares for which dashpots are assumed in place of the material's loss.
const DOUBT: f64 = 12.0;
/// Distance beyond the band (as a share of its end) at which a pole may represent modes there.
const BEYOND: f64 = 0.12;

/// Largest decrease of the sum of squares that a pole causes in noise: a Gamma variable of as many complex numbers as
/// there are responses, the largest of a few hundred.
fn by_chance(responses: usize) -> f64 {
    let count = responses as f64 + 1.0;
    count + 6.0 * count.sqrt() + 16.0
}

/// Whether two poles are so near that they are one pole that moved a little between responses.
fn has_echo(poles: &[Pole]) -> bool {
    /// Distance over the half-power width of the wider one; twins that can be distinguished are farther apart.
    const NEAR: f64 = 0.1;
    let near = |a: &Pole, b: &Pole| {
        (a.hz - b.hz).abs() < NEAR * f64::max(a.hz * a.loss(), b.hz * b.loss())
    };
    poles.iter().enumerate().any(|(k, a)| poles[..k].iter().any(|b| near(a, b)))
}

impl Orders {
    /// Seeks the poles of responses for each kind of damping. `None` if there are none.
    pub fn of(all: &mut [Responses]) -> Option<Self> {
        let count: usize = all.iter().map(|one| one.values.len()).sum();
        let mut best = Self::damped(all, Damping::Material)?;
        // The residual of these poles with dashpots shows whether a search with dashpots is worth while.
        let as_dashpots = shared(all, &best.fit.poles, Damping::Dashpots);
        if as_dashpots.is_some_and(|fit| fit.square + DOUBT < best.fit.square) {
            let cost = |one: &Self| one.fit.square + by_chance(count) * one.fit.poles.len() as f64;
            let other = Self::damped(all, Damping::Dashpots);
            best = other.filter(|other| cost(other) < cost(&best)).unwrap_or(best);
        }
        // The noise is now the residual of the poles.
        for one in all.iter_mut() {
            let at = Projection::new(one, &best.fit.poles, best.damping);
            one.weigh_left(&at.left);
        }
        if let Some(fit) = shared(all, &best.fit.poles, best.damping) {
            best.fit = fit;
        }
        best.weights = best.weighed(all, count);
        Some(best)
    }

    fn damped(all: &[Responses], damping: Damping) -> Option<Self> {
        let count: usize = all.iter().map(|one| one.values.len()).sum();
        let mut fit: Option<Shared> = None;
        let mut orders = vec![];
        while orders.len() < MOST {
            let poles = fit.as_ref().map_or(vec![], |fit| fit.poles.clone());
            let here: Vec<Projection> =
                all.iter().map(|one| Projection::new(one, &poles, damping)).collect();
            let square: f64 = here.iter().map(Projection::square).sum();
            let next = candidates(all, &here, &poles, damping).into_iter().take(TRIES);
            let enough = |(pole, gain): (Pole, f64)| {
                let with: Vec<Pole> = poles.iter().copied().chain([pole]).collect();
                let fit =
                    (gain > 0.5 * by_chance(count)).then(|| shared(all, &with, damping))??;
                (square - fit.square > by_chance(count) && !has_echo(&fit.poles)).then_some(fit)
            };
            let Some(found) = next.into_iter().find_map(enough) else { break };
            orders.push(found.poles.clone());
            fit = Some(found);
        }
        Some(Self { damping, orders, fit: fit?, weights: vec![] })
    }

    /// Decrease of the sum of squares due to every pole, over that due to noise.
    fn weighed(&self, all: &[Responses], count: usize) -> Vec<f64> {
        let without = |p: usize| {
            let mut poles = self.fit.poles.clone();
            poles.remove(p);
            let each = all.iter().map(|one| Projection::new(one, &poles, self.damping).square());
            (each.sum::<f64>() - self.fit.square) / by_chance(count)
        };
        (0..self.fit.poles.len()).map(without).collect()
    }
}

/// Candidates for the next pole, each with its decrease of the sum of squares, the best first.
fn candidates(
    all: &[Responses],
    here: &[Projection],
    poles: &[Pole],
    damping: Damping,
) -> Vec<(Pole, f64)> {
    let flanks = poles.iter().flat_map(|pole| {
        let loss = pole.loss();
        [-FLANK, FLANK].map(|side| (pole.hz * (1.0 + side * loss), Some(loss)))
    });
    let ends = all.iter().filter_map(|one| one.hz.last());
    let beyond = ends.map(|hz| (hz * (1.0 + BEYOND), Some(0.02)));
    let places = all.iter().zip(here).flat_map(|(of, at)| most_left(of, at));
    let places = places.map(|hz| (hz, None)).chain(flanks).chain(beyond);
    let with = |(hz, loss): (f64, Option<f64>)| {
        let losses = loss.map_or(TRIED.to_vec(), |loss| vec![loss, 0.5 * loss]);
        let gain = |loss: f64| {
            let pole = Pole::of(hz, loss);
            (pole, all.iter().zip(here).map(|(of, at)| at.gain(of, pole, damping)).sum::<f64>())
        };
        losses.into_iter().map(gain).max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let mut found: Vec<(Pole, f64)> = places.filter_map(with).collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found
}

/// The frequencies of the largest residuals, each the largest within its surroundings.
fn most_left(of: &Responses, at: &Projection) -> Vec<f64> {
    let lines = of.hz.len();
    let power = |l: usize| at.left.iter().map(|left| left[l].norm_sqr()).sum::<f64>();
    let powers: Vec<f64> = (0..lines).map(power).collect();
    let smooth = |l: usize| {
        let part = &powers[l.saturating_sub(1)..(l + 2).min(lines)];
        part.iter().sum::<f64>() / part.len() as f64
    };
    let smooth: Vec<f64> = (0..lines).map(smooth).collect();
    let near = (lines / 200).max(2);
    let top = |l: &usize| {
        let part = &smooth[l.saturating_sub(near)..(l + near + 1).min(lines)];
        part.iter().all(|other| *other <= smooth[*l])
    };
    let mut tops: Vec<usize> = (0..lines).filter(top).collect();
    tops.sort_by(|a, b| smooth[*b].total_cmp(&smooth[*a]));
    tops.truncate(PLACES);
    tops.into_iter().map(|l| of.hz[l]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::c64;
    use std::f64::consts::TAU;

    /// Accelerances per force on lines 0.5 Hz apart from 50 to 1200 Hz, with noise of that size.
    fn responses(
        poles: &[Pole],
        residues: &[Vec<f64>],
        damping: Damping,
        noise: f64,
        mut state: u64,
    ) -> Responses {
        let hz: Vec<f64> = (100..2400).map(|l| 0.5 * f64::from(l)).collect();
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as f64 + 0.5) / (1_u64 << 31) as f64
        };
        let mut at = |residues: &Vec<f64>, f: f64| {
            let size = noise * (-uniform().ln()).sqrt();
            let start = c64::from(0.7) + c64::cis(TAU * uniform()) * size;
            poles.iter().zip(residues).fold(start, |sum, (pole, a)| {
                let by = if damping == Damping::Material { pole.hz } else { f };
                let below = c64::new(pole.hz.powi(2) - f * f, pole.loss() * pole.hz * by);
                sum - c64::new(a * f * f, 0.0) / below
            })
        };
        let values = residues.iter().map(|a| hz.iter().map(|f| at(a, *f)).collect()).collect();
        Responses::new(hz.clone(), values, None)
    }

    /// Twins 1 % apart and two more, of which no response has all; in noise there are none.
    #[test]
    fn as_many_poles_are_found_as_there_are() {
        let truth = [
            Pole::of(171.3, 0.006),
            Pole::of(583.2, 0.011),
            Pole::of(589.1, 0.01),
            Pole::of(1010.0, 0.02),
        ];
        let residues = [
            vec![2.0, -1.5, 0.7, 0.0],
            vec![0.0, 1.0, 1.1, 0.4],
            vec![0.9, 0.3, -2.0, -1.0],
            vec![-1.1, 0.0, 0.5, 0.6],
        ];
        for damping in [Damping::Material, Damping::Dashpots] {
            let mut all = [responses(&truth, &residues, damping, 0.3, 5)];
            let found = Orders::of(&mut all).unwrap();
            assert_eq!((found.fit.poles.len(), found.orders.len()), (4, 4), "{found:?}");
            let mut poles = found.fit.poles.clone();
            poles.sort_by(|a, b| a.hz.total_cmp(&b.hz));
            for (pole, truth) in poles.iter().zip(truth) {
                assert!((pole.hz / truth.hz - 1.0).abs() < 5e-4, "{pole:?}");
                assert!((pole.loss() / truth.loss() - 1.0).abs() < 0.1, "{pole:?}");
            }
            assert!(found.weights.iter().all(|weight| *weight > 1.0), "{found:?}");
        }
        // A pole that moves by 0.002 % between two groups of responses, as with another mass on the body, is one pole.
        let mut moved = truth;
        moved.iter_mut().for_each(|pole| *pole = Pole::of(1.00002 * pole.hz, pole.loss()));
        let two = [(&truth, 7), (&moved, 8)];
        let mut all =
            two.map(|(poles, seed)| responses(poles, &residues, Damping::Material, 1e-4, seed));
        assert_eq!(Orders::of(&mut all).unwrap().fit.poles.len(), 4);
        let none = vec![vec![]; 4];
        assert_eq!(Orders::of(&mut [responses(&[], &none, Damping::Material, 0.3, 6)]), None);
    }
}
