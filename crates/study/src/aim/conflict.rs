//! Which targets conflict, and how close can each come?
//!
//! It is judged from the original bat, because a linearisation far from it makes feasible targets look impossible. One
//! band after another is left out; those without which the others still cannot be met stay out. What remains is a
//! smallest conflict: without any one of its members the others can be met.

use serde::Serialize;

use crate::aim::search::{MISSED, Search, Searched, Weights};
use crate::aim::wish::Band;
use crate::engine::{Result, threads};

/// Conflicting targets: without any one of them the others can be met.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Conflict {
    /// The targets, with how close each comes.
    pub members: Vec<Reach>,
    /// The conflict in a sentence: the targets that cannot all be met, and how close each comes.
    // A report says it; until then it is empty.
    pub words: String,
    /// Numbers of the bands that do not belong to it but are missed where a member comes closest.
    #[serde(skip)]
    pub aside: Vec<usize>,
    /// Bats that were computed for it.
    #[serde(skip)]
    pub bats: usize,
}

/// How near a target comes with the other members of the conflict met.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Reach {
    /// Name of the output.
    pub name: String,
    /// Number of the target, from 0.
    pub target: usize,
    /// The closest value (SI); null if the bat has none.
    pub reaches: Option<f64>,
    /// Whether the others are met there.
    pub others_met: bool,
    /// Whether the search converged: no closer value is nearby.
    #[serde(skip)]
    pub settled: bool,
}

/// Whether a search has missed one of these bands.
pub fn missed(found: &Searched, bands: &[Band], of: &[bool]) -> bool {
    let misses = bands.iter().zip(&found.values).zip(of).filter(|(_, of)| **of);
    misses.into_iter().any(|((band, value), _)| band.miss(*value) > MISSED)
}

impl Conflict {
    /// The conflict of bands that a search has missed, and the bats in which each member comes closest.
    ///
    /// # Errors
    ///
    /// Those of [`Search::from`].
    pub fn of(search: &Search, bands: &[Band], found: &Searched) -> Result<(Self, Vec<Searched>)> {
        let start = vec![0.0; found.p.len()];
        let mut stay = vec![true; bands.len()];
        let mut nearest_yet = found.p.clone();
        let mut bats = 0;
        // A band that neither binds nor is missed probably does not belong to it, and is left out first.
        let mut order: Vec<usize> = (0..bands.len()).collect();
        let idle =
            |k: &usize| found.prices[*k].abs() > 1e-6 || bands[*k].miss(found.values[*k]) > 0.0;
        order.sort_by_key(idle);
        for k in order {
            let mut without = stay.clone();
            without[k] = false;
            if without.iter().any(|stays| *stays) {
                let weights = some(&Weights::met(bands.len()), &without);
                let tried = search.meets(&start, bands, &weights)?;
                bats += tried.bats;
                if missed(&tried, bands, &without) {
                    (stay, nearest_yet) = (without, tried.p);
                }
            }
        }
        let members: Vec<usize> = (0..bands.len()).filter(|k| stay[*k]).collect();
        // The search for each member starts where all of them together come closest.
        let reached = threads::map(members.len(), |j| {
            search.from(&nearest_yet, bands, &nearest(&stay, members[j]))
        });
        let reached: Vec<Searched> = reached.into_iter().collect::<Result<_>>()?;
        let reach = |(k, reached): (&usize, &Searched)| {
            bats += reached.bats;
            let mut others = stay.clone();
            others[*k] = false;
            let others_met = !missed(reached, bands, &others);
            let reaches = Some(reached.values[*k]).filter(|value| value.is_finite());
            let (name, settled) = (bands[*k].goal.name(), reached.stopped.is_none());
            Reach { name, target: *k, reaches, others_met, settled }
        };
        let members = members.iter().zip(&reached).map(reach).collect();
        let out = |k: &usize| {
            let missed = |found: &Searched| bands[*k].miss(found.values[*k]) > MISSED;
            !stay[*k] && reached.iter().any(missed)
        };
        let aside = (0..bands.len()).filter(out).collect();
        Ok((Self { members, words: String::new(), aside, bats }, reached))
    }

    /// Weights with which everything else is met and the members come as close as they can together, each measured by
    /// its tolerance.
    pub fn nearest(&self, bands: usize) -> Weights {
        const OTHERS: f64 = 100.0;
        let mut weights = Weights::met(bands);
        for (k, price) in weights.miss.iter_mut().enumerate() {
            if self.members.iter().all(|member| member.target != k) {
                *price *= OTHERS;
            }
        }
        weights
    }
}

/// Those weights for some of the bands only.
fn some(weights: &Weights, of: &[bool]) -> Weights {
    let price = |(price, of): (&f64, &bool)| if *of { *price } else { 0.0 };
    Weights { miss: weights.miss.iter().zip(of).map(price).collect(), ..*weights }
}

/// Weights with which the others are met first, then band k comes as close as it can, and the size of the change hardly
/// counts.
fn nearest(of: &[bool], k: usize) -> Weights {
    const SIZE: f64 = 1e-6;
    const OTHERS: f64 = 1e3;
    let price = |(j, of): (usize, &bool)| match *of {
        _ if j == k => 1.0,
        true => OTHERS,
        false => 0.0,
    };
    Weights { size: SIZE, miss: of.iter().enumerate().map(price).collect() }
}
