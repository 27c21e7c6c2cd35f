//! Hits at places that lie close along a bat, not all of which need be compared with rougher ones.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::base::telling::Tell;
use crate::base::threads;
use crate::collision::hit::{Impact, greater};
use crate::collision::hitter::Hitter;

/// The hits at all places (m). Where they lie close, one in a few is compared with rougher ones, and
/// those between two take the larger error of both.
pub fn strikes(hitter: &Hitter, length: f64, places: &[f64], tell: Tell) -> Vec<Impact> {
    const MOST: usize = 8;
    /// Trial between two words of how many there are.
    const OFTEN: usize = 64;
    /// Share of the half-wave of the first mode left out: between two places so far apart its square is
    /// nowhere twice as large as at the larger of both.
    const CLOSE: f64 = 0.5;
    let most = CLOSE * length / (hitter.modes_used() + 1) as f64;
    let close = |few: &usize| {
        places.len() > 2 * few
            && places.windows(few + 1).all(|span| span.iter().all(|x| (x - span[0]).abs() <= most))
    };
    let struck = AtomicUsize::new(0);
    let told = |impact: Impact| {
        let count = struck.fetch_add(1, Ordering::Relaxed) + 1;
        if count.is_multiple_of(OFTEN) {
            tell(count as f64 / places.len() as f64, "hits");
        }
        impact
    };
    let Some(few) = (2..=MOST).rev().find(close) else {
        return threads::map(places.len(), |k| told(hitter.strike(places[k])));
    };
    let last = places.len() - 1;
    let mut chosen: Vec<usize> = (0..last).step_by(few).collect();
    chosen.push(last);
    let compared = threads::map(chosen.len(), |k| told(hitter.strike(places[chosen[k]])));
    let strike = |k: usize| {
        let after = chosen.partition_point(|at| *at < k);
        if chosen[after] == k {
            return compared[after].clone();
        }
        let [a, b] = [after - 1, after].map(|i| compared[i].outcome.as_ref());
        let errors = a.zip(b).map(|(a, b)| {
            [
                greater(a.truncation, b.truncation),
                greater(a.steps, b.steps),
                greater(a.wall, b.wall),
            ]
        });
        told(hitter.strike_knowing(places[k], errors))
    };
    threads::map(places.len(), strike)
}
