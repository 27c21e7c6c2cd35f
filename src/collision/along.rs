//! Hits at many places along a bat. Where the places are close together, only some are compared with less accurate
//! answers.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::base::{Tell, threads};
use crate::collision::contact::abreast::meet::ABREAST;
use crate::collision::hit::{Impact, greater};
use crate::collision::hitter::Hitter;

/// The hits at all places (m). Where they lie close together, one in a few is compared with less accurate answers. The
/// hits between two of these take the larger error of both.
pub fn strikes(hitter: &Hitter, length: f64, places: &[f64], tell: Tell) -> Vec<Impact> {
    const MOST: usize = 8;
    /// Number of hits between two messages of progress.
    const OFTEN: usize = 64;
    /// Share of the half-wave of the first omitted mode. Between two places this far apart, the square of the mode is
    /// nowhere twice as large as at the place where it is larger.
    const CLOSE: f64 = 0.5;
    let most = CLOSE * length / (hitter.modes_used() + 1) as f64;
    let close = |few: &usize| {
        places.len() > 2 * few
            && places.windows(few + 1).all(|span| span.iter().all(|x| (x - span[0]).abs() <= most))
    };
    let struck = AtomicUsize::new(0);
    // In groups, whose hits are computed side by side.
    let strike = |asked: &[(f64, Option<[f64; 3]>)]| -> Vec<Impact> {
        let groups: Vec<_> = asked.chunks(ABREAST).collect();
        let hits = threads::map(groups.len(), |k| {
            let impacts = hitter.strike_all(groups[k]);
            let before = struck.fetch_add(impacts.len(), Ordering::Relaxed);
            let count = before + impacts.len();
            if count / OFTEN > before / OFTEN {
                tell(count as f64 / places.len() as f64, "hits");
            }
            impacts
        });
        hits.into_iter().flatten().collect()
    };
    let bare = |k: usize| (places[k], None);
    let Some(few) = (2..=MOST).rev().find(close) else {
        return strike(&(0..places.len()).map(bare).collect::<Vec<_>>());
    };
    let last = places.len() - 1;
    let mut chosen: Vec<usize> = (0..last).step_by(few).collect();
    chosen.push(last);
    let compared = strike(&chosen.iter().copied().map(bare).collect::<Vec<_>>());
    let between: Vec<usize> = (0..last).filter(|k| k % few != 0).collect();
    let known = |k: &usize| {
        let [a, b] = [k / few, k / few + 1].map(|i| compared[i].outcome.as_ref());
        let errors = a.zip(b).map(|(a, b)| {
            [
                greater(a.truncation, b.truncation),
                greater(a.steps, b.steps),
                greater(a.wall, b.wall),
            ]
        });
        (places[*k], errors)
    };
    let others = strike(&between.iter().map(known).collect::<Vec<_>>());
    let mut all: Vec<Option<Impact>> = vec![None; places.len()];
    let both = chosen.into_iter().zip(compared).chain(between.into_iter().zip(others));
    both.for_each(|(k, impact)| all[k] = Some(impact));
    all.into_iter().flatten().collect()
}
