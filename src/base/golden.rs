//! The golden section: a sequence of numbers without a pattern, and the search for a minimum that divides by it.

/// `(√5 − 1)/2`.
pub const SECTION: f64 = 0.618_033_988_749_894_9;

/// The fractional part of `(k + 1)` golden sections, a number in [0, 1); successive ones show no pattern.
pub fn fraction(k: usize) -> f64 {
    ((k + 1) as f64 * SECTION).fract()
}

/// The position of the minimum of `f` between `low` and `high`, to half the digits of the interval. `f` is flat there,
/// so its value has full accuracy.
pub fn least(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 40;
    let (mut a, mut b) = (high - SECTION * (high - low), low + SECTION * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..STEPS {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - SECTION * (high - low);
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + SECTION * (high - low);
            at_b = f(b);
        }
    }
    if at_a < at_b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_place_is_found_wherever_it_is() {
        for x in [0.0, 0.1, 0.5, 0.99, 1.0] {
            assert!((least(0.0, 1.0, |s| (s - x).powi(2)) - x).abs() < 1e-8, "{x}");
        }
    }

    #[test]
    fn fractions_fill_the_unit_interval_evenly() {
        let mut numbers: Vec<f64> = (0..100).map(fraction).collect();
        numbers.sort_by(f64::total_cmp);
        assert!(numbers.windows(2).all(|pair| pair[1] - pair[0] < 0.02));
    }
}
