//! How little wood has to come off for a wish, to first order?
//!
//! Depths `c` of the bands, none negative, that change answers by `t` where a unit of depth changes them by `G`:
//!
//! ```text
//! minimise Σ wⱼ cⱼ²   subject to   G c = t,  c ≥ 0        w the width of a band
//! ```
//!
//! by the active set: on the bands that are cut `c = W⁻¹Gᵀ λ` with `(G W⁻¹ Gᵀ) λ = t`; a band that would grow is
//! left alone, and cut again where its `gᵀλ` is positive.

use crate::study::lathe::map::LatheMap;
use crate::study::many::answers::Answer;

/// A stretch (m from the knob end) and the depth that comes off its diameter (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecipeCut {
    /// From where to where (m).
    pub ends: [f64; 2],
    /// Depth, of the diameter (m): the mean over the stretch.
    pub depth: f64,
}

/// The least wood off the bat that changes the first answer by `by` (in its unit) and keeps the second, for the
/// same swing, to first order; stretches from the knob on. None where taking wood off does not do it.
pub fn least_wood(
    map: &LatheMap,
    (change, by): (Answer, f64),
    kept: Answer,
) -> Option<Vec<RecipeCut>> {
    let index = |wanted: Answer| map.terms.answers.iter().position(|answer| *answer == wanted);
    let (first, second) = (index(change)?, index(kept)?);
    let usable: Vec<(usize, [f64; 2])> = map
        .bands
        .iter()
        .enumerate()
        .filter_map(|(k, band)| {
            let slopes = &band.slopes.as_ref()?.same_swing;
            Some((k, [slopes[first]?.value, slopes[second]?.value]))
        })
        .collect();
    let width = |k: usize| map.bands[k].ends[1] - map.bands[k].ends[0];
    let rows: Vec<[f64; 3]> = usable.iter().map(|(k, [a, b])| [*a, *b, width(*k)]).collect();
    let depths = least(&rows, by)?;
    let most = depths.iter().fold(0.0_f64, |most, depth| most.max(*depth));
    // What is a tenth of the deepest is no cut to be told.
    let told = usable.iter().zip(&depths).filter(|(_, depth)| **depth > 0.1 * most);
    let mut cuts: Vec<RecipeCut> = vec![];
    for ((k, _), depth) in told {
        let ends = map.bands[*k].ends;
        match cuts.last_mut().filter(|last| (last.ends[1] - ends[0]).abs() < 1e-9) {
            Some(last) => {
                let (was, more) = (last.ends[1] - last.ends[0], ends[1] - ends[0]);
                last.depth = (last.depth * was + depth * more) / (was + more);
                last.ends[1] = ends[1];
            }
            None => cuts.push(RecipeCut { ends, depth: *depth }),
        }
    }
    (!cuts.is_empty()).then_some(cuts)
}

/// Depths of bands whose rows are the two slopes and the width, that change the first by `by` and the second not.
fn least(rows: &[[f64; 3]], by: f64) -> Option<Vec<f64>> {
    let mut cut = vec![true; rows.len()];
    for _ in 0..4 * rows.len() + 8 {
        let multipliers = multipliers(rows, &cut, by)?;
        let depth = |row: &[f64; 3]| (row[0] * multipliers[0] + row[1] * multipliers[1]) / row[2];
        let depths: Vec<f64> = rows.iter().map(depth).collect();
        let size = depths.iter().fold(0.0_f64, |most, depth| most.max(depth.abs()));
        let all = 0..rows.len();
        let lowest =
            all.clone().filter(|k| cut[*k]).min_by(|a, b| depths[*a].total_cmp(&depths[*b]));
        if let Some(k) = lowest.filter(|k| depths[*k] < -1e-12 * size) {
            cut[k] = false;
            continue;
        }
        let highest = all.filter(|k| !cut[*k]).max_by(|a, b| depths[*a].total_cmp(&depths[*b]));
        if let Some(k) = highest.filter(|k| depths[*k] > 1e-12 * size) {
            cut[k] = true;
            continue;
        }
        return Some(
            depths.iter().zip(cut).map(|(depth, cut)| if cut { *depth } else { 0.0 }).collect(),
        );
    }
    None
}

/// λ of the bands that are cut.
fn multipliers(rows: &[[f64; 3]], cut: &[bool], by: f64) -> Option<[f64; 2]> {
    let [mut aa, mut ab, mut bb] = [0.0; 3];
    for ([a, b, width], _) in rows.iter().zip(cut).filter(|(_, cut)| **cut) {
        aa += a * a / width;
        ab += a * b / width;
        bb += b * b / width;
    }
    let determinant = aa * bb - ab * ab;
    let found = [by * bb / determinant, -by * ab / determinant];
    let sound = determinant > 1e-12 * aa * bb && found.iter().all(|value| value.is_finite());
    sound.then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_depths_meet_both_wishes_and_no_band_grows() {
        let rows = [[1.0, -0.5, 1.0], [0.2, 1.0, 1.0], [-1.0, 0.3, 2.0], [0.7, 0.1, 0.5]];
        let depths = least(&rows, 0.3).unwrap();
        let sum = |k: usize| rows.iter().zip(&depths).map(|(row, c)| row[k] * c).sum::<f64>();
        assert!((sum(0) - 0.3).abs() < 1e-14 && sum(1).abs() < 1e-14);
        assert!(depths.iter().all(|depth| *depth >= 0.0));
        let norm = |c: &[f64]| rows.iter().zip(c).map(|(row, c)| row[2] * c * c).sum::<f64>();
        // Any other that meets both wishes is larger: along the two directions that change neither.
        for (i, j, k) in [(0, 1, 3), (0, 1, 2)] {
            let [u, v, w] = [rows[i], rows[j], rows[k]];
            let along =
                [v[0] * w[1] - v[1] * w[0], w[0] * u[1] - w[1] * u[0], u[0] * v[1] - u[1] * v[0]];
            for step in [-1e-3, 1e-3] {
                let mut other = depths.clone();
                [i, j, k].into_iter().zip(along).for_each(|(k, by)| other[k] += step * by);
                let allowed = other.iter().all(|depth| *depth >= 0.0);
                assert!(!allowed || norm(&other) > norm(&depths));
            }
        }
        assert!(least(&[[1.0, 1.0, 1.0], [2.0, 1.0, 1.0]], 1.0).is_none());
    }
}
