//! How is a smooth curve laid through measured radii without overshooting them, in Bernstein form?

/// Slopes of the monotone piecewise cubic through the points `(x, y)`: two or more, with rising `x`.
///
/// An inner slope is the weighted harmonic mean of the neighbouring secants `m` over the intervals `h`,
/// `(w₁ + w₂)/d = w₁/m₋ + w₂/m₊` with `w₁ = 2h₊ + h₋`, `w₂ = h₊ + 2h₋`. It is 0 where the secants differ in sign or one
/// is 0. An end slope is a one-sided three-point formula, limited to keep the shape. Two points give the straight line.
///
/// # Source
///
/// F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, with the end
/// conditions of SciPy's `PchipInterpolator`, which the tests compare with.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
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

/// Bernstein coefficients of the monotone cubic on each interval, `y ± h y′/3` in the middle.
pub fn cubics(x: &[f64], y: &[f64]) -> Vec<[f64; 4]> {
    let d = slopes(x, y);
    let cubic = |k: usize| {
        let (h, low, high) = (x[k + 1] - x[k], y[k].min(y[k + 1]), y[k].max(y[k + 1]));
        // Between the stations' values in exact arithmetic; the clamp removes round-off.
        let first = (y[k] + h * d[k] / 3.0).clamp(low, high);
        let second = (y[k + 1] - h * d[k + 1] / 3.0).clamp(low, high);
        [y[k], first, second, y[k + 1]]
    };
    (0..x.len() - 1).map(cubic).collect()
}

/// `Σ bᵢ Bᵢ(s)`, `Bᵢ` the cubic Bernstein polynomials, by de Casteljau's corner cutting.
pub fn bernstein(b: &[f64; 4], s: f64) -> f64 {
    blossom(b, s, s, s)
}

/// The polar form of a cubic: multi-affine, symmetric, equal to the cubic on the diagonal.
#[inline]
pub fn blossom(b: &[f64; 4], s: f64, t: f64, u: f64) -> f64 {
    let cut = |a: f64, b: f64, s: f64| (1.0 - s) * a + s * b;
    let (c0, c1, c2) = (cut(b[0], b[1], s), cut(b[1], b[2], s), cut(b[2], b[3], s));
    cut(cut(c0, c1, t), cut(c1, c2, t), u)
}

