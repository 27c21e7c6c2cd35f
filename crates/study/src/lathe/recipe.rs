//! What is the least wood that has to come off for a wish, to first order?
//!
//! Depths `c` of the bands, none negative, change answers by `t`; a unit of depth changes them by `G`:
//!
//! ```text
//! minimise Σ wⱼ cⱼ²   subject to   G c = t,  c ≥ 0        w the width of a band
//! ```
//!
//! It is solved by the active set: on the bands that are cut, `c = W⁻¹Gᵀ λ` with `(G W⁻¹ Gᵀ) λ = t`. A band that would
//! grow is not cut, and is cut again if its `gᵀλ` becomes positive. Every cut lowers the swing weight, so it cannot be
//! kept exactly: if the least wood for the first wish lowers it by more than is allowed, the allowed change is the
//! second row of G.

use crate::answers::Answer;
use crate::lathe::found::TurnedBand;
use crate::lathe::map::LatheMap;

/// A stretch (m from the knob end) and the depth that comes off its diameter (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecipeCut {
    /// From where to where (m).
    pub ends: [f64; 2],
    /// Depth, of the diameter (m).
    pub depth: f64,
}

/// A cut deeper than this share of the diameter is beyond the range of a derivative.
const DEEPEST: f64 = 0.1;

/// The least wood off the bat that changes an answer by `by` (in its unit) and lowers the swing weight by no more than
/// `most` (kg m²), at the same swing, to first order; stretches from the knob on. `None` if cuts of at most a tenth of
/// the diameter cannot do it, or if the answers are not known.
pub fn least_wood(
    map: &LatheMap,
    (answer, by): (Answer, f64),
    most: f64,
) -> Option<Vec<RecipeCut>> {
    let of_band = |band: &TurnedBand| {
        let per_metre = 1e3 * band.derivative(answer, 0.0)?;
        Some(BandRun {
            ends: band.ends(),
            row: [per_metre, band.inertia?, band.to_m - band.from_m],
        })
    };
    let bands = &map.found.bands;
    let found = recipe(&bands.iter().filter_map(of_band).collect::<Vec<_>>(), by, most)?;
    let within = |cut: &RecipeCut| {
        let inside = |band: &&TurnedBand| band.from_m < cut.ends[1] && band.to_m > cut.ends[0];
        let mut own = bands.iter().filter(inside);
        own.all(|band| cut.depth <= DEEPEST * band.diameter_m)
    };
    found.iter().all(within).then_some(found)
}

/// The least cuts of bands: one depth for each run of neighbours if possible, else one for each band.
fn recipe(bands: &[BandRun], by: f64, most: f64) -> Option<Vec<RecipeCut>> {
    let rows: Vec<[f64; 3]> = bands.iter().map(|band| band.row).collect();
    let depths = allowed(&rows, by, most)?;
    let cut = || bands.iter().zip(&depths).filter(|(_, depth)| **depth > 0.0);
    let mut merged: Vec<BandRun> = vec![];
    for (band, _) in cut().filter(|(_, depth)| **depth > LEAST_TOLD * deepest(&depths)) {
        match merged.last_mut().filter(|last| (last.ends[1] - band.ends[0]).abs() < 1e-9) {
            Some(last) => last.grow(band),
            None => merged.push(*band),
        }
    }
    let each = || cuts(cut().map(|(band, _)| *band).collect(), by, most);
    cuts(merged, by, most).or_else(each).filter(|cuts: &Vec<_>| !cuts.is_empty())
}

/// The least cuts of those stretches for the whole change, one depth for each, without negligible ones.
fn cuts(mut stretches: Vec<BandRun>, by: f64, most: f64) -> Option<Vec<RecipeCut>> {
    loop {
        let rows: Vec<[f64; 3]> = stretches.iter().map(|stretch| stretch.row).collect();
        let depths = allowed(&rows, by, most)?;
        let told = |depth: f64| depth > LEAST_TOLD * deepest(&depths);
        if depths.iter().all(|depth| told(*depth)) {
            let both = stretches.iter().zip(&depths);
            return Some(both.map(|(of, d)| RecipeCut { ends: of.ends, depth: *d }).collect());
        }
        let mut all = depths.iter();
        stretches.retain(|_| all.next().is_some_and(|depth| told(*depth)));
    }
}

/// Cuts below a tenth of the deepest are not listed.
const LEAST_TOLD: f64 = 0.1;

/// A stretch of bands that are cut alike.
#[derive(Clone, Copy)]
struct BandRun {
    /// From where to where (m).
    ends: [f64; 2],
    /// Both slopes and the width of all of it.
    row: [f64; 3],
}

impl BandRun {
    fn grow(&mut self, next: &Self) {
        self.ends[1] = next.ends[1];
        self.row.iter_mut().zip(next.row).for_each(|(all, more)| *all += more);
    }
}

fn deepest(depths: &[f64]) -> f64 {
    depths.iter().fold(0.0, |most, depth| most.max(*depth))
}

/// The least depths that change the first answer by `by` and the second by no more than `most`.
fn allowed(rows: &[[f64; 3]], by: f64, most: f64) -> Option<Vec<f64>> {
    let alone = least(rows, [Some(by), None])?;
    let lost: f64 = -rows.iter().zip(&alone).map(|(row, depth)| row[1] * depth).sum::<f64>();
    if lost <= most { Some(alone) } else { least(rows, [Some(by), Some(-most)]) }
}

