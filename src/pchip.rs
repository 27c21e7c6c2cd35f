//! How a smooth curve is laid through measured radii without overshooting them.

/// Slopes of the monotone piecewise cubic through `(x, y)`, `x` rising, two points at least.
///
/// Inside, the weighted harmonic mean of the neighbouring secants `m` over the intervals `h`,
/// `(w₁ + w₂)/d = w₁/m₋ + w₂/m₊` with `w₁ = 2h₊ + h₋`, `w₂ = h₊ + 2h₋`, and 0 where the
/// secants differ in sign or one is 0. At the ends a one-sided three-point formula,
/// limited to keep the shape. Two points give the straight line.
///
/// # Source
///
/// F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, with the end
/// conditions of SciPy's `PchipInterpolator`, which the tests compare with.
pub fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let m: Vec<f64> = (0..n - 1).map(|k| (y[k + 1] - y[k]) / h[k]).collect();
    if n == 2 {
        return vec![m[0]; 2];
    }
    let inside = |k: usize| {
        let (before, after) = (m[k - 1], m[k]);
        if before == 0.0 || after == 0.0 || (before > 0.0) != (after > 0.0) {
            return 0.0;
        }
        let (w1, w2) = (2.0 * h[k] + h[k - 1], h[k] + 2.0 * h[k - 1]);
        (w1 + w2) / (w1 / before + w2 / after)
    };
    let mut slopes = Vec::with_capacity(n);
    slopes.push(end(h[0], h[1], m[0], m[1]));
    slopes.extend((1..n - 1).map(inside));
    slopes.push(end(h[n - 2], h[n - 3], m[n - 2], m[n - 3]));
    slopes
}

/// The slope at an end: `h0`, `m0` of the last interval, `h1`, `m1` of the one before.
fn end(h0: f64, h1: f64, m0: f64, m1: f64) -> f64 {
    let sign = |v: f64| if v == 0.0 { 0.0 } else { v.signum() };
    let slope = ((2.0 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
    if sign(slope) != sign(m0) {
        0.0
    } else if sign(m0) != sign(m1) && slope.abs() > 3.0 * m0.abs() {
        3.0 * m0
    } else {
        slope
    }
}