/// Bernstein coefficients of the same cubic between `s0` and `s1`.
#[inline]
pub fn subdivide(b: &[f64; 4], s0: f64, s1: f64) -> [f64; 4] {
    [blossom(b, s0, s0, s0), blossom(b, s0, s0, s1), blossom(b, s0, s1, s1), blossom(b, s1, s1, s1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    type Table = (&'static str, &'static [f64], &'static [f64], &'static [f64], &'static [f64]);

    #[test]
    fn the_curve_is_the_one_of_scipy() {
        for (name, x, y, queries, values) in SCIPY_PCHIP {
            let cubics = cubics(x, y);
            let scale = y.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (at, expected) in queries.iter().zip(values) {
                let k = (x.partition_point(|x| x <= at).max(1) - 1).min(cubics.len() - 1);
                let got = bernstein(&cubics[k], (at - x[k]) / (x[k + 1] - x[k]));
                assert!((got - expected).abs() <= 1e-14 * scale, "{name} {at}: {got} {expected}");
            }
        }
    }

    #[test]
    fn no_curve_leaves_the_range_of_its_neighbours() {
        for (name, x, y, ..) in SCIPY_PCHIP {
            for (k, cubic) in cubics(x, y).iter().enumerate() {
                let (low, high) = (y[k].min(y[k + 1]), y[k].max(y[k + 1]));
                assert!(cubic.iter().all(|b| (low..=high).contains(b)), "{name} {k}");
            }
        }
    }

    /// Name, x, y, queries, and the values there of `PchipInterpolator(x, y)`, SciPy 1.17.1,
    /// printed with `repr`.
    const SCIPY_PCHIP: [Table; 8] = [
        (
            "MONOTONE",
            &[0.0, 1.0, 2.5, 4.0, 5.0, 7.0, 8.0],
            &[0.0, 0.2, 1.1, 3.0, 3.2, 6.5, 6.6],
            &[0.0, 0.8, 1.0, 1.375, 2.5, 3.7, 4.25, 5.0, 6.6, 7.25, 8.0],
            &[
                0.0,
                0.1433187096774194,
                0.2,
                0.3446104550691245,
                1.1,
                2.7782255986787785,
                3.0621998051927317,
                3.2,
                6.1338541819691486,
                6.539766979768786,
                6.6,
            ],
        ),
        (
            "FLAT",
            &[0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 7.0],
            &[2.0, 2.0, 2.0, 3.5, 3.5, 3.5, 5.0],
            &[0.0, 0.8, 1.0, 1.25, 2.0, 2.8, 3.25, 4.0, 5.6, 6.25, 7.0],
            &[2.0, 2.0, 2.0, 2.0, 2.0, 3.344, 3.5, 3.5, 3.5, 3.640625, 5.0],
        ),
        (
            "ZIGZAG",
            &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
            &[0.0, 1.0, -1.0, 2.0, -0.5, 0.7, 0.1],
            &[0.0, 0.8, 1.0, 1.25, 2.0, 2.8, 3.25, 4.0, 4.8, 5.25, 6.0],
            &[
                0.0,
                0.9759999999999998,
                1.0,
                0.6875,
                -1.0,
                1.6879999999999988,
                1.609375,
                -0.5,
                0.5751999999999993,
                0.6765625,
                0.09999999999999998,
            ],
        ),
        (
            "TWO_STATIONS",
            &[0.25, 0.84],
            &[0.0127, 0.03302],
            &[0.25, 0.2559, 0.309, 0.368, 0.4565, 0.545, 0.6099, 0.6925, 0.781, 0.8341, 0.84],
            &[
                0.0127,
                0.0129032,
                0.014732,
                0.016764,
                0.019812000000000003,
                0.022860000000000005,
                0.0250952,
                0.027940000000000003,
                0.030988000000000005,
                0.0328168,
                0.03302,
            ],
        ),
        (
            "STEEP",
            &[0.0, 0.1, 0.11, 0.12, 1.0, 1.05],
            &[1.0, 1.001, 10.0, 10.1, 10.11, 0.0],
            &[
                0.0, 0.025, 0.08, 0.1, 0.1025, 0.108, 0.11, 0.1125, 0.118, 0.12, 0.34, 0.824, 1.0,
                1.0125, 1.04, 1.05,
            ],
            &[
                1.0,
                1.0000273462567402,
                1.000544006845072,
                1.001,
                2.39786045442333,
                9.038794149427728,
                10.0,
                10.043425132779664,
                10.095886607307191,
                10.1,
                10.105725072281643,
                10.10990721644809,
                10.11,
                9.029699012554994,
                2.4150981036168124,
                -1.7763568394002505e-15,
            ],
        ),
        (
            "NON_UNIFORM",
            &[0.0, 0.003, 0.01, 0.5, 0.52, 3.0, 100.0],
            &[5.0, 4.2, 4.0, 7.7, 7.9, 8.0, 2.0],
            &[0.0, 0.0024, 0.003, 0.00475, 0.01, 0.402, 0.505, 0.52, 2.504, 27.25, 100.0],
            &[
                5.0,
                4.27295008605852,
                4.2,
                4.111822289156627,
                4.0,
                6.751347498808957,
                7.756422743827641,
                7.9,
                7.999048518906563,
                7.796759631940931,
                2.0,
            ],
        ),
        (
            "THREE_STATIONS",
            &[0.0, 0.3, 1.0],
            &[1.0, 1.7, 1.2],
            &[0.0, 0.01, 0.1, 0.2, 0.3, 0.35, 0.5, 0.61, 0.75, 0.9, 0.99, 1.0],
            &[
                1.0,
                1.0326286772486772,
                1.3258201058201058,
                1.590687830687831,
                1.7,
                1.6998177842565598,
                1.688338192419825,
                1.656572886297376,
                1.56716472303207,
                1.3851311953352767,
                1.2211239067055395,
                1.2,
            ],
        ),
        (
            "THREE_STEEP_END",
            &[0.0, 0.1, 1.0],
            &[0.0, 5.0, 5.2],
            &[0.0, 0.01, 0.1, 0.2, 0.35, 0.5, 0.61, 0.75, 0.9, 0.99, 1.0],
            &[
                0.0,
                0.5847787008821171,
                5.0,
                5.054380169471203,
                5.116151878362666,
                5.15765419998394,
                5.17747971724732,
                5.192442080471871,
                5.199081471801184,
                5.199992559151566,
                5.199999999999999,
            ],
        ),
    ];
}