/// Depths of bands whose rows are the two slopes and the width, that change the first answer by one target and the
/// second by the other, if there is one.
fn least(rows: &[[f64; 3]], targets: [Option<f64>; 2]) -> Option<Vec<f64>> {
    let mut cut = vec![true; rows.len()];
    for _ in 0..4 * rows.len() + 8 {
        let [a, b] = multipliers(rows, &cut, targets)?;
        let depths: Vec<f64> = rows.iter().map(|row| (row[0] * a + row[1] * b) / row[2]).collect();
        let small = 1e-12 * depths.iter().fold(0.0_f64, |most, depth| most.max(depth.abs()));
        let order = |a: &usize, b: &usize| depths[*a].total_cmp(&depths[*b]);
        let lowest = (0..rows.len()).filter(|k| cut[*k]).min_by(order);
        let highest = (0..rows.len()).filter(|k| !cut[*k]).max_by(order);
        match (lowest, highest) {
            (Some(k), _) if depths[k] < -small => cut[k] = false,
            (_, Some(k)) if depths[k] > small => cut[k] = true,
            _ => {
                let all = depths.into_iter().zip(cut);
                return Some(all.map(|(depth, cut)| if cut { depth } else { 0.0 }).collect());
            }
        }
    }
    None
}

/// λ for the bands that are cut.
fn multipliers(rows: &[[f64; 3]], cut: &[bool], targets: [Option<f64>; 2]) -> Option<[f64; 2]> {
    let [mut aa, mut ab, mut bb] = [0.0; 3];
    for ([a, b, width], _) in rows.iter().zip(cut).filter(|(_, cut)| **cut) {
        aa += a * a / width;
        ab += a * b / width;
        bb += b * b / width;
    }
    let first = targets[0]?;
    let found = match targets[1] {
        None => [first / aa, 0.0],
        Some(second) => {
            let determinant = aa * bb - ab * ab;
            // Nearly parallel rows cannot be separated.
            (determinant > 1e-12 * aa * bb).then_some(())?;
            [(first * bb - second * ab) / determinant, (second * aa - first * ab) / determinant]
        }
    };
    found.iter().all(|value| value.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In three unknowns and two wishes the depths that meet both are a line; on it no point is smaller.
    #[test]
    fn the_least_depths_meet_both_wishes_and_no_others_are_smaller() {
        let rows = [[1.0, -0.5, 1.0], [0.2, 1.0, 1.0], [0.6, 0.3, 2.0]];
        let depths = least(&rows, [Some(0.3), Some(0.05)]).unwrap();
        let sum = |k: usize| rows.iter().zip(&depths).map(|(row, c)| row[k] * c).sum::<f64>();
        assert!((sum(0) - 0.3).abs() < 1e-14 && (sum(1) - 0.05).abs() < 1e-14);
        let [a, b] = [0, 1].map(|k| rows.map(|row| row[k]));
        let line =
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let norm = |c: &[f64]| rows.iter().zip(c).map(|(row, c)| row[2] * c * c).sum::<f64>();
        for step in [-1e-3, 1e-3] {
            let other: Vec<f64> = depths.iter().zip(line).map(|(c, by)| c + step * by).collect();
            assert!(norm(&other) > norm(&depths));
        }
        assert!(depths.iter().all(|depth| *depth > 0.0), "{depths:?}");
    }

    /// The reported cuts meet the whole wish and lose no more than allowed, even where one depth for a stretch would
    /// lose more. Slopes of the sweet spot (mm) and the swing weight (kg cm²) per mm off an R161's last bands of an
    /// inch.
    #[test]
    fn what_is_told_does_the_whole() {
        let slopes = [[0.02, -4.39], [0.09, -4.86], [0.12, -5.36], [-0.06, -5.88]];
        let slopes = slopes.into_iter().chain([[-0.24, -6.43], [-0.41, -6.99], [-0.63, -8.11]]);
        let bands: Vec<BandRun> = slopes
            .enumerate()
            .map(|(k, [a, b])| BandRun { ends: [k, k + 1].map(|k| k as f64), row: [a, b, 1.0] })
            .collect();
        for (by, most) in [(-1.0, 100.0), (-1.0, 19.06), (0.1, 19.06), (-1.2, 19.06)] {
            let cuts = recipe(&bands, by, most).unwrap();
            let sum = |which: usize| {
                let inside = |cut: &RecipeCut, band: &BandRun| {
                    cut.ends[0] <= band.ends[0] && band.ends[1] <= cut.ends[1]
                };
                let of = |cut: &RecipeCut| {
                    let own = bands.iter().filter(|band| inside(cut, band));
                    own.map(|band| cut.depth * band.row[which]).sum::<f64>()
                };
                cuts.iter().map(of).sum::<f64>()
            };
            assert!((sum(0) - by).abs() < 1e-12, "{by} {most}: {cuts:?}");
            assert!(-sum(1) <= most + 1e-12, "{by} {most}: {cuts:?}");
        }
        assert!(recipe(&bands, -2.0, 19.06).is_none());
    }

    /// A band that would have to grow is not cut, and a wish that only growing meets is not met.
    #[test]
    fn no_band_grows() {
        let depths = least(&[[1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]], [Some(0.3), None]).unwrap();
        assert!((depths[0] - 0.3).abs() < 1e-15 && depths[1] == 0.0);
        assert!(least(&[[1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], [Some(-1.0), None]).is_none());
    }
}
