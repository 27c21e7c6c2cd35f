//! Which computed mode is each measured one?

/// Shapes with a smaller MAC do not belong to one mode.
pub const LEAST: f64 = 0.5;
/// Reduction of a MAC for each octave between the frequencies: with few points several computed modes may look similar,
/// and the frequency decides.
const OCTAVE: f64 = 0.05;
/// Modes farther apart are alike by chance.
const FARTHEST: f64 = 1.0;

/// Octaves between two frequencies that may belong to one mode; `None` if they are too far apart.
pub fn octaves(measured: f64, computed: f64) -> Option<f64> {
    Some((measured / computed).log2().abs()).filter(|octaves| *octaves <= FARTHEST)
}

/// Pairs by the MAC, rows measured and columns computed, one to one from the best on: by MAC less
/// 0.05 for an octave between the frequencies (Hz), as long as the MAC is [`LEAST`] and they are
/// not more than an octave apart.
pub fn by_shape(mac: &[Vec<f64>], measured: &[f64], computed: &[f64]) -> Vec<(usize, usize)> {
    let mut candidates = vec![];
    for (i, row) in mac.iter().enumerate() {
        for (j, mac) in row.iter().enumerate().filter(|(_, mac)| **mac >= LEAST) {
            if let Some(octaves) = octaves(measured[i], computed[j]) {
                candidates.push((mac - OCTAVE * octaves, i, j));
            }
        }
    }
    candidates.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut pairs: Vec<(usize, usize)> = vec![];
    for (_, i, j) in candidates {
        if pairs.iter().all(|(a, b)| *a != i && *b != j) {
            pairs.push((i, j));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Pairs by the number that the file gives each mode, counted from 1.
pub fn by_order(orders: &[Option<usize>], computed: usize) -> Vec<(usize, usize)> {
    let pair = |(i, order): (usize, &Option<usize>)| {
        let j = (*order)?.checked_sub(1)?;
        (j < computed).then_some((i, j))
    };
    orders.iter().enumerate().filter_map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_pair_first_and_each_mode_once() {
        let mac = vec![vec![0.90, 0.95, 0.0], vec![0.2, 0.99, 0.1], vec![0.0, 0.1, 0.4]];
        let f = [100.0, 200.0, 300.0];
        assert_eq!(by_shape(&mac, &f, &f), [(0, 0), (1, 1)]);
    }

    #[test]
    fn of_two_that_look_alike_the_frequency_tells() {
        let mac = vec![vec![0.98, 0.98]];
        assert_eq!(by_shape(&mac, &[210.0], &[300.0, 200.0]), [(0, 1)]);
        assert_eq!(by_shape(&mac, &[290.0], &[300.0, 200.0]), [(0, 0)]);
        assert_eq!(by_shape(&mac, &[210.0], &[800.0, 200.0]), [(0, 1)]);
        assert_eq!(by_shape(&mac, &[790.0], &[800.0, 200.0]), [(0, 0)]);
        // Half and twice the frequency may belong to the mode; a larger difference excludes it, however similar the
        // shapes.
        let alone = vec![vec![1.0]];
        for (measured, paired) in [(101.0, 1), (99.0, 0), (399.0, 1), (401.0, 0), (0.0, 0)] {
            assert_eq!(by_shape(&alone, &[measured], &[200.0]).len(), paired, "{measured}");
        }
        assert_eq!(by_order(&[Some(2), None, Some(9)], 3), [(0, 1)]);
    }
}
